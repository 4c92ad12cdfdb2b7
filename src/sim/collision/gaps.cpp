// All pairs within a reach by cells of its size, each compared with the cells around it (M. P. Allen, D. J. Tildesley,
// "Computer simulation of liquids" (1987), section 5.3.2). The points are sorted by cell, x fastest, so that three
// cells side by side are one run of points, which is compared a vector at a time.
#include "sim/collision/gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace clothlab::sim {
namespace {

constexpr float far_away = std::numeric_limits<float>::infinity();

/// Cells of space as wide as the reach: those of the box around all points or, where these would be too many, a part
/// of them that repeats itself, so that a few points that have flown off do not make the others' cells wide.
struct Cells {
    std::array<double, 3> low{};
    std::array<std::size_t, 3> count{};
    double width = 1;

    Cells(std::span<const float> positions, double reach) : width(reach) {
        std::array<double, 3> wanted{};
        for (std::size_t k = 0; k < 3; ++k) {
            float from = far_away, to = -far_away;
            for (std::size_t i = k; i < positions.size(); i += 3) {
                if (std::isfinite(positions[i])) {
                    from = std::min(from, positions[i]);
                    to = std::max(to, positions[i]);
                }
            }
            low[k] = from <= to ? static_cast<double>(from) : 0;
            wanted[k] = from <= to ? std::floor((static_cast<double>(to) - low[k]) / width) + 1 : 1;
        }
        const double most = 2 * static_cast<double>(positions.size() / 3) + 64;
        while (wanted[0] * wanted[1] * wanted[2] > most) {
            double& largest = *std::max_element(wanted.begin(), wanted.end());
            largest = std::floor(largest / 2);
        }
        for (std::size_t k = 0; k < 3; ++k)
            count[k] = static_cast<std::size_t>(wanted[k]);
    }
    std::size_t total() const { return count[0] * count[1] * count[2]; }
    std::size_t of(const float* p) const {
        std::array<std::size_t, 3> c;
        for (std::size_t k = 0; k < 3; ++k) {
            const double n = static_cast<double>(count[k]),
                         cell = std::floor((static_cast<double>(p[k]) - low[k]) / width);
            c[k] = static_cast<std::size_t>(cell < n ? cell : std::fmod(cell, n));
        }
        return (c[2] * count[1] + c[1]) * count[0] + c[0];
    }
};

/// The cells c - 1, c and c + 1 of n that repeat themselves, each once.
struct Around {
    std::array<std::size_t, 3> cell;
    std::size_t count;

    Around(std::size_t c, std::size_t n) : cell{c > 0 ? c - 1 : n - 1, c, c + 1 < n ? c + 1 : 0}, count(3) {
        if (n < 3) {
            cell = {0, 1, 0};
            count = n;
        }
    }
    const std::size_t* begin() const { return cell.data(); }
    const std::size_t* end() const { return cell.data() + count; }
};

/// Points sorted by cell; u and v are their places in the flat cloth.
struct Sorted {
    std::vector<std::uint32_t> begin; ///< per cell, and the end of the last one
    std::vector<std::uint32_t> point;
    std::vector<float> x, y, z, u, v;

    Sorted(const FlatGrid& grid, std::span<const float> positions, const Cells& cells) : begin(cells.total() + 1) {
        const std::size_t points = positions.size() / 3, columns = static_cast<std::size_t>(grid.columns);
        std::vector<std::uint32_t> cell(points);
        const auto none = static_cast<std::uint32_t>(cells.total());
        for (std::size_t i = 0; i < points; ++i) {
            const float* p = &positions[3 * i];
            const bool finite = std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
            cell[i] = finite ? static_cast<std::uint32_t>(cells.of(p)) : none;
            if (finite)
                ++begin[cell[i]];
        }
        std::uint32_t sum = 0;
        for (std::uint32_t& count : begin) {
            const std::uint32_t here = count;
            count = sum;
            sum += here;
        }
        for (std::vector<float>* values : {&x, &y, &z, &u, &v})
            values->resize(sum);
        point.resize(sum);
        std::vector<std::uint32_t> next(begin.begin(), begin.end());
        for (std::size_t i = 0; i < points; ++i) {
            if (cell[i] == none)
                continue;
            const std::uint32_t at = next[cell[i]]++;
            point[at] = static_cast<std::uint32_t>(i);
            x[at] = positions[3 * i];
            y[at] = positions[3 * i + 1];
            z[at] = positions[3 * i + 2];
            u[at] = static_cast<float>(i % columns) * grid.spacing_x;
            v[at] = static_cast<float>(i / columns) * grid.spacing_y;
        }
    }

    /// The smallest squared distance of a point to those of a run that are further away than `near` in the flat cloth.
    float nearest(std::size_t i, std::size_t from, std::size_t to, float near_squared) const {
        constexpr std::size_t lanes = 8;
        const auto squared = [&](std::size_t k) {
            const float dx = x[k] - x[i], dy = y[k] - y[i], dz = z[k] - z[i], du = u[k] - u[i], dv = v[k] - v[i];
            const float flat = du * du + dv * dv;
            return flat > near_squared ? dx * dx + dy * dy + dz * dz : far_away;
        };
        std::array<float, lanes> best;
        best.fill(far_away);
        for (; from + lanes <= to; from += lanes) {
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                const float candidate = squared(from + lane);
                best[lane] = candidate < best[lane] ? candidate : best[lane];
            }
        }
        for (; from < to; ++from)
            best[0] = std::min(best[0], squared(from));
        return *std::min_element(best.begin(), best.end());
    }
};

} // namespace

void point_gaps(const FlatGrid& grid, std::span<const float> positions, float thickness, std::vector<float>& gaps) {
    const float reach = gap_reach * std::max(0.f, thickness), touching = 2 * thickness;
    gaps.assign(positions.size() / 3, reach - touching);
    if (!(reach > 0) || !std::isfinite(reach))
        return;
    const float near =
        std::max(reach * reach, grid.spacing_x * grid.spacing_x + grid.spacing_y * grid.spacing_y) * 1.0001f;
    const Cells cells(positions, static_cast<double>(reach) * 1.0001);
    const Sorted sorted(grid, positions, cells);
    const auto [nx, ny, nz] = cells.count;
    std::vector<std::array<std::uint32_t, 2>> runs; // of points, around a cell
    for (std::size_t cell = 0; cell < cells.total(); ++cell) {
        if (sorted.begin[cell] == sorted.begin[cell + 1])
            continue;
        runs.clear();
        for (const std::size_t z : Around(cell / (nx * ny), nz)) {
            for (const std::size_t y : Around(cell / nx % ny, ny)) {
                for (const std::size_t x : Around(cell % nx, nx)) {
                    const std::size_t other = (z * ny + y) * nx + x;
                    const std::uint32_t from = sorted.begin[other], to = sorted.begin[other + 1];
                    if (!runs.empty() && runs.back()[1] == from)
                        runs.back()[1] = to;
                    else
                        runs.push_back({from, to});
                }
            }
        }
        for (std::size_t i = sorted.begin[cell]; i < sorted.begin[cell + 1]; ++i) {
            float best = reach * reach;
            for (const auto& [from, to] : runs)
                best = std::min(best, sorted.nearest(i, from, to, near));
            gaps[sorted.point[i]] = std::sqrt(best) - touching;
        }
    }
}

} // namespace clothlab::sim
