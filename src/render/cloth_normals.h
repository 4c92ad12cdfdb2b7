// The normals and tangents of a cloth's points, on the CPU. Needs no GL.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace clothlab::render {

/// Finds the points that cannot be drawn (see drawable in view.h): usable[i] is 1 or 0. Returns how many cannot.
std::size_t find_drawable(std::span<const float> positions, std::vector<std::uint8_t>& usable);

/// Unit normals, x y z per point: the sum of the normals of the triangles around it, each as long as its triangle is
/// large. They point to the side that is up when the cloth is horizontal. Triangles with an unusable point count
/// nothing; a point without any area around it has (0, 1, 0). Empty usable: all are. `normals` is as long as
/// `positions`.
void cloth_normals(int columns, int rows, std::span<const float> positions, std::span<const std::uint8_t> usable,
                   std::span<float> normals);

/// Tangents d position / d u in m, x y z per point, u growing from 0 to 1 along the columns: central differences, one-
/// sided at the borders and beside an unusable point. 0 where no neighbour in the row is usable. Empty usable: all are.
/// The derivative along v, rows that is, is on the side of cross(tangent, normal). `tangents` is as long as
/// `positions`.
void cloth_tangents(int columns, int rows, std::span<const float> positions, std::span<const std::uint8_t> usable,
                    std::span<float> tangents);

} // namespace clothlab::render
