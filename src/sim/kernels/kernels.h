// The vector kernels behind the stages of a step, compiled for several instruction sets and chosen at run time
// (sim/execution.h). Each gives the very bits of the plain loops: it does the same IEEE operations on every value in
// the same order, and no fused multiply-add. docs/performance.md explains how.
//
// All of them see the grid as one flat array of points, index = row * columns + column, in vectors that run across the
// ends of rows. What a point at a border has no neighbour for is masked by lane; so no row is padded, and a 50 x 50
// cloth wastes no lane of a 16-lane vector but in its last one.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

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
    /// Unless null, called with `context` before positions from `end` on are read. The range is sweep_least(columns)
    /// points long at least then.
    void (*before_end)(void* context);
    void* context;
};

inline constexpr std::size_t sweep_grain = 64;
/// Of a range whose end is waited for: no point beyond it is read before so many points were gone through.
constexpr std::size_t sweep_least(std::size_t columns) {
    return 2 * columns + sweep_grain;
}

/// Of a sweep's ring of unfinished forces: slots, two rows and three vectors at least, a power of two; the room before
/// and behind them, a vector; how far one of its arrays is from the next. That is an odd number of the widest vectors,
/// so that no two have the same place in the first-level cache, and the same for all cloths that are not wide.
inline constexpr std::ptrdiff_t sweep_ring_margin = 16, sweep_ring_narrow = 368;
constexpr std::ptrdiff_t sweep_ring_length(std::size_t columns) {
    return static_cast<std::ptrdiff_t>(std::bit_ceil(2 * columns + 4 * sweep_ring_margin));
}
constexpr std::ptrdiff_t sweep_ring_stride(std::size_t columns) {
    const std::ptrdiff_t least = sweep_ring_length(columns) + 3 * sweep_ring_margin;
    return least < sweep_ring_narrow ? sweep_ring_narrow : least;
}
/// Values of scratch memory: for the ring's twelve arrays and, per axis, for a copy of the first two rows, with two
/// rows before them.
constexpr std::ptrdiff_t sweep_ring(std::size_t columns) {
    return 12 * sweep_ring_stride(columns);
}
constexpr std::ptrdiff_t sweep_head(std::size_t columns) {
    return static_cast<std::ptrdiff_t>(4 * columns + sweep_grain);
}
/// How many values of scratch memory a sweep needs.
constexpr std::size_t sweep_scratch(std::size_t columns) {
    return static_cast<std::size_t>(sweep_ring(columns) + 3 * sweep_head(columns));
}

template <class Real>
struct SphereModel;
template <class Real>
struct PlaneModel;

/// Points [begin, end) against one collider.
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
    bool filter;                ///< the rest lengths may be squared (may_filter_limit)
};

/// One band of rows of the limit's wavefront (sim/limit_bands.h).
template <class Real>
struct BandArguments {
    Axes<Real> points; ///< the band's first row, of all points
    Axes<Real> x;      ///< memory for a copy: slot 0 of the first row
    const Real* free;  ///< as x: 1 for points that may be moved and 0 for others; null where all may
    const Real* rest;  ///< m, by slot, spring and row, infinite where there is no spring; null where all are alike
    std::array<Real, stencil_size> rest_of_all; ///< m, of alike springs
    const std::uint32_t* exists;                ///< alike springs: by slot and spring a bit for each row
    std::ptrdiff_t columns, above, rows;        ///< rows above that springs reach, rows of the band
};

/// Two points, by their indices.
using PointPair = std::array<std::uint32_t, 2>;

/// Which points in [begin, end) are near their neighbours in the grid (diagonal ones too, each pair found at the later
/// point), and how far points have moved against each other since `anchor`.
template <class Real>
struct ProximityArguments {
    ConstAxes<Real> x;
    ConstAxes<Real> anchor; ///< null: no displacements wanted
    std::size_t points, columns;
    std::size_t begin, end;
    Real reach_squared;            ///< m²: pairs that are not at least so far apart are near
    PointPair* pairs;              ///< out
    std::size_t most_pairs;        ///< beyond these, pairs are counted but not written
    std::array<Real, 3> low, high; ///< out: bounds of x - anchor
    std::size_t count = 0;         ///< out: near pairs
};

