// The cloth's topology: which masses there are, which springs tie them, which triangles they span. Immutable for a run.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/aligned.h"
#include "sim/description.h"

namespace clothlab::sim {

enum class SpringKind : std::uint8_t { structural, shear, bending };
inline constexpr int spring_kinds = 3;

/// Bending springs are this much of ks.
inline constexpr double bending_share = 0.2;

/// The six springs that a mass owns: to masses before it in row-major order, in the order of the strain limit.
struct SpringStencil {
    int columns, rows;
    SpringKind kind;
};
inline constexpr std::size_t stencil_size = 6;
inline constexpr std::array<SpringStencil, stencil_size> spring_stencil{{
    {0, -1, SpringKind::structural},
    {-1, 0, SpringKind::structural},
    {-1, -1, SpringKind::shear},
    {1, -1, SpringKind::shear},
    {-2, 0, SpringKind::bending},
    {0, -2, SpringKind::bending},
}};

/// Calls visit(a, b, s) for every spring of a grid, in order; s is its entry in the stencil.
template <class Visit>
void for_each_spring(int columns, int rows, Visit visit) {
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            for (std::size_t i = 0; i < stencil_size; ++i) {
                const SpringStencil& s = spring_stencil[i];
                const int to_column = column + s.columns, to_row = row + s.rows;
                if (to_column < 0 || to_column >= columns || to_row < 0)
                    continue;
                visit(static_cast<std::uint32_t>(row * columns + column),
                      static_cast<std::uint32_t>(to_row * columns + to_column), i);
            }
        }
    }
}

/// Calls visit(a, b, c) for every triangle of a grid: each cell is split along the diagonal from its upper right to its
/// lower left mass. For horizontal cloth with y up, (b - a) x (c - a) points down.
template <class Visit>
void for_each_triangle(int columns, int rows, Visit visit) {
    for (int row = 0; row + 1 < rows; ++row) {
        for (int column = 0; column + 1 < columns; ++column) {
            const auto a = static_cast<std::uint32_t>(row * columns + column);
            const auto below = a + static_cast<std::uint32_t>(columns);
            visit(a, a + 1, below);
            visit(a + 1, below + 1, below);
        }
    }
}

/// The topology and rest lengths of a cloth in one precision. The springs are those of the stencil, so no list of them
/// is kept.
template <class Real>
struct Grid {
    int columns = 0, rows = 0;
    /// Per stencil entry: the rest length in m of each point's own spring, or, where all are alike, one vector full of
    /// that length.
    std::array<AlignedVector<Real>, stencil_size> rest;
    std::size_t rest_mask =
        0; ///< what to take of a point's index in those arrays: all bits, or none where all are alike
    Real shortest = 0, longest = 0; ///< of all rest lengths, m
    double diagonal = 0;            ///< m, of the start positions' first to their last point

    Real rest_length(std::size_t s, std::size_t point) const { return rest[s][point & rest_mask]; }
    std::size_t points() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
};

/// Builds the grid that the description asks for; throws std::invalid_argument when it has fewer than two columns or
/// rows, or a size that is not positive.
template <class Real>
Grid<Real> make_grid(const Description& description);

/// Where the points are at the beginning, in m.
template <class Real>
Vec3Array<Real> start_positions(const Description& description);

extern template Grid<float> make_grid<float>(const Description&);
extern template Grid<double> make_grid<double>(const Description&);
extern template Vec3Array<float> start_positions<float>(const Description&);
extern template Vec3Array<double> start_positions<double>(const Description&);

} // namespace clothlab::sim
