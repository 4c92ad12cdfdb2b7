// How much of the plane a chart takes.
#include <algorithm>
#include <cmath>
#include <limits>

#include "ui/charts.h"

namespace clothlab::ui {
namespace {

using experiments::Axis;

class Range {
public:
    explicit Range(const Axis& axis) : axis_(axis) {}
    void add(double value) {
        if (!std::isfinite(value) || (axis_.log && value <= 0))
            return;
        low_ = std::min(low_, value);
        high_ = std::max(high_, value);
    }
    /// With a share of its length at both ends, where there is something of some length.
    std::pair<double, double> padded(double share) const {
        if (!axis_.names.empty())
            return {-0.5, static_cast<double>(axis_.names.size()) - 0.5};
        if (!(low_ <= high_))
            return axis_.log ? std::pair{0.1, 10.0} : std::pair{0.0, 1.0};
        if (axis_.log) {
            const double ratio = low_ < high_ ? std::pow(high_ / low_, share) : share == 0 ? 1.0 : 2.0;
            return {low_ / ratio, high_ * ratio};
        }
        const double pad = low_ < high_ ? share * (high_ - low_) : std::max(std::abs(high_) * 0.5, 1e-9);
        return {low_ - pad, high_ + pad};
    }

private:
    const Axis& axis_;
    double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

} // namespace

ChartLimits limits_of(const experiments::Chart& chart) {
    Range x(chart.x), y(chart.y);
    for (const experiments::Cell& cell : chart.cells)
        x.add(cell.x0), x.add(cell.x1), y.add(cell.y0), y.add(cell.y1);
    // A map shows its cells; a prediction may leave it.
    if (chart.cells.empty()) {
        for (const experiments::Series& series : chart.series)
            for (std::size_t i = 0; i < series.x.size(); ++i)
                if (std::isfinite(series.x[i]) && std::isfinite(series.y[i]))
                    x.add(series.x[i]), y.add(series.y[i]);
        for (const experiments::Guide& guide : chart.guides)
            guide.vertical ? x.add(guide.at) : y.add(guide.at);
    }
    const double share = chart.cells.empty() ? 0.06 : 0;
    const auto [x_low, x_high] = x.padded(share);
    const auto [y_low, y_high] = y.padded(share);
    return {x_low, x_high, y_low, y_high};
}

} // namespace clothlab::ui
