#include "experiments/stability/prediction.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "experiments/findings.h"
#include "sim/simulation.h"

namespace clothlab::experiments {
namespace {

/// Between two values on different sides. `f` is the ratio's logarithm.
double crossing(const std::function<double(double)>& f, double low, double high, double f_low, double f_high, bool log,
                bool whole) {
    const auto inner = [log](double v) { return log ? std::log(v) : v; };
    const auto outer = [log](double u) { return log ? std::exp(u) : u; };
    const auto interpolated = [&](double weight_low, double weight_high) {
        const double u = inner(low), w = inner(high);
        return outer(u + (w - u) * weight_low / (weight_low - weight_high));
    };
    double weight_low = f_low, weight_high = f_high;
    int last = 0;
    for (int i = 0; i < 100; ++i) {
        if (whole ? high - low <= 1 : high - low <= 1e-6 * std::abs(high))
            break;
        const bool finite = std::isfinite(weight_low) && std::isfinite(weight_high);
        double middle = finite ? interpolated(weight_low, weight_high) : outer(0.5 * (inner(low) + inner(high)));
        if (whole)
            middle = std::fmin(std::fmax(std::round(middle), low + 1), high - 1);
        else if (finite) // a little past the root, so that both ends close in on it
            middle += (last < 0 ? 2e-7 : -2e-7) * std::abs(middle);
        if (!(middle > low) || !(middle < high))
            break;
        const double value = f(middle);
        if ((value > 0) == (f_low > 0)) {
            low = middle;
            f_low = weight_low = value;
            if (last < 0)
                weight_high *= 0.5;
            last = -1;
        } else {
            high = middle;
            f_high = weight_high = value;
            if (last > 0)
                weight_low *= 0.5;
            last = 1;
        }
    }
    return std::isfinite(f_low) && std::isfinite(f_high) && f_low != f_high ? interpolated(f_low, f_high)
                                                                            : 0.5 * (low + high);
}

} // namespace

double limit_ratio(const sim::Description& description) {
    try {
        const sim::StabilityMargin margin = sim::Simulation::create(description)->stability();
        if (margin.omega_dt == 0 || margin.limit == std::numeric_limits<double>::infinity())
            return std::isfinite(margin.omega) ? 0 : std::numeric_limits<double>::infinity();
        return margin.limit > 0 ? margin.omega_dt / margin.limit : std::numeric_limits<double>::infinity();
    } catch (const std::invalid_argument& e) {
        throw Refusal(e.what());
    }
}

std::vector<double> crossings(const std::function<double(double)>& ratio, const std::vector<double>& values, bool log,
                              bool whole) {
    const auto f = [&](double v) { return std::log(ratio(v)); };
    std::vector<double> found;
    double before = values.empty() ? 0 : f(values.front());
    for (std::size_t i = 1; i < values.size(); ++i) {
        const double now = f(values[i]);
        if ((before > 0) != (now > 0))
            found.push_back(crossing(f, values[i - 1], values[i], before, now, log, whole));
        before = now;
    }
    return found;
}

} // namespace clothlab::experiments