/// Rows and columns of a block (BlockShape).
inline constexpr std::size_t block_side = 16;

/// What bounds the points of a block of the grid and the edges that end there: x, y and z in m of the points, of the
/// edges to them from the column before, and of those from the row before.
template <class Real>
struct BlockShape {
    std::array<Real, 9> low, high;
};
/// Of a block: some edge that ends there may be a contact; one from the block before; one from the block above;
/// some number is not finite.
enum BlockFlag : std::uint8_t { block_near = 1, block_near_before = 2, block_near_above = 4, block_not_finite = 8 };

/// Blocks of a grid, row by row; the last of a row and of a column may be smaller. A shape may be larger than it need
/// be by points and edges of the blocks around, and so may flags be true.
template <class Real>
struct BlockArguments {
    ConstAxes<Real> x;
    std::size_t columns, rows; ///< of points; more columns than block_side, two rows or more
    std::size_t begin, end;    ///< rows of blocks
    Real reach_squared;        ///< m²: edges that are not at least so long are near
    BlockShape<Real>* shapes;  ///< out: of all blocks of the grid
    std::uint8_t* flags;       ///< out: BlockFlags, of all blocks of the grid
};

/// All pairs nearer than `reach` of points that lie sorted by the cells of a box, each cell at least that wide, but for
/// those that are neighbours in the grid (diagonal ones too).
template <class Real>
struct FarPairArguments {
    ConstAxes<Real> sorted;             ///< positions by cell, x fastest; a vector of padding behind
    const std::uint32_t* order;         ///< point of each sorted entry
    const Real* index;                  ///< the same as Real
    const std::uint32_t* cell_end;      ///< per cell; it begins where the one before ends
    std::array<std::uint32_t, 3> cells; ///< along x, y, z
    std::uint32_t columns;              ///< of the grid
    Real reach_squared;                 ///< m²
    PointPair* pairs;                   ///< out
    std::size_t most_pairs;
};

/// Points and the size of the cells they lie in.
template <class Real>
struct CellArguments {
    ConstAxes<Real> x;
    std::size_t count;        ///< how many points
    std::array<Real, 3> cell; ///< m
};

template <class Real>
struct KeptPairs {
    std::size_t count = 0;
    Real least_squared = std::numeric_limits<Real>::infinity(); ///< m²
};

/// Of the cells that points lie in, and of their keys.
template <class Real>
struct CellKeys {
    std::array<Real, 3> low, high; ///< bounds of the cells, whole numbers
    Real largest;                  ///< coordinate of a point, m
    bool exact;                    ///< no two cells have the same key
};

/// Points from one to before another.
struct PointSpan {
    std::uint32_t begin, end;
};

/// Spans of points: ascending, none empty, at least one.
struct PointSpans {
    const PointSpan* spans;
    std::size_t count;  ///< spans
    std::size_t points; ///< in all of them
    const PointSpan* begin() const { return spans; }
    const PointSpan* end() const { return spans + count; }
};

/// Where a point lies in its cell: x, y and z from the cell's corner in units, 32767 of which are the cell's longest
/// side, and which of the cells of its bucket that is.
struct alignas(8) CellPlace {
    std::uint16_t x, y, z, cell;
};
inline constexpr int cell_units = 32767;
/// Points whose place is not a number have this for a cell.
inline constexpr std::uint32_t no_cell = 0xffff;

/// Points of which the cells are wanted. All arrays that are written have a vector of padding behind, and others than
/// the points of the spans may be written, too.
template <class Real>
struct CellKeyArguments {
    ConstAxes<Real> x;
    PointSpans points;
    std::array<Real, 3> size; ///< m, of a cell
    int bucket_bits;          ///< so many lowest bits of a key tell the bucket
    Axes<Real> cell;          ///< out, only if keys are not exact: the cells, whole numbers
    std::uint32_t* key;       ///< out: of each point's cell
    CellPlace* places;        ///< out: of each point in its cell
};

