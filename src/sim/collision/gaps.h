// How far the layers of a cloth are from touching.
#pragma once

#include <span>
#include <vector>

namespace clothlab::sim {

/// A flat grid: points, and their spacing in m.
struct FlatGrid {
    int columns = 0, rows = 0;
    float spacing_x = 0, spacing_y = 0;
};

/// Distances beyond this many thicknesses are not told apart.
inline constexpr float gap_reach = 4;

/// For each point its distance in m to the nearest other point, less twice the thickness: where it is below 0, points
/// are nearer than the rules for points allow (docs/simulation.md, self-collision). A distance of gap_reach
/// thicknesses stands for all that are larger, so a gap is 2 thicknesses at the most. Left out are points that are near
/// in the flat cloth, as with the rule of neighbours: not further than that reach or the diagonal of a cell of the
/// grid. Points that are not finite are near none. `positions` holds x, y, z per point in m, row-major.
void point_gaps(const FlatGrid& grid, std::span<const float> positions, float thickness, std::vector<float>& gaps);

} // namespace clothlab::sim
