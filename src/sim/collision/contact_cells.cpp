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

/// Counting sort of all points by bucket: `order` and `sorted`; points of a bucket stay ascending. Returns where each
/// bucket ends. Neighbours in the grid mostly share a bucket, and each count has to wait for the one before: so the
/// lower and the upper half of the points are counted and placed by turns.
template <class Real>
const std::uint32_t* sort_by_bucket(const Vec3Array<Real>& position, SelfCollisionWork<Real>& work,
                                    std::size_t buckets) {
    const std::size_t count = position.size(), half = count / 2;
    std::uint32_t *lower = work.bucket_end.data(), *upper = lower + buckets;
    std::fill_n(lower, 2 * buckets, 0u);
    for (std::size_t i = 0; i < half; ++i) {
        ++lower[work.bucket[i]];
        ++upper[work.bucket[half + i]];
    }
    if (count % 2 != 0)
        ++upper[work.bucket[count - 1]];
    std::uint32_t begin = 0;
    for (std::size_t b = 0; b < buckets; ++b) {
        begin += std::exchange(lower[b], begin);
        begin += std::exchange(upper[b], begin);
    }
    // What is now each beginning moves on to its end.
    const auto place = [&](std::size_t i, std::uint32_t* ends) {
        const std::size_t k = ends[work.bucket[i]]++;
        work.order[k] = static_cast<std::uint32_t>(i);
        Real* sorted = work.sorted.data() + 4 * k;
        sorted[0] = position.x[i];
        sorted[1] = position.y[i];
        sorted[2] = position.z[i];
        sorted[3] = 0;
    };
    for (std::size_t i = 0; i < half; ++i) {
        place(i, lower);
        place(half + i, upper);
    }
    if (count % 2 != 0)
        place(count - 1, upper);
    return upper;
}

} // namespace

template <class Real>
std::size_t resolve_in_cells(const Model<Real>& model, State<Real>& state, Workspace<Real>& work) {
    SelfCollisionWork<Real>& s = work.self_collision;
    Vec3Array<Real>& position = state.position;
    const std::size_t count = position.size();
    const std::size_t buckets = std::bit_ceil(std::max<std::size_t>(count / 2, 1));
    const std::array<Real, 3> cell{model.cell_x, model.cell_y, model.cell_z};
    const auto bound = static_cast<double>(work.kernels->buckets(
        {std::as_const(position).axes(), count, cell}, static_cast<std::uint32_t>(buckets - 1), s.bucket.data()));
    const std::uint32_t* bucket_end = sort_by_bucket(position, s, buckets);

    // Of points that are no longer finite, all that are not infinitely far apart are looked at.
    const double reach = std::isfinite(bound) ? reach_of(model, bound) : std::numeric_limits<double>::infinity();
    const CellPassArguments<Real> all{position.axes(),
                                      s.sorted.data(),
                                      s.order.data(),
                                      bucket_end,
                                      s.bucket.data(), // no longer needed
                                      0,
                                      buckets,
                                      model.pinned.data(),
                                      cell,
                                      Real(2) * model.thickness,
                                      static_cast<Real>(reach * reach * (1 + 1e-6)),
                                      static_cast<Real>(model.substeps)};
    const int threads = work.pool ? work.choice.threads() : 1;
    if (threads == 1)
        return work.kernels->cell_pass(all);
    const auto pass = [&](int index) {
        const auto cut = [&](int i) {
            return all.last_bucket * static_cast<std::size_t>(i) / static_cast<std::size_t>(threads);
        };
        CellPassArguments<Real> part = all;
        part.first_bucket = cut(index);
        part.last_bucket = cut(index + 1);
        work.counts[static_cast<std::size_t>(index)] = work.kernels->cell_pass(part);
    };
    work.pool->run(threads, pass);
    return std::accumulate(work.counts.begin(), work.counts.begin() + threads, std::size_t{0});
}

template std::size_t resolve_in_cells<float>(const Model<float>&, State<float>&, Workspace<float>&);
template std::size_t resolve_in_cells<double>(const Model<double>&, State<double>&, Workspace<double>&);

} // namespace clothlab::sim
