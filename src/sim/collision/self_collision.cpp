#include "sim/collision/self_collision.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <type_traits>

#include "sim/collision/contact_cells.h"
#include "sim/collision/contact_pairs.h"
#include "sim/collision/near_pairs.h"
#include "sim/random.h"

namespace clothlab::sim {
namespace {

/// Cells are kept as whole numbers in Real: a position of 1e30 has a cell too, and NaN equals no cell at all.
template <class Real>
std::uint64_t slot_of(const Vec3Array<Real>& cell, std::size_t i) {
    using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
    std::uint64_t hash = std::bit_cast<Bits>(cell.x[i]);
    hash = SplitMix64::mix(hash) ^ std::bit_cast<Bits>(cell.y[i]);
    hash = SplitMix64::mix(hash) ^ std::bit_cast<Bits>(cell.z[i]);
    return SplitMix64::mix(hash);
}

template <class Real>
void fill_cells(const Model<Real>& model, const Vec3Array<Real>& x, SelfCollisionWork<Real>& work) {
    const std::uint64_t mask = work.lists.first.size() - 1;
    std::fill(work.lists.first.begin(), work.lists.first.end(), -1);
    // From the last point to the first, so that each chain is in index order.
    for (std::size_t i = x.size(); i-- > 0;) {
        // Adding zero turns -0 into 0: they are the same cell but not the same bits.
        work.cell.x[i] = std::floor(x.x[i] / model.cell_x) + Real(0);
        work.cell.y[i] = std::floor(x.y[i] / model.cell_y) + Real(0);
        work.cell.z[i] = std::floor(x.z[i] / model.cell_z) + Real(0);
        std::int32_t& first = work.lists.first[slot_of(work.cell, i) & mask];
        work.lists.next[i] = first;
        first = static_cast<std::int32_t>(i);
    }
}

/// The rule as it is written, all points in order.
template <class Real>
std::size_t resolve_plainly(const Model<Real>& model, State<Real>& state, SelfCollisionWork<Real>& work) {
    Vec3Array<Real>& x = state.position;
    fill_cells(model, x, work);
    const Vec3Array<Real>& cell = work.cell;
    const std::uint64_t mask = work.lists.first.size() - 1;
    const Real apart = Real(2) * model.thickness;
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (model.pinned[i])
            continue;
        Real sum_x = 0, sum_y = 0, sum_z = 0;
        int count = 0;
        for (std::int32_t other = work.lists.first[slot_of(cell, i) & mask]; other >= 0;
             other = work.lists.next[static_cast<std::size_t>(other)]) {
            const auto q = static_cast<std::size_t>(other);
            // A slot may hold several cells; a pair counts only if the cells are the same, and so only once.
            if (q == i || !(cell.x[q] == cell.x[i] && cell.y[q] == cell.y[i] && cell.z[q] == cell.z[i]))
                continue;
            const Real dx = x.x[i] - x.x[q], dy = x.y[i] - x.y[q], dz = x.z[i] - x.z[q];
            const Real length = std::sqrt(dx * dx + dy * dy + dz * dz);
            if (!(length < apart) || length == 0)
                continue;
            const Real push = (apart - length) / length;
            sum_x += push * dx;
            sum_y += push * dy;
            sum_z += push * dz;
            ++count;
        }
        if (count == 0)
            continue;
        const Real share = static_cast<Real>(count) * static_cast<Real>(model.substeps);
        x.x[i] += sum_x / share;
        x.y[i] += sum_y / share;
        x.z[i] += sum_z / share;
        pairs += static_cast<std::size_t>(count);
    }
    return pairs;
}

} // namespace

template <class Real>
std::size_t resolve_self_collision(const Model<Real>& model, State<Real>& state, Workspace<Real>& work) {
    if (!(model.thickness > 0))
        return 0; // no two points are nearer than that
    if (!work.kernels)
        return resolve_plainly(model, state, work.self_collision);
    if (find_pairs(model, state.position, work))
        return resolve_pairs(model, state, work.self_collision);
    return resolve_in_cells(model, state, work);
}

template <class Real>
void prepare_self_collision(const Model<Real>& model, Workspace<Real>& work) {
    const std::size_t points = model.grid->points();
    SelfCollisionWork<Real>& s = work.self_collision;
    s.anchored = false;
    s.without_list = s.without_list_next = 0;
    if (!work.kernels) {
        s.cell.resize(points);
        s.lists.first.resize(std::bit_ceil(points));
        s.lists.next.resize(points);
        return;
    }
    s.anchor.resize(points);
    s.far_pairs.reserve(most_far_pairs(points));
    s.pairs.reserve(most_pairs(points) + most_far_pairs(points));
    s.cursor.assign(points, 0);
    s.active.assign(points / 64 + 1, 0);
    s.partners.resize(2 * s.pairs.capacity());
    s.bucket.resize(points);
    s.order.resize(points);
    s.bucket_end.resize(std::max(std::bit_ceil(points), most_cells(points) + 1));
    s.sorted.resize(4 * (points + CacheLineAllocator<Real>::spare / sizeof(Real)));
}

template std::size_t resolve_self_collision<float>(const Model<float>&, State<float>&, Workspace<float>&);
template std::size_t resolve_self_collision<double>(const Model<double>&, State<double>&, Workspace<double>&);
template void prepare_self_collision<float>(const Model<float>&, Workspace<float>&);
template void prepare_self_collision<double>(const Model<double>&, Workspace<double>&);

} // namespace clothlab::sim
