// Where the cloth passes through itself.
#pragma once

#include <cstddef>
#include <span>

namespace clothlab::sim {

/// The number of pairs of a mesh edge and a triangle without a common corner that the edge passes through. Edges are
/// the sides of the triangles of for_each_triangle. `positions` holds x, y, z per point in m, row-major, `columns *
/// rows` points. Positions that are not finite take part in no intersection. Touching counts as passing through only up
/// to rounding: this is a measure of quality, not a contact test.
std::size_t count_intersections(int columns, int rows, std::span<const float> positions);

} // namespace clothlab::sim
