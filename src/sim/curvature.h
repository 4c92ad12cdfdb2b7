// How strongly a cloth is bent.
#pragma once

#include <span>
#include <vector>

namespace clothlab::sim {

/// For each point the size of the mean curvature, |k1 + k2| / 2 of the principal curvatures, in 1/m: 1/(2r) on a
/// cylinder, 1/r on a sphere. Border points have the value of the point nearest to them inside; a grid without one has
/// none at all (0). Triangles with points that are not finite, or without area, count nothing. `positions` holds
/// x, y, z per point in m, row-major.
void point_curvatures(int columns, int rows, std::span<const float> positions, std::vector<float>& curvatures);

} // namespace clothlab::sim
