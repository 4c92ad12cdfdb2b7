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
/// Reals in the widest vector.
constexpr std::size_t most_lanes = 16;

int bucket_bits(std::size_t points) {
    return std::countr_zero(std::bit_ceil(std::max<std::size_t>(points / points_per_bucket, 1)));
}

} // namespace

template <class Real>
void prepare_cells(std::size_t points, SelfCollisionWork<Real>& work) {
    work.run_end.resize(points);
    work.buckets.resize((std::size_t{1} << bucket_bits(points)) + 1);
    work.sorted.resize(std::max(4 * sizeof(Real), sizeof(CellPlace)) * (points + most_lanes));
}

template <class Real>
std::size_t resolve_in_cells(const Model<Real>& model, State<Real>& state, Workspace<Real>& work) {
    SelfCollisionWork<Real>& s = work.self_collision;
    Vec3Array<Real>& position = state.position;
    const std::size_t count = position.size();
    const std::array<Real, 3> width{model.cell_x, model.cell_y, model.cell_z};
    const int bits = bucket_bits(count);
    const CellKeys<Real> keys = work.kernels->cell_keys({std::as_const(position).axes(), count, width}, bits,
                                                        s.anchor.axes(), s.key.data(), s.places());
    const std::uint32_t mask = (std::uint32_t{1} << bits) - 1;
    const BucketList buckets = work.kernels->sort_by_bucket(
        {s.key.data(), count, mask, s.run_end.data(), s.cell_end.data(), s.order.data(), s.buckets.data()});

    // Of points that are no longer finite, all that are not very far apart are looked at.
    constexpr double most = 1e19;
    const auto bound = static_cast<double>(keys.largest);
    const double reach = std::isfinite(bound) ? std::min(reach_of(model, farthest_push(model), bound), most) : most;
    // Each coordinate is rounded to a unit, and the numbers that are rounded are not exact.
    const double units = reach * cell_units / *std::max_element(width.begin(), width.end()) + 3;
    const CellPassArguments<Real> all{position.axes(),
                                      s.places(),
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
            const std::size_t at =
                work.pace.from(static_cast<std::size_t>(i), static_cast<std::size_t>(threads), count);
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
