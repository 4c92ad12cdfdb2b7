// Memory of the self-collision stage.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/aligned.h"

namespace clothlab::sim {

/// Cells of the plain loops: per cell slot a chain of points in index order.
struct CellLists {
    std::vector<std::int32_t> first; ///< per slot, -1 when empty; the size is a power of two
    std::vector<std::int32_t> next;  ///< per point, -1 at the end
};

template <class Real>
struct SelfCollisionWork {
    // Plain loops.
    Vec3Array<Real> cell; ///< cell coordinates, whole numbers
    CellLists lists;

    // Kernels. The points where they were when the list of pairs was made: as long as no two points have moved against
    // each other by more than the skin since, a pair that is not on the list is out of reach.
    Vec3Array<Real> anchor;
    bool anchored = false;
    double skin = 0;                                 ///< m, of the list as it is
    double anchor_bound = 0;                         ///< m, largest coordinate of the anchor
    double coordinate_bound = 1;                     ///< m, no coordinate is expected to be larger
    std::vector<std::array<std::uint32_t, 2>> pairs; ///< those on the list; none that are neighbours in the grid
    int give_up = 0; ///< so many steps without a list, since it would have been too long

    std::vector<std::uint8_t> near;    ///< per point
    std::vector<std::uint32_t> active; ///< points that may push or be pushed, ascending
    // Points sorted by hash bucket or, while the list is made, by cell.
    std::vector<std::uint32_t> bucket, order, bucket_end;
    Vec3Array<Real> sorted, sorted_cells;
};

} // namespace clothlab::sim
