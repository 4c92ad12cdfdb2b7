// The cloth's topology: which masses there are, which springs tie them, which triangles they span. Immutable for a run.
#pragma once

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
inline constexpr SpringStencil spring_stencil[] = {
    {0, -1, SpringKind::structural}, {-1, 0, SpringKind::structural}, {-1, -1, SpringKind::shear},
    {1, -1, SpringKind::shear},      {-2, 0, SpringKind::bending},    {0, -2, SpringKind::bending},
};

/// Calls visit(a, b, kind) for every spring of a grid, in order.
template <class Visit>
void for_each_spring(int columns, int rows, Visit visit) {
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            for (const SpringStencil& s : spring_stencil) {
                const int to_column = column + s.columns, to_row = row + s.rows;
                if (to_column < 0 || to_column >= columns || to_row < 0)
                    continue;
                visit(static_cast<std::uint32_t>(row * columns + column),
                      static_cast<std::uint32_t>(to_row * columns + to_column), s.kind);
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

/// Springs as parallel arrays: ends, rest length in m, kind.
template <class Real>
struct Springs {
    std::vector<std::uint32_t> a, b;
    AlignedVector<Real> rest;
    std::vector<SpringKind> kind;
    std::size_t size() const { return a.size(); }
};

/// Masses, springs and start positions of a cloth in one precision.
template <class Real>
struct Grid {
    int columns = 0, rows = 0;
    Springs<Real> springs;
    Vec3Array<Real> start;
    std::size_t points() const { return start.size(); }
};

/// Builds the grid that the description asks for; throws std::invalid_argument when it has fewer than two columns or
/// rows, or a size that is not positive.
template <class Real>
Grid<Real> make_grid(const Description& description);

extern template Grid<float> make_grid<float>(const Description&);
extern template Grid<double> make_grid<double>(const Description&);

} // namespace clothlab::sim