/// Points to be sorted by the lowest bits of their keys.
struct BucketSortArguments {
    const std::uint32_t* key; ///< of each point, a vector of padding behind
    PointSpans points;        ///< which are sorted
    std::uint32_t mask;       ///< of the bits
    std::uint32_t* run_end;   ///< memory: one per point and a vector of padding
    std::uint32_t* next;      ///< memory: one per bucket
    std::uint32_t* order;     ///< out: points by bucket, ascending in each
    PointSpan* buckets;       ///< out: those of several points, ascending; room for one more than there are buckets
};
struct BucketList {
    std::size_t count, largest; ///< buckets of several points; points of the largest bucket
    std::uint64_t pairs;        ///< of points of one bucket, counted from both
};

/// The course's self-collision among points that lie sorted by buckets of cells. Which may touch is looked up in whole
/// units, whatever Real is, with a reach that allows for it.
template <class Real>
struct CellPassArguments {
    Axes<Real> x;                                 ///< of all points; moved
    const std::uint32_t* key;                     ///< of all points
    const CellPlace* places;                      ///< of all points
    const std::uint32_t* order;                   ///< points by bucket; ascending in each
    ConstAxes<Real> cell;                         ///< of each point, whole numbers, unless `exact`
    bool exact;                                   ///< the places tell the cells of a bucket apart
    const PointSpan *buckets_begin, *buckets_end; ///< ascending, those of one point left out
    std::size_t largest_bucket;                   ///< points
    const std::uint8_t* pinned;                   ///< per point
    Real apart;                                   ///< m, twice the thickness
    Real reach_squared; ///< m²: points that are not nearer at the beginning do not get nearer than `apart`
    /// The same in units: points for which the sum of the squares, each over 65536 and rounded down, is not larger.
    std::int16_t near;
    Real touching_squared; ///< m²: points that are not nearer are not nearer than `apart`, whatever is rounded
    Real substeps;
    bool dense; ///< most points of a bucket are near each other
};

template <class Real>
struct Kernels {
    /// By set of spring kinds (bits of SpringKind), then sink.
    std::array<std::array<void (*)(const SweepArguments<Real>&), 3>, 8> sweep;
    std::size_t (*sphere)(const ContactArguments<Real>&, const SphereModel<Real>&);
    std::size_t (*plane)(const ContactArguments<Real>&, const PlaneModel<Real>&);
    /// The first vector of points in [from, to), after the first two rows, of which some own spring may be over the
    /// limit; `points` when there is none.
    std::size_t (*first_over_limit)(const LimitArguments<Real>&, std::size_t from, std::size_t to);
    /// The sweep, when it is known of all points from the third row on but before `from` that none is over the limit.
    std::size_t (*limit)(const LimitArguments<Real>&, std::size_t from);
    /// The sweep over one band. Returns how many springs it shortened.
    std::size_t (*limit_band)(const BandArguments<Real>&);
    void (*proximity)(ProximityArguments<Real>&);
    /// Returns how many pairs there are; most_pairs + 1 when there are more than most_pairs.
    std::size_t (*far_pairs)(const FarPairArguments<Real>&);
    /// Keeps, in order, those of `count` pairs whose points are not at least the reach apart and lie in the same cell;
    /// returns how many, and the square of the least distance of such a pair.
    KeptPairs<Real> (*keep_pairs)(const CellArguments<Real>&, Real reach_squared, PointPair* pairs, std::size_t count);
    void (*block_shapes)(const BlockArguments<Real>&);
    CellKeys<Real> (*cell_keys)(const CellKeyArguments<Real>&);
    BucketList (*sort_by_bucket)(const BucketSortArguments&);
    /// Applies the rule to each bucket, all its points in order. Returns the number of pushes.
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
