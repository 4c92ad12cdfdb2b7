#include "experiments/stability/boundary.h"

#include <algorithm>
#include <cmath>

namespace clothlab::experiments {

std::optional<double> BoundaryPoint::distance() const {
    return predicted ? std::optional(100 * (observed / *predicted - 1)) : std::nullopt;
}

bool looks_along_x(const VariedAxis& x, const VariedAxis& y) {
    if (x.categorical || y.categorical)
        return !x.categorical;
    return y.quantity.whole && !x.quantity.whole;
}

std::vector<BoundaryPoint> boundary(const VariedAxis& along, std::size_t lines,
                                    const std::function<bool(std::size_t, std::size_t)>& stable,
                                    const std::vector<std::vector<double>>& predicted) {
    std::vector<BoundaryPoint> points;
    for (std::size_t line = 0; line < lines; ++line) {
        const std::size_t first = points.size();
        for (std::size_t i = 0; i + 1 < along.values.size(); ++i) {
            if (stable(line, i) == stable(line, i + 1))
                continue;
            BoundaryPoint point{line, points.size() - first, i, stable(line, i), along.border(i + 1), 0, {}};
            point.half_cell = 50 * (along.values[i + 1].at - along.values[i].at) / std::abs(point.observed);
            points.push_back(point);
        }
        for (const double value : predicted[line]) {
            const auto nearest =
                std::min_element(points.begin() + static_cast<std::ptrdiff_t>(first), points.end(),
                                 [&](const BoundaryPoint& a, const BoundaryPoint& b) {
                                     return std::abs(a.observed - value) < std::abs(b.observed - value);
                                 });
            if (nearest != points.end() &&
                (!nearest->predicted ||
                 std::abs(nearest->observed - value) < std::abs(nearest->observed - *nearest->predicted)))
                nearest->predicted = value;
        }
    }
    return points;
}

} // namespace clothlab::experiments
