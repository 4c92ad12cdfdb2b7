// Memory of the self-collision stage.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "sim/aligned.h"
#include "sim/collision/back_off.h"
#include "sim/collision/block_tree.h"
#include "sim/collision/regular_blocks.h"
#include "sim/kernels/kernels.h"

namespace clothlab::sim {

/// Cells of the plain loops: per cell slot a chain of points in index order.
struct CellLists {
    std::vector<std::int32_t> first; ///< per slot, -1 when empty; the size is a power of two
    std::vector<std::int32_t> next;  ///< per point, -1 at the end
};

template <class Real>
struct SelfCollisionWork {
    // Plain loops over points.
    Vec3Array<Real> cell; ///< cell coordinates, whole numbers
    CellLists lists;

    BlockTree<Real> tree; ///< of the rule for triangles

    // Kernels. The points where they were when the list of pairs was made: as long as no two points have moved against
    // each other by more than the skin since, a pair that is not on the list is out of reach.
    Vec3Array<Real> anchor;
    bool anchored = false;
    double skin = 0;                                       ///< m
    double anchor_bound = 0;                               ///< m, largest coordinate of the anchor
    double coordinate_bound = 1;                           ///< m, no coordinate is expected to be larger
    double push = std::numeric_limits<double>::infinity(); ///< m, no point is expected to be pushed farther
    int age = 0;                                           ///< steps since the list was made
    BackOff list_rests;                                    ///< since it was too long or did not last
    std::vector<PointPair> far_pairs;                      ///< the list: none that are neighbours in the grid

    // Few contacts: pair by pair.
    std::vector<PointPair> pairs;        ///< room for those that may touch in this step
    std::size_t pair_count = 0;          ///< so many first ones do
    std::vector<std::uint32_t> cursor;   ///< per point; all zero between steps
    std::vector<std::uint64_t> active;   ///< a bit per point; all zero between steps
    std::vector<std::uint32_t> partners; ///< of the active points, one after the other

    // Points sorted by cell: while the list is made, and many contacts. Then there is no list, and `anchor` has the
    // cells of all points as whole numbers where their keys do not tell them apart.
    RegularBlocks<Real> blocks;           ///< which points are to be sorted
    double blocks_bound = 1;              ///< m, no coordinate is expected to be larger
    BackOff blocks_rest;                  ///< all points are sorted, since nearly all were to be
    AlignedVector<std::uint32_t> key;     ///< of each point's cell
    std::vector<std::uint32_t> order;     ///< points by cell
    std::vector<std::uint32_t> cell_end;  ///< per cell, or bucket of cells
    bool dense = false;                   ///< in the last step most points of a bucket pushed each other
    AlignedVector<std::uint32_t> run_end; ///< of points that follow each other in a cell
    std::vector<PointSpan> buckets;       ///< of several points, in `order`
    AlignedVector<std::byte> sorted;      ///< the list: four Reals per point; many contacts: a place per point

    /// Three coordinates and the index, each a vector of padding behind.
    std::array<Real*, 4> sorted_axes() {
        Real* first = reinterpret_cast<Real*>(sorted.data());
        const std::size_t room = sorted.size() / (4 * sizeof(Real));
        return {first, first + room, first + 2 * room, first + 3 * room};
    }
    /// Places of all points (Kernels::cell_keys).
    CellPlace* places() { return reinterpret_cast<CellPlace*>(sorted.data()); }
};

} // namespace clothlab::sim
