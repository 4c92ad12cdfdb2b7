// The vector kernels behind the stages of a step, compiled for several instruction sets and chosen at run time
// (sim/execution.h). Each gives the very bits of the plain loops: it does the same IEEE operations on every value in
// the same order, and no fused multiply-add. docs/performance.md explains how.
//
// All of them see the grid as one flat array of points, index = row * columns + column, in vectors that run across the
// ends of rows. What a point at a border has no neighbour for is masked by lane; so no row is padded, and a 50 x 50
// cloth wastes no lane of a 16-lane vector but in its last one.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "sim/execution.h"
#include "sim/grid.h"

namespace clothlab::sim {

/// Rest lengths by stencil entry, to be read at [spring][point & mask]: with a mask of zero, a vector full of the one
/// length that all springs of that entry share.
template <class Real>
struct RestLengths {
    std::array<const Real*, stencil_size> of;
    std::size_t mask;
};

template <class Real>
RestLengths<Real> rest_lengths(const Grid<Real>& grid) {
    RestLengths<Real> rest{{}, grid.rest_mask};
    for (std::size_t s = 0; s < stencil_size; ++s)
        rest.of[s] = grid.rest[s].data();
    return rest;
}

template <class Real>
using ConstAxes = std::array<const Real*, 3>;
template <class Real>
using Axes = std::array<Real*, 3>;

enum class SweepSink : std::uint8_t {
    verlet_damped, ///< move the points: x + keep (x - p) + f c
    verlet,        ///< the same with keep = 1, which costs no multiplication
    force,         ///< write the forces
};

/// One sweep over points [begin, end): the spring forces on each, in the order of the edge list, and what becomes of
/// them. Springs of up to two rows further are computed too, so that ranges do not depend on each other.
template <class Real>
struct SweepArguments {
    ConstAxes<Real> x;  ///< positions now, m
    Axes<Real> out;     ///< Verlet: in, previous positions, out, next positions; force: out, N
    std::size_t points; ///< of the whole grid
    std::size_t columns;
    std::size_t begin, end; ///< begin is 0, or at least two rows and a multiple of sweep_grain
    RestLengths<Real> rest;
    Real k, bending_k;           ///< N/m
    std::array<Real, 3> gravity; ///< m g, N; no component may be -0
    Real keep, c;
    Real* scratch; ///< sweep_scratch(columns) values
};

inline constexpr std::size_t sweep_grain = 64;
/// Values of scratch memory per axis: for a window of unfinished forces, two rows and more, and for a copy of the first
/// two rows, with two rows before them.
constexpr std::ptrdiff_t sweep_window(std::size_t columns) {
    return static_cast<std::ptrdiff_t>((4 * columns + 16 * sweep_grain) / sweep_grain * sweep_grain);
}
constexpr std::ptrdiff_t sweep_head(std::size_t columns) {
    return static_cast<std::ptrdiff_t>(4 * columns + sweep_grain);
}
/// How many values of scratch memory a sweep needs, zero at first.
constexpr std::size_t sweep_scratch(std::size_t columns) {
    return 3 * static_cast<std::size_t>(sweep_window(columns) + sweep_head(columns));
}

template <class Real>
struct SphereModel;
template <class Real>
struct PlaneModel;

/// Points [begin, end) against one collider. Pins are not told apart: the caller puts them back.
template <class Real>
struct ContactArguments {
    Axes<Real> x;
    ConstAxes<Real> previous;
    std::size_t begin, end;
    const std::uint8_t* pinned; ///< per point; null when none is
};

template <class Real>
struct LimitArguments {
    Axes<Real> x;
    std::size_t points, columns;
    RestLengths<Real> rest;
    const std::uint8_t* pinned; ///< per point
};

/// Where points near each other are, among those that are neighbours in the grid (or diagonal ones), and how far
/// points have moved against each other since `anchor`.
/// Threads may mark the same point at once, always with the same value.
inline void mark_near(std::uint8_t* near, std::size_t i) {
    std::atomic_ref(near[i]).store(1, std::memory_order_relaxed);
}

template <class Real>
struct ProximityArguments {
    ConstAxes<Real> x;
    ConstAxes<Real> anchor; ///< null: no displacements wanted
    std::size_t points, columns;
    std::size_t begin, end;
    Real reach_squared;            ///< m²: nearer pairs are marked
    std::uint8_t* near;            ///< per point: 1 where it may be in such a pair; only ever set here
    std::array<Real, 3> low, high; ///< out: bounds of x - anchor
    std::size_t pairs = 0;         ///< out: pairs marked
};

/// The course's self-collision among points that lie sorted by cell.
template <class Real>
struct CellArguments {
    ConstAxes<Real> x;           ///< of all points
    const std::uint32_t* active; ///< indices of the points that take part, ascending
    std::size_t count;           ///< how many
    std::array<Real, 3> cell;    ///< m, sizes of a cell
    std::uint32_t bucket_mask;   ///< number of buckets - 1
    std::uint32_t* bucket;       ///< out, per active point
};

template <class Real>
struct CellPassArguments {
    Axes<Real> x;                          ///< of all points; moved
    Axes<Real> sorted;                     ///< positions by bucket, moved along; a vector of padding behind
    ConstAxes<Real> cells;                 ///< cell coordinates by bucket; NaN behind
    const std::uint32_t* order;            ///< point of each sorted entry
    const std::uint32_t* bucket_end;       ///< per bucket; it begins where the one before ends
    std::size_t first_bucket, last_bucket; ///< half open
    const std::uint8_t* pinned;            ///< per point
    Real apart;                            ///< m, twice the thickness
    Real substeps;
};

template <class Real>
struct Kernels {
    std::size_t lanes;
    /// By set of spring kinds (bits of SpringKind), then sink.
    std::array<std::array<void (*)(const SweepArguments<Real>&), 3>, 8> sweep;
    std::size_t (*sphere)(const ContactArguments<Real>&, const SphereModel<Real>&);
    std::size_t (*plane)(const ContactArguments<Real>&, const PlaneModel<Real>&);
    /// The first vector of points in [from, to), after the first two rows, of which some own spring may be over the
    /// limit; `points` when there is none.
    std::size_t (*first_over_limit)(const LimitArguments<Real>&, std::size_t from, std::size_t to);
    /// The sweep, when it is known of all points from the third row on but before `from` that none is over the limit.
    std::size_t (*limit)(const LimitArguments<Real>&, std::size_t from);
    void (*proximity)(ProximityArguments<Real>&);
    /// Finds the hash bucket of each active point's cell.
    void (*buckets)(const CellArguments<Real>&);
    /// Finds the cells of so many points that lie side by side, a multiple of a vector or less than one over: whole
    /// numbers.
    void (*cells)(const CellArguments<Real>&, ConstAxes<Real> x, std::size_t count, Axes<Real> cells);
    std::size_t (*cell_pass)(const CellPassArguments<Real>&);
};

/// The kernels of a set that is_supported(); null for `scalar`, which has none.
template <class Real>
const Kernels<Real>* kernels(InstructionSet set);

template <>
const Kernels<float>* kernels<float>(InstructionSet set);
template <>
const Kernels<double>* kernels<double>(InstructionSet set);

} // namespace clothlab::sim
