// The discrete mean curvature normal of M. Meyer, M. Desbrun, P. Schröder, A. H. Barr, "Discrete differential-geometry
// operators for triangulated 2-manifolds" (2003), section 3:
//     K(i) = 1 / (2 A) * sum over j of (cot a_ij + cot b_ij) (x_i - x_j),    |K| / 2 = mean curvature    (equations 5,
//     8)
// with A the mixed area (figure 4) and the angles opposite to the edge ij in its two triangles.
#include "sim/curvature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sim/grid.h"
#include "sim/triple.h"

namespace clothlab::sim {
namespace {

struct Sum {
    Triple<float> k{0, 0, 0}; ///< of (cot a + cot b) (x_i - x_j), in m
    float area = 0;           ///< mixed, m²
};

/// Adds what a triangle has for its three corners.
void add_triangle(const std::array<Triple<float>, 3>& x, const std::array<Sum*, 3>& sums) {
    std::array<Triple<float>, 3> edge; // opposite to each corner
    for (std::size_t c = 0; c < 3; ++c)
        edge[c] = x[(c + 2) % 3] - x[(c + 1) % 3];
    const Triple<float>&e = edge[0], &f = edge[1];
    const float twice_area = norm(Triple<float>{e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x});
    if (!(twice_area > 0) || !std::isfinite(twice_area))
        return;
    std::array<float, 3> cotangent, square;
    for (std::size_t c = 0; c < 3; ++c) {
        cotangent[c] = -dot(edge[(c + 1) % 3], edge[(c + 2) % 3]) / twice_area;
        square[c] = dot(edge[c], edge[c]);
    }
    const bool obtuse = std::min({cotangent[0], cotangent[1], cotangent[2]}) < 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t next = (c + 1) % 3, last = (c + 2) % 3;
        Sum& sum = *sums[c];
        // To the next corner leads the edge opposite to the last one, from the last one that opposite to the next.
        sum.k = along(along(sum.k, -cotangent[last], edge[last]), cotangent[next], edge[next]);
        if (obtuse)
            sum.area += twice_area / (cotangent[c] < 0 ? 4.f : 8.f);
        else
            sum.area += (square[last] * cotangent[last] + square[next] * cotangent[next]) / 8;
    }
}

} // namespace

void point_curvatures(int columns, int rows, std::span<const float> positions, std::vector<float>& curvatures) {
    std::vector<Sum> sums(positions.size() / 3);
    const auto at = [&](std::uint32_t i) {
        return Triple<float>{positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
    };
    for_each_triangle(columns, rows, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        add_triangle({at(a), at(b), at(c)}, {&sums[a], &sums[b], &sums[c]});
    });
    curvatures.assign(sums.size(), 0.f);
    if (columns < 3 || rows < 3)
        return;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const int from = std::clamp(row, 1, rows - 2) * columns + std::clamp(column, 1, columns - 2);
            const Sum& sum = sums[static_cast<std::size_t>(from)];
            curvatures[static_cast<std::size_t>(row * columns + column)] =
                sum.area > 0 ? norm(sum.k) / (4 * sum.area) : 0.f;
        }
    }
}

} // namespace clothlab::sim
