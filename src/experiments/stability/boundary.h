// The border of a map's stable cells: where it was observed, where it was predicted, and how far those are apart.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "experiments/stability/axis.h"
#include "experiments/stability/refinement.h"

namespace clothlab::experiments {

/// A map is looked at line by line: along its axis of numbers, for each value of the other.
struct BoundaryPoint {
    std::size_t line = 0;  ///< the place on the other axis
    std::size_t rank = 0;  ///< which border of the line, from below
    std::size_t below = 0; ///< the value next to it on this axis; the next one is on the other side
    bool stable_below = true;
    double observed = 0;                    ///< in the middle between the two (of logarithmic axes, of the logarithms)
    double half_cell = 0;                   ///< in percent of it: how far off that may be
    std::optional<double> predicted;        ///< the nearest to it that no other point is nearer to
    std::optional<double> distance() const; ///< in percent of the prediction, positive where observed above it
};

/// Which axis is looked along: y, unless only x has numbers, or only x has numbers between its numbers.
bool looks_along_x(const VariedAxis& x, const VariedAxis& y);

/// The borders of the stable points. `stable(line, value)`; `predicted` of each line.
std::vector<BoundaryPoint> boundary(const VariedAxis& along, std::size_t lines,
                                    const std::function<bool(std::size_t, std::size_t)>& stable,
                                    const std::vector<std::vector<double>>& predicted);

} // namespace clothlab::experiments
