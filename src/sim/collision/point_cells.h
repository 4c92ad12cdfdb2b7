// Points sorted into cells of space, by a hash of the cell, for plain loops.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "sim/collision/self_collision_work.h"
#include "sim/random.h"
#include "sim/triple.h"

namespace clothlab::sim {

/// A cell is kept as whole numbers in Real: a position of 1e30 has a cell too, and NaN equals no cell at all.
template <class Real>
Triple<Real> cell_of(Triple<Real> position, Triple<Real> width) {
    // Adding zero turns -0 into 0: they are the same cell but not the same bits.
    return {std::floor(position.x / width.x) + Real(0), std::floor(position.y / width.y) + Real(0),
            std::floor(position.z / width.z) + Real(0)};
}

template <class Real>
std::uint64_t slot_of(Triple<Real> cell) {
    using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
    std::uint64_t hash = std::bit_cast<Bits>(cell.x);
    hash = SplitMix64::mix(hash) ^ std::bit_cast<Bits>(cell.y);
    hash = SplitMix64::mix(hash) ^ std::bit_cast<Bits>(cell.z);
    return SplitMix64::mix(hash);
}

/// Puts all points into work.cell and work.lists.
template <class Real>
void fill_cells(const Vec3Array<Real>& x, Triple<Real> width, SelfCollisionWork<Real>& work) {
    const std::uint64_t mask = work.lists.first.size() - 1;
    std::fill(work.lists.first.begin(), work.lists.first.end(), -1);
    // From the last point to the first, so that each chain is in index order.
    for (std::size_t i = x.size(); i-- > 0;) {
        const Triple<Real> cell = cell_of(at(x, i), width);
        put(work.cell, i, cell);
        std::int32_t& first = work.lists.first[slot_of(cell) & mask];
        work.lists.next[i] = first;
        first = static_cast<std::int32_t>(i);
    }
}

/// Calls visit(q) for every point of a cell, in index order. A slot may hold several cells; only the one asked for is
/// visited.
template <class Real, class Visit>
void for_points_of_cell(const SelfCollisionWork<Real>& work, Triple<Real> cell, Visit visit) {
    const std::uint64_t mask = work.lists.first.size() - 1;
    for (std::int32_t point = work.lists.first[slot_of(cell) & mask]; point >= 0;
         point = work.lists.next[static_cast<std::size_t>(point)]) {
        const auto q = static_cast<std::size_t>(point);
        if (work.cell.x[q] == cell.x && work.cell.y[q] == cell.y && work.cell.z[q] == cell.z)
            visit(q);
    }
}

} // namespace clothlab::sim
