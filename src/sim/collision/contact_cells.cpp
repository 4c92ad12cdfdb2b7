#include "sim/collision/contact_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "sim/collision/near_pairs.h"

namespace clothlab::sim {
namespace {

/// Fewer buckets cost less to sort, but more of them hold several cells; as many points as this for each.
constexpr std::size_t points_per_bucket = 8;
/// Reals in the widest vector.
constexpr std::size_t most_lanes = 16;

/// Fewer bits may not tell all cells of a box apart.
constexpr int least_bucket_bits = 10;
/// Buckets are gone through side by side where a larger share of all pairs of their points push each other. Below, it
/// costs more to look at all pairs than to find those that do.
constexpr double dense_share = 0.1;

int bucket_bits(std::size_t points) {
    return std::countr_zero(std::bit_ceil(std::max<std::size_t>(points / points_per_bucket, 1)));
}

/// The distance from which on points cannot touch, in m, when no coordinate is larger than `bound`. Of points that are
/// no longer finite, all that are not very far apart are looked at.
template <class Real>
double cell_reach(const Model<Real>& model, double bound) {
    constexpr double most = 1e19;
    return std::isfinite(bound) ? std::min(reach_of(model, farthest_push(model), bound), most) : most;
}

/// Which points may touch others: found by blocks of the grid where that pays.
template <class Real>
PointSpans points_to_sort(const Model<Real>& model, const Vec3Array<Real>& position, const PointSpan& all,
                          Workspace<Real>& work) {
    SelfCollisionWork<Real>& s = work.self_collision;
    const PointSpans every_point{&all, 1, all.end};
    if (!s.blocks.usable())
        return every_point;
    if (s.blocks_rest.waits())
        return every_point;
    // Of the coordinates' bound only a guess is known before, as it is found with the rest.
    const double reach = reach_of(model, farthest_push(model), s.blocks_bound);
    constexpr double rounding = std::numeric_limits<Real>::epsilon();
    const auto reach_squared = static_cast<Real>(reach * reach * (1 + 8 * rounding));
    const std::size_t block_points = block_side * static_cast<std::size_t>(model.grid->columns);
    for_ranges(model, work, [&](int, std::size_t begin, std::size_t end) {
        const auto row_of = [&](std::size_t point) { return (point + block_points - 1) / block_points; };
        s.blocks.fit(*work.kernels, position.axes(), reach_squared, row_of(begin), row_of(end));
    });
    const bool finite = s.blocks.finish();
    const double bound = finite ? s.blocks.bound() : 0;
    if (bound > s.blocks_bound) { // the reach was too small for points so far out
        s.blocks_bound = 2 * bound;
        return every_point;
    }
    if (finite && s.blocks.find(reach)) {
        s.blocks_rest.pays();
        return s.blocks.points();
    }
    s.blocks_rest.leave(); // all points are sorted for some steps, without asking which
    return every_point;
}

/// Shared out among threads. Returns the number of pushes.
template <class Real>
std::size_t go_through(const CellPassArguments<Real>& all, std::size_t points, Workspace<Real>& work) {
    const int threads = work.pool ? work.choice.threads() : 1;
    if (threads == 1)
        return work.kernels->cell_pass(all);
    const auto pass = [&](int index) {
        const auto cut = [&](int i) {
            const std::size_t at =
                work.pace.from(static_cast<std::size_t>(i), static_cast<std::size_t>(threads), points);
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

} // namespace

template <class Real>
void prepare_cells(const Grid<Real>& grid, SelfCollisionWork<Real>& work) {
    const std::size_t points = grid.points();
    work.blocks.resize(static_cast<std::size_t>(grid.columns), static_cast<std::size_t>(grid.rows));
    work.blocks_rest = {};
    work.dense = false;
    work.run_end.resize(points);
    work.buckets.resize((std::size_t{1} << bucket_bits(points)) + 1);
    work.sorted.resize(std::max(4 * sizeof(Real), sizeof(CellPlace)) * (points + most_lanes));
}

template <class Real>
std::size_t resolve_in_cells(const Model<Real>& model, State<Real>& state, Workspace<Real>& work) {
    SelfCollisionWork<Real>& s = work.self_collision;
    Vec3Array<Real>& position = state.position;
    const std::array<Real, 3> width{model.cell_x, model.cell_y, model.cell_z};
    const PointSpan all_points{0, static_cast<std::uint32_t>(position.size())};
    const PointSpans points = points_to_sort(model, position, all_points, work);
    if (points.points == 0)
        return 0;
    const int bits = std::max(bucket_bits(points.points), std::min(least_bucket_bits, bucket_bits(position.size())));
    const CellKeys<Real> keys = work.kernels->cell_keys(
        {std::as_const(position).axes(), points, width, bits, s.anchor.axes(), s.key.data(), s.places()});
    const std::uint32_t mask = (std::uint32_t{1} << bits) - 1;
    const BucketList buckets = work.kernels->sort_by_bucket(
        {s.key.data(), points, mask, s.run_end.data(), s.cell_end.data(), s.order.data(), s.buckets.data()});
    const double reach = cell_reach(model, static_cast<double>(keys.largest));
    // Each coordinate is rounded to a unit, and the numbers that are rounded are not exact.
    const double units = reach * cell_units / *std::max_element(width.begin(), width.end()) + 3;
    const Real apart = Real(2) * model.thickness;
    const CellPassArguments<Real> all{position.axes(),
                                      s.key.data(),
                                      s.places(),
                                      s.order.data(),
                                      std::as_const(s.anchor).axes(),
                                      keys.exact,
                                      s.buckets.data(),
                                      s.buckets.data() + buckets.count,
                                      buckets.largest,
                                      model.pinned.data(),
                                      apart,
                                      static_cast<Real>(reach * reach * (1 + 1e-6)),
                                      static_cast<std::int16_t>(std::min(units * units / 65536, 32767.0)),
                                      apart * apart * (1 + 8 * std::numeric_limits<Real>::epsilon()) +
                                          std::numeric_limits<Real>::min(),
                                      static_cast<Real>(model.substeps),
                                      s.dense};
    const std::size_t pushes = go_through(all, points.points, work);
    s.dense = static_cast<double>(pushes) > dense_share * static_cast<double>(buckets.pairs);
    return pushes;
}

template void prepare_cells<float>(const Grid<float>&, SelfCollisionWork<float>&);
template void prepare_cells<double>(const Grid<double>&, SelfCollisionWork<double>&);
template std::size_t resolve_in_cells<float>(const Model<float>&, State<float>&, Workspace<float>&);
template std::size_t resolve_in_cells<double>(const Model<double>&, State<double>&, Workspace<double>&);

} // namespace clothlab::sim
