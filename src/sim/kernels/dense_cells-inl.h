// The course's self-collision rule where most points of a cell are near each other.
#if defined(CLOTHLAB_SIM_KERNELS_DENSE_CELLS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLOTHLAB_SIM_KERNELS_DENSE_CELLS_INL_H
#undef CLOTHLAB_SIM_KERNELS_DENSE_CELLS_INL_H
#else
#define CLOTHLAB_SIM_KERNELS_DENSE_CELLS_INL_H
#endif

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "sim/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clothlab::sim::HWY_NAMESPACE {

/// As many buckets as a vector has lanes, one in each. Index: place in the bucket, then lane. Where a bucket has no
/// more points, they are infinitely far away.
template <class Real>
class DenseCells {
public:
    static constexpr std::size_t most_points = 32; ///< in a bucket

    explicit DenseCells(const CellPassArguments<Real>& arguments) : a_(arguments) {
        for (auto& axis : x_)
            axis.fill(std::numeric_limits<Real>::infinity());
        key_.fill(0);
        free_.fill(0);
    }

    /// Applies the rule to buckets of two to most_points points. Returns the number of pushes.
    std::size_t push(const PointSpan* const* buckets, std::size_t count) {
        std::size_t longest = 0;
        for (std::size_t lane = 0; lane < count; ++lane)
            longest = HWY_MAX(longest, load(lane, *buckets[lane]));
        const std::size_t filled = HWY_MAX(longest, filled_);
        for (std::size_t lane = 0; lane < HWY_LANES(Real); ++lane)
            for (std::size_t k = lane < count ? buckets[lane]->end - buckets[lane]->begin : 0; k < filled; ++k)
                x_[0][k * HWY_LANES(Real) + lane] = std::numeric_limits<Real>::infinity();
        filled_ = longest;
        const Tag<Real> d;
        auto pushes = hn::Zero(d);
        for (std::size_t k = 0; k < longest; ++k)
            pushes = hn::Add(pushes, push_point(k, longest));
        for (std::size_t lane = 0; lane < count; ++lane)
            store(lane, *buckets[lane]);
        return static_cast<std::size_t>(hn::GetLane(hn::SumOfLanes(d, pushes)));
    }

private:
    using KeyTag = hn::Rebind<hwy::MakeUnsigned<Real>, Tag<Real>>;

    /// Returns how many points the bucket has.
    HWY_INLINE std::size_t load(std::size_t lane, const PointSpan& bucket) {
        std::size_t at = lane;
        for (std::size_t k = bucket.begin; k < bucket.end; ++k, at += HWY_LANES(Real)) {
            const std::uint32_t i = a_.order[k];
            for (std::size_t axis = 0; axis < 3; ++axis)
                x_[axis][at] = a_.x[axis][i];
            key_[at] = a_.key[i];
            free_[at] = a_.pinned[i] ? Real(0) : Real(1);
        }
        return bucket.end - bucket.begin;
    }
    HWY_INLINE void store(std::size_t lane, const PointSpan& bucket) const {
        std::size_t at = lane;
        for (std::size_t k = bucket.begin; k < bucket.end; ++k, at += HWY_LANES(Real))
            for (std::size_t axis = 0; axis < 3; ++axis)
                a_.x[axis][a_.order[k]] = x_[axis][at];
    }
    HWY_INLINE Lane3<Real> at(std::size_t k) const {
        const Tag<Real> d;
        const std::size_t first = k * HWY_LANES(Real);
        return {hn::Load(d, &x_[0][first]), hn::Load(d, &x_[1][first]), hn::Load(d, &x_[2][first])};
    }

