// The loops over a row are written for the compiler to make vectors of (CMakeLists.txt has the flags that it needs for
// the square roots), so x, y and z of a row lie apart from each other while its normals are computed.
#include "render/cloth_normals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/glm.hpp>

#include "render/view.h"

namespace clothlab::render {

namespace {

/// The ways from a point to those that triangles tie it to, going round: each two that follow each other, and the last
/// and the first, are two sides of a triangle of sim::for_each_triangle.
struct Ways {
    glm::vec3 east, north_east, north, west, south_west, south;
};

/// Twice the area of the triangles around a point as a vector, the sum of the products of such two, four of them at a
/// time. A missing point is to have a way of length 0, or the same as the next one: its triangles then have no area.
inline glm::vec3 area_around(const Ways& e) {
    return glm::cross(e.north_east, e.north - e.east) + glm::cross(e.west, e.south_west - e.north) +
           glm::cross(e.south, e.east - e.south_west);
}

inline glm::vec3 unit_or_up(const glm::vec3& v) {
    const float square = glm::dot(v, v);
    const bool degenerate = !(square > 1e-36f) || !(square < 1e38f);
    const float scale = degenerate ? 0.f : 1.f / std::sqrt(square);
    return {v.x * scale, degenerate ? 1.f : v.y * scale, v.z * scale};
}

/// A row of points with its ends once more beyond them: at the border of the cloth, every point that is missing is then
/// where the one before it is, and has triangles without area.
class PaddedRow {
public:
    explicit PaddedRow(std::size_t columns) : values_(3 * (columns + 2)), stride_(columns + 2) {}
    void set(const float* positions) {
        const std::size_t columns = stride_ - 2;
        float *x = &values_[1], *y = x + stride_, *z = y + stride_;
        for (std::size_t i = 0; i < columns; ++i) {
            x[i] = positions[3 * i];
            y[i] = positions[3 * i + 1];
            z[i] = positions[3 * i + 2];
        }
        for (float* axis : {x, y, z}) {
            axis[-1] = axis[0];
            axis[columns] = axis[columns - 1];
        }
    }
    /// x, y or z from the first point on.
    const float* axis(std::size_t k) const { return &values_[k * stride_ + 1]; }

private:
    std::vector<float> values_;
    std::size_t stride_;
};

void normals_of_row(std::size_t columns, const PaddedRow& above, const PaddedRow& row, const PaddedRow& below,
                    float* __restrict normals) {
    const float *ax = above.axis(0), *ay = above.axis(1), *az = above.axis(2);
    const float *x = row.axis(0), *y = row.axis(1), *z = row.axis(2);
    const float *bx = below.axis(0), *by = below.axis(1), *bz = below.axis(2);
    for (std::size_t i = 0; i < columns; ++i) {
        const Ways e{{x[i + 1] - x[i], y[i + 1] - y[i], z[i + 1] - z[i]},
                     {ax[i + 1] - x[i], ay[i + 1] - y[i], az[i + 1] - z[i]},
                     {ax[i] - x[i], ay[i] - y[i], az[i] - z[i]},
                     {x[i - 1] - x[i], y[i - 1] - y[i], z[i - 1] - z[i]},
                     {bx[i - 1] - x[i], by[i - 1] - y[i], bz[i - 1] - z[i]},
                     {bx[i] - x[i], by[i] - y[i], bz[i] - z[i]}};
        const glm::vec3 n = unit_or_up(area_around(e));
        normals[3 * i] = n.x;
        normals[3 * i + 1] = n.y;
        normals[3 * i + 2] = n.z;
    }
}

/// The same where points are left out.
void normals_of_usable(int columns, int rows, std::span<const float> positions, std::span<const std::uint8_t> usable,
                       std::span<float> normals) {
    const auto at = [&](std::size_t i) {
        return glm::vec3(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    };
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const auto i = static_cast<std::size_t>(row * columns + column);
            const auto way = [&](int across, int down) {
                const int c = column + across, r = row + down;
                const auto other = static_cast<std::size_t>(r * columns + c);
                const bool there = c >= 0 && c < columns && r >= 0 && r < rows;
                return there && usable[i] != 0 && usable[other] != 0 ? at(other) - at(i) : glm::vec3(0);
            };
            const Ways e{way(1, 0), way(1, -1), way(0, -1), way(-1, 0), way(-1, 1), way(0, 1)};
            const glm::vec3 n = unit_or_up(area_around(e));
            std::copy_n(&n[0], 3, &normals[3 * i]);
        }
    }
}

} // namespace

std::size_t find_drawable(std::span<const float> positions, std::vector<std::uint8_t>& usable) {
    const std::size_t points = positions.size() / 3;
    const auto bad = [](float value) { return !(std::abs(value) <= drawable_range); }; // as NaN is
    std::uint32_t bad_values = 0;
    for (const float value : positions)
        bad_values += bad(value) ? 1u : 0u;
    usable.assign(points, 1);
    if (bad_values == 0)
        return 0;
    std::size_t bad_points = 0;
    for (std::size_t i = 0; i < points; ++i) {
        if (bad(positions[3 * i]) || bad(positions[3 * i + 1]) || bad(positions[3 * i + 2])) {
            usable[i] = 0;
            ++bad_points;
        }
    }
    return bad_points;
}

void cloth_normals(int columns, int rows, std::span<const float> positions, std::span<const std::uint8_t> usable,
                   std::span<float> normals) {
    if (!usable.empty())
        return normals_of_usable(columns, rows, positions, usable, normals);
    const auto width = static_cast<std::size_t>(columns), height = static_cast<std::size_t>(rows);
    if (width == 0 || height == 0)
        return;
    std::array<PaddedRow, 3> window{PaddedRow(width), PaddedRow(width), PaddedRow(width)};
    PaddedRow *above = &window[0], *row = &window[1], *below = &window[2];
    above->set(&positions[0]);
    row->set(&positions[0]);
    for (std::size_t r = 0; r < height; ++r) {
        below->set(&positions[3 * width * std::min(r + 1, height - 1)]);
        normals_of_row(width, *above, *row, *below, &normals[3 * width * r]);
        std::swap(above, row);
        std::swap(row, below);
    }
}

void cloth_tangents(int columns, int rows, std::span<const float> positions, std::span<const std::uint8_t> usable,
                    std::span<float> tangents) {
    const auto width = static_cast<std::size_t>(columns);
    const auto good = [&](std::size_t i) { return usable.empty() || usable[i] != 0; };
    const auto set = [&](std::size_t row, std::size_t column) {
        const std::size_t i = row * width + column;
        const std::size_t left = column > 0 && good(i - 1) ? i - 1 : i;
        const std::size_t right = column + 1 < width && good(i + 1) ? i + 1 : i;
        const bool any = good(i) && right > left;
        const float scale = any ? static_cast<float>(width - 1) / static_cast<float>(right - left) : 0.f;
        for (std::size_t k = 0; k < 3; ++k)
            tangents[3 * i + k] = any ? scale * (positions[3 * right + k] - positions[3 * left + k]) : 0.f;
    };
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
        if (!usable.empty() || width < 3) {
            for (std::size_t column = 0; column < width; ++column)
                set(row, column);
            continue;
        }
        set(row, 0);
        const float scale = static_cast<float>(width - 1) / 2;
        const float* p = &positions[3 * width * row];
        float* t = &tangents[3 * width * row];
        for (std::size_t k = 3; k < 3 * (width - 1); ++k)
            t[k] = scale * (p[k + 3] - p[k - 3]);
        set(row, width - 1);
    }
}

} // namespace clothlab::render
