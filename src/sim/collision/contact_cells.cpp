#include "sim/collision/contact_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "sim/collision/near_pairs.h"

namespace clothlab::sim {
namespace {

/// Fewer buckets cost less to sort, but more of them hold several cells; as many points as this for each.
constexpr std::size_t points_per_bucket = 8;
/// Places in the widest vector.
constexpr std::size_t most_lanes = 32;

int bucket_bits(std::size_t points) {
    return std::countr_zero(std::bit_ceil(std::max<std::size_t>(points / points_per_bucket, 1)));
}

struct Buckets {
    std::size_t count, largest; ///< buckets of several points; points of the largest
};

/// Counting sort of all points by bucket: `order`, and their places. Points of a bucket stay ascending. Lists the
/// buckets that have several. Neighbours along a row mostly share a cell: such runs are counted and placed as one.
template <class Real>
Buckets sort_by_bucket(std::size_t count, SelfCollisionWork<Real>& work, const CellPlace* places, CellPlace* sorted,
                           std::uint32_t mask) {
    const std::size_t buckets = std::size_t{mask} + 1;
    const std::uint32_t* key = work.key.data();
    std::uint32_t *run_end = work.run_end.data(), *next = work.cell_end.data();
    std::size_t runs = 0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
        run_end[runs] = static_cast<std::uint32_t>(i + 1);
        runs += key[i] != key[i + 1] ? 1 : 0;
    }
    run_end[runs++] = static_cast<std::uint32_t>(count);

    std::fill_n(next, buckets, 0u);
    for (std::uint32_t run = 0, first = 0; run < runs; first = run_end[run++])
        next[key[first] & mask] += run_end[run] - first;
    std::uint32_t begin = 0, largest = 0;
    std::size_t listed = 0;
    for (std::size_t b = 0; b < buckets; ++b) {
        const std::uint32_t size = std::exchange(next[b], begin);
        work.buckets[listed] = {begin, begin + size};
        listed += size > 1 ? 1 : 0;
        begin += size;
        largest = std::max(largest, size);
    }
    for (std::uint32_t run = 0, i = 0; run < runs; ++run) {
        std::size_t k = std::exchange(next[key[i] & mask], next[key[i] & mask] + run_end[run] - i);
        do {
            work.order[k] = i;
            sorted[k] = places[i];
            ++k;
        } while (++i < run_end[run]);
    }
    return {listed, largest};
}

} // namespace

template <class Real>
void prepare_cells(std::size_t points, SelfCollisionWork<Real>& work) {
    work.run_end.resize(points);
    work.buckets.resize((std::size_t{1} << bucket_bits(points)) + 1);
    work.sorted.resize(std::max(4 * sizeof(Real), 2 * sizeof(CellPlace)) * (points + most_lanes));
}

template <class Real>
std::size_t resolve_in_cells(const Model<Real>& model, State<Real>& state, Workspace<Real>& work) {
    SelfCollisionWork<Real>& s = work.self_collision;
    Vec3Array<Real>& position = state.position;
    const std::size_t count = position.size();
    const std::array<Real, 3> width{model.cell_x, model.cell_y, model.cell_z};
    const auto [places, sorted] = s.places();
    const int bits = bucket_bits(count);
    const CellKeys<Real> keys = work.kernels->cell_keys({std::as_const(position).axes(), count, width}, bits,
                                                        s.anchor.axes(), s.key.data(), places);
    const std::uint32_t mask = (std::uint32_t{1} << bits) - 1;
    const Buckets buckets = sort_by_bucket(count, s, places, sorted, mask);

    // Of points that are no longer finite, all that are not very far apart are looked at.
    constexpr double most = 1e19;
    const auto bound = static_cast<double>(keys.largest);
    const double reach = std::isfinite(bound) ? std::min(reach_of(model, farthest_push(model), bound), most) : most;
    // Each coordinate is rounded to a unit, and the numbers that are rounded are not exact.
    const double units = reach * cell_units / *std::max_element(width.begin(), width.end()) + 3;
    const CellPassArguments<Real> all{position.axes(),
                                      sorted,
                                      s.order.data(),
                                      std::as_const(s.anchor).axes(),
                                      keys.exact,
                                      s.buckets.data(),
                                      s.buckets.data() + buckets.count,
                                      buckets.largest,
                                      model.pinned.data(),
                                      Real(2) * model.thickness,
                                      static_cast<Real>(reach * reach * (1 + 1e-6)),
                                      static_cast<std::int16_t>(std::min(units * units / 65536, 32767.0)),
                                      static_cast<Real>(model.substeps)};
    const int threads = work.pool ? work.choice.threads() : 1;
    if (threads == 1)
        return work.kernels->cell_pass(all);
    const auto pass = [&](int index) {
        const auto cut = [&](int i) {
            const std::size_t at = count * static_cast<std::size_t>(i) / static_cast<std::size_t>(threads);
            return std::partition_point(all.buckets_begin, all.buckets_end,
                                        [&](const PointSpan& bucket) { return bucket.end <= at; });
        };
        CellPassArguments<Real> part = all;
        part.buckets_begin = cut(index);
        part.buckets_end = cut(index + 1);
        work.counts[static_cast<std::size_t>(index)] = work.kernels->cell_pass(part);
    };
    work.pool->run(threads, pass);
    return std::accumulate(work.counts.begin(), work.counts.begin() + threads, std::size_t{0});
}

template void prepare_cells<float>(std::size_t, SelfCollisionWork<float>&);
template void prepare_cells<double>(std::size_t, SelfCollisionWork<double>&);
template std::size_t resolve_in_cells<float>(const Model<float>&, State<float>&, Workspace<float>&);
template std::size_t resolve_in_cells<double>(const Model<double>&, State<double>&, Workspace<double>&);

} // namespace clothlab::sim