    /// Moves the k-th point of each bucket, as PushSum has it. Returns how often each was pushed.
    HWY_INLINE Lane<Real> push_point(std::size_t k, std::size_t longest) {
        const Tag<Real> d;
        const auto apart = hn::Set(d, a_.apart), reach = hn::Set(d, a_.touching_squared), zero = hn::Zero(d);
        const auto one = hn::Set(d, Real(1));
        const Lane3<Real> x = at(k);
        const auto key = hn::Load(KeyTag(), &key_[k * HWY_LANES(Real)]);
        Lane3<Real> sum = zero3<Real>();
        auto count = zero;
        const auto add = [&](std::size_t q) HWY_ATTR {
            const Lane3<Real> v = subtract3(x, at(q));
            const auto square = dot3(v, v);
            const auto near = hn::And(hn::Lt(square, reach),
                                      hn::RebindMask(d, hn::Eq(key, hn::Load(KeyTag(), &key_[q * HWY_LANES(Real)]))));
            if (hn::AllFalse(d, near))
                return;
            const auto length = hn::Sqrt(square);
            const auto touching = hn::And(near, hn::And(hn::Lt(length, apart), hn::Gt(length, zero)));
            const auto push = hn::Div(hn::Sub(apart, length), length);
            sum = add3(sum, keep3<Real>(touching, scale3<Real>(push, v)));
            count = hn::Add(count, hn::IfThenElseZero(touching, one));
        };
        for (std::size_t q = 0; q < k; ++q)
            add(q);
        for (std::size_t q = k + 1; q < longest; ++q)
            add(q);
        count = hn::Mul(count, hn::Load(d, &free_[k * HWY_LANES(Real)]));
        const auto share = hn::Mul(count, hn::Set(d, a_.substeps));
        const auto pushed = hn::Gt(share, zero);
        const auto move = [&](Lane<Real> from, Lane<Real> by, std::size_t axis) HWY_ATTR {
            hn::Store(hn::IfThenElse(pushed, hn::Add(from, hn::Div(by, share)), from), d,
                      &x_[axis][k * HWY_LANES(Real)]);
        };
        move(x.x, sum.x, 0);
        move(x.y, sum.y, 1);
        move(x.z, sum.z, 2);
        return count;
    }

    const CellPassArguments<Real>& a_;
    std::size_t filled_ = 0; ///< places that are perhaps not infinitely far away
    alignas(64) std::array<std::array<Real, most_points * HWY_LANES(Real)>, 3> x_;
    alignas(64) std::array<hwy::MakeUnsigned<Real>, most_points * HWY_LANES(Real)> key_;
    alignas(64) std::array<Real, most_points * HWY_LANES(Real)> free_; ///< 1, or 0 of pinned points
};

/// Buckets with more points than DenseCells has room for are left for rest(bucket). Returns the number of pushes.
template <class Real, class Rest>
HWY_INLINE std::size_t dense_pass(const CellPassArguments<Real>& a, Rest rest) {
    constexpr std::size_t most = DenseCells<Real>::most_points, batch = 1024;
    DenseCells<Real> cells(a);
    std::array<const PointSpan*, batch> by_size;
    std::size_t total = 0;
    for (const PointSpan* begin = a.buckets_begin; begin != a.buckets_end;) {
        const auto left = static_cast<std::size_t>(a.buckets_end - begin);
        const PointSpan* end = begin + HWY_MIN(left, batch);
        // Counting sort, the largest first: those side by side shall be of about the same size.
        std::array<std::uint32_t, most + 2> next{};
        for (const PointSpan* bucket = begin; bucket != end; ++bucket)
            ++next[most + 1 - HWY_MIN(bucket->end - bucket->begin, most + 1)];
        const std::size_t large = next[0];
        std::uint32_t from = 0;
        for (std::uint32_t& n : next)
            n = std::exchange(from, from + n);
        for (const PointSpan* bucket = begin; bucket != end; ++bucket)
            by_size[next[most + 1 - HWY_MIN(bucket->end - bucket->begin, most + 1)]++] = bucket;
        for (std::size_t k = 0; k < large; ++k)
            total += rest(*by_size[k]);
        const auto count = static_cast<std::size_t>(end - begin);
        for (std::size_t k = large; k < count; k += HWY_LANES(Real))
            total += cells.push(&by_size[k], HWY_MIN(count - k, HWY_LANES(Real)));
        begin = end;
    }
    return total;
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
