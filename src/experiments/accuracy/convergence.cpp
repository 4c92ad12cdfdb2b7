#include "experiments/accuracy/convergence.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clothlab::experiments {
namespace {

double fitted(const std::vector<double>& x, const std::vector<double>& y, std::size_t first, std::size_t last) {
    const auto n = static_cast<double>(last - first + 1);
    double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
    for (std::size_t i = first; i <= last; ++i) {
        mean_x += x[i] / n;
        mean_y += y[i] / n;
    }
    for (std::size_t i = first; i <= last; ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    return xy / xx;
}

bool straight(const std::vector<double>& x, const std::vector<double>& y, std::size_t first, std::size_t last,
              double slope) {
    for (std::size_t i = first; i < last; ++i)
        if (std::abs((y[i + 1] - y[i]) / (x[i + 1] - x[i]) - slope) > straightness)
            return false;
    return true;
}

} // namespace

std::optional<Slope> fit_slope(const std::vector<double>& dt, const std::vector<double>& error,
                               const std::vector<bool>& usable) {
    std::vector<double> x, y; // decimal logarithms; not a number where a point is of no use
    for (std::size_t i = 0; i < dt.size(); ++i) {
        const bool good = usable[i] && error[i] > 0 && std::isfinite(error[i]);
        x.push_back(std::log10(dt[i]));
        y.push_back(good ? std::log10(error[i]) : std::numeric_limits<double>::quiet_NaN());
    }
    std::optional<Slope> best;
    for (std::size_t first = 0; first < dt.size(); ++first)
        for (std::size_t last = first; last < dt.size() && !std::isnan(y[last]); ++last) {
            const double decades = x[first] - x[last];
            // Of two runs as long as each other the one with the finer steps.
            if (last - first < 2 || (best && decades < best->decades * (1 - 1e-9)))
                continue;
            const double slope = fitted(x, y, first, last);
            if (slope >= flattest && straight(x, y, first, last, slope))
                best = Slope{slope, first, last, decades};
        }
    return best;
}

double refined_error(double coarse, double fine, int order) {
    if (!(coarse > 2 * fine))
        return std::max(coarse, fine);
    return fine == 0 ? 0 : fine / (std::min(coarse / fine, std::ldexp(1, order)) - 1);
}

std::vector<bool> pareto_front(const std::vector<double>& cost, const std::vector<double>& error) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < cost.size(); ++i)
        if (std::isfinite(cost[i]) && std::isfinite(error[i]))
            order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return cost[a] != cost[b] ? cost[a] < cost[b] : error[a] < error[b];
    });
    std::vector<bool> front(cost.size(), false);
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order)
        if (error[i] < least) {
            least = error[i];
            front[i] = true;
        }
    return front;
}

} // namespace clothlab::experiments
