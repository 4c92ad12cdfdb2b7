#include "render/cloth_normals.h"

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "render/view.h"

namespace clothlab::render {

namespace {

struct Corner {
    const float* position;
    float* normal;
};

/// Adds a triangle's normal, twice its area long, to its three corners. The grid's winding points down (sim/grid.h),
/// so the edges are taken the other way round.
inline void add(const Corner& a, const Corner& b, const Corner& c) {
    const float ux = c.position[0] - a.position[0], vx = b.position[0] - a.position[0];
    const float uy = c.position[1] - a.position[1], vy = b.position[1] - a.position[1];
    const float uz = c.position[2] - a.position[2], vz = b.position[2] - a.position[2];
    const float n[3] = {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
    for (const Corner* corner : {&a, &b, &c})
        for (int k = 0; k < 3; ++k)
            corner->normal[k] += n[k];
}

} // namespace

std::size_t find_drawable(std::span<const float> positions, std::vector<std::uint8_t>& usable) {
    const std::size_t points = positions.size() / 3;
    usable.resize(points);
    std::size_t good = 0;
    for (std::size_t i = 0; i < points; ++i) {
        // No branches: this loop is vectorised. Comparisons with NaN are false.
        const bool x = std::abs(positions[3 * i]) <= drawable_range;
        const bool y = std::abs(positions[3 * i + 1]) <= drawable_range;
        const bool z = std::abs(positions[3 * i + 2]) <= drawable_range;
        usable[i] = static_cast<std::uint8_t>(x & y & z);
        good += usable[i];
    }
    return points - good;
}

void cloth_normals(int columns, int rows, std::span<const float> positions, std::span<const std::uint8_t> usable,
                   std::vector<float>& normals) {
    normals.assign(positions.size(), 0.f);
    const auto width = static_cast<std::size_t>(columns);
    const auto corner = [&](std::size_t i) { return Corner{&positions[3 * i], &normals[3 * i]}; };
    for (std::size_t row = 0; row + 1 < static_cast<std::size_t>(rows); ++row) {
        for (std::size_t column = 0; column + 1 < width; ++column) {
            // The two triangles of sim::for_each_triangle.
            const std::size_t a = row * width + column, b = a + 1, c = a + width, d = c + 1;
            if (usable.empty()) {
                add(corner(a), corner(b), corner(c));
                add(corner(b), corner(d), corner(c));
                continue;
            }
            if ((usable[b] & usable[c]) == 0)
                continue;
            if (usable[a] != 0)
                add(corner(a), corner(b), corner(c));
            if (usable[d] != 0)
                add(corner(b), corner(d), corner(c));
        }
    }
    for (std::size_t i = 0; i + 2 < normals.size(); i += 3) {
        const float square =
            normals[i] * normals[i] + normals[i + 1] * normals[i + 1] + normals[i + 2] * normals[i + 2];
        const bool degenerate = !(square > 1e-36f) || !(square < 1e38f);
        const float scale = degenerate ? 0.f : 1.f / std::sqrt(square);
        normals[i] *= scale;
        normals[i + 1] = degenerate ? 1.f : normals[i + 1] * scale;
        normals[i + 2] *= scale;
    }
}

void cloth_tangents(int columns, int rows, std::span<const float> positions, std::span<const std::uint8_t> usable,
                    std::vector<float>& tangents) {
    tangents.resize(positions.size());
    const auto width = static_cast<std::size_t>(columns);
    const auto good = [&](std::size_t i) { return usable.empty() || usable[i] != 0; };
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
        for (std::size_t column = 0; column < width; ++column) {
            const std::size_t i = row * width + column;
            const std::size_t left = column > 0 && good(i - 1) ? i - 1 : i;
            const std::size_t right = column + 1 < width && good(i + 1) ? i + 1 : i;
            const bool any = good(i) && right > left;
            const float scale = any ? static_cast<float>(width - 1) / static_cast<float>(right - left) : 0.f;
            for (std::size_t k = 0; k < 3; ++k)
                tangents[3 * i + k] = any ? scale * (positions[3 * right + k] - positions[3 * left + k]) : 0.f;
        }
    }
}

} // namespace clothlab::render
