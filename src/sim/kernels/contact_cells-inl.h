// The course's self-collision rule, cell by cell.
#if defined(CLOTHLAB_SIM_KERNELS_CONTACT_CELLS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLOTHLAB_SIM_KERNELS_CONTACT_CELLS_INL_H
#undef CLOTHLAB_SIM_KERNELS_CONTACT_CELLS_INL_H
#else
#define CLOTHLAB_SIM_KERNELS_CONTACT_CELLS_INL_H
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "sim/collision/push_sum.h"
#include "sim/kernels/near_pairs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clothlab::sim::HWY_NAMESPACE {

/// Cell coordinates as integers, for hashing only: what is out of range goes to some integer.
template <class Real>
HWY_INLINE hn::Vec<hn::Rebind<std::int32_t, Tag<Real>>> whole(Lane<Real> cell) {
    const hn::Rebind<std::int32_t, Tag<Real>> di;
    if constexpr (sizeof(Real) == 4)
        return hn::ConvertTo(di, cell);
    else
        return hn::DemoteTo(di, cell);
}

template <class Real>
Real buckets(const CellArguments<Real>& a, std::uint32_t mask, std::uint32_t* bucket) {
    const Tag<Real> d;
    auto bound = hn::Zero(d);
    const hn::Rebind<std::int32_t, Tag<Real>> di;
    HWY_ALIGN std::int32_t hashes[HWY_LANES(Real)];
    constexpr std::int32_t primes[3] = {73856093, 19349663, 83492791};
    for (std::size_t k = 0; k < a.count; k += HWY_LANES(Real)) {
        auto hash = hn::Zero(di);
        const auto inside = lanes_before<Real>(static_cast<std::ptrdiff_t>(a.count - k));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto x = hn::LoadU(d, a.x[axis] + k);
            bound = hn::Max(bound, hn::IfThenElseZero(inside, hn::Abs(x)));
            const auto cell = cell_of<Real>(x, a.cell[axis]);
            hash = hn::Xor(hash, hn::Mul(whole<Real>(cell), hn::Set(di, primes[axis])));
        }
        hn::Store(hn::Xor(hash, hn::ShiftRight<13>(hash)), di, hashes);
        for (std::size_t l = 0; l < HWY_MIN(a.count - k, HWY_LANES(Real)); ++l)
            bucket[k + l] = static_cast<std::uint32_t>(hashes[l]) & mask;
    }
    return hn::GetLane(hn::MaxOfLanes(d, bound));
}

/// Pushes that are to be looked at, in order: of sorted point `of` by sorted point `by`. Whole numbers in Real, as
/// vector instructions put them together.
template <class Real>
struct Pushes {
    static constexpr std::size_t room = 4096, most = room - 2 * HWY_LANES(Real);
    HWY_ALIGN Real of[room], by[room];
    std::size_t count = 0;
};

/// A bucket's points as separate coordinates, and their cells.
template <class Real>
struct BucketPoints {
    static constexpr std::size_t most = 256;
    HWY_ALIGN Real x[most], y[most], z[most], cell_x[most], cell_y[most], cell_z[most];
};

/// Fills in the points, and behind them some that are near none; returns whether they are all of one cell.
template <class Real>
HWY_INLINE bool load_bucket(const CellPassArguments<Real>& a, std::size_t begin, std::size_t count, std::size_t all_end,
                            BucketPoints<Real>& out) {
    const Tag<Real> d;
    bool one_cell = true;
    for (std::size_t k = 0; k < count; k += HWY_LANES(Real)) {
        Lane3<Real> x;
        Lane<Real> unused;
        const Real* sorted = a.sorted + 4 * (begin + k);
        // Where this thread's points end, another's begin, and those are on the move.
        HWY_ALIGN Real last[4 * HWY_LANES(Real)];
        if (HWY_UNLIKELY(begin + k + HWY_LANES(Real) > all_end)) {
            Real* behind = std::copy_n(sorted, 4 * HWY_MIN(count - k, HWY_LANES(Real)), last);
            std::fill(behind, last + 4 * HWY_LANES(Real), Real(0));
            sorted = last;
        }
        hn::LoadInterleaved4(d, sorted, x.x, x.y, x.z, unused);
        const Lane3<Real> cell{cell_of<Real>(x.x, a.cell[0]), cell_of<Real>(x.y, a.cell[1]),
                               cell_of<Real>(x.z, a.cell[2])};
        const auto inside = lanes_before<Real>(static_cast<std::ptrdiff_t>(count - k));
        const auto far_away = hn::Set(d, std::numeric_limits<Real>::infinity());
        store3(choose3<Real>(inside, x, {far_away, far_away, far_away}), Axes<Real>{out.x, out.y, out.z},
               static_cast<std::ptrdiff_t>(k));
        store3(cell, Axes<Real>{out.cell_x, out.cell_y, out.cell_z}, static_cast<std::ptrdiff_t>(k));
        const Lane3<Real> first = set3(out.cell_x[0], out.cell_y[0], out.cell_z[0]);
        const auto same = hn::And(hn::And(hn::Eq(cell.x, first.x), hn::Eq(cell.y, first.y)), hn::Eq(cell.z, first.z));
        one_cell = one_cell && hn::AllFalse(d, hn::AndNot(same, inside));
    }
    return one_cell;
}

/// Writes `own` and the lanes of `others` that the mask has, side by side. Returns how many.
template <class Real>
HWY_INLINE std::size_t add_pushes(LaneMask<Real> mask, Lane<Real> own, Lane<Real> others, Real* of, Real* by) {
    std::uint32_t bits = bits_of<Real>(mask);
#if HWY_TARGET == HWY_AVX3
    // Not Highway's Compress: for double its version of 2022 looks up a table that GCC copies at every call.
    hn::StoreU(own, Tag<Real>(), of);
    if constexpr (sizeof(Real) == 4)
        _mm512_storeu_ps(by, _mm512_maskz_compress_ps(mask.raw, others.raw));
    else
        _mm512_storeu_pd(by, _mm512_maskz_compress_pd(mask.raw, others.raw));
    return static_cast<std::size_t>(std::popcount(bits));
#else
    const Real point = hn::GetLane(own), first = hn::GetLane(others);
    std::size_t count = 0;
    for (; bits != 0; bits &= bits - 1, ++count) {
        of[count] = point;
        by[count] = first + static_cast<Real>(std::countr_zero(bits));
    }
    return count;
#endif
}

/// Finds which points of a bucket may be pushed by which, without a branch for each: points of the same cell that are
/// near each other before any is moved. One vector of points is the usual bucket, and one cell what is usually in it.
template <bool one_vector, bool one_cell, class Real>
HWY_INLINE void find_pushes(const CellPassArguments<Real>& a, const BucketPoints<Real>& points, std::size_t begin,
                            std::size_t size, Pushes<Real>& out) {
    const Tag<Real> d;
    const auto reach = hn::Set(d, a.reach_squared), step = hn::Set(d, static_cast<Real>(HWY_LANES(Real)));
    const auto first_others = hn::Iota(d, static_cast<Real>(begin));
    std::size_t count = out.count;
    for (std::size_t k = 0; k < size; ++k) {
        const Lane3<Real> x = set3(points.x[k], points.y[k], points.z[k]);
        const auto own = hn::Set(d, static_cast<Real>(begin + k));
        auto others = first_others;
        for (std::size_t first = 0; first < (one_vector ? 1 : size); first += HWY_LANES(Real)) {
            const Lane3<Real> v =
                subtract3(x, load3(ConstAxes<Real>{points.x, points.y, points.z}, static_cast<std::ptrdiff_t>(first)));
            auto near = hn::AndNot(hn::Eq(others, own), hn::Lt(dot3(v, v), reach));
            if constexpr (!one_cell) {
                const Lane3<Real> c = load3(ConstAxes<Real>{points.cell_x, points.cell_y, points.cell_z},
                                            static_cast<std::ptrdiff_t>(first));
                const Lane3<Real> cell = set3(points.cell_x[k], points.cell_y[k], points.cell_z[k]);
                near = hn::And(near, hn::And(hn::And(hn::Eq(c.x, cell.x), hn::Eq(c.y, cell.y)), hn::Eq(c.z, cell.z)));
            }
            count += add_pushes<Real>(near, own, others, out.of + count, out.by + count);
            others = hn::Add(others, step);
        }
    }
    out.count = count;
}

/// The pushes on one sorted point, and where it goes, as PushSum has it. Three coordinates fit into a vector of four,
/// which is faster where the machine has vectors so long and simple.
template <class Real>
class SortedPush {
public:
    SortedPush(const CellPassArguments<Real>& a, std::size_t k) : a_(a), k_(k) {}
    HWY_INLINE void add(std::size_t q) {
        const Real *x = a_.sorted + 4 * k_, *y = a_.sorted + 4 * q;
        sum_.add(x[0] - y[0], x[1] - y[1], x[2] - y[2], a_.apart);
    }
    /// Moves the point and returns the number of pushes.
    HWY_INLINE std::size_t move() {
        Real* x = a_.sorted + 4 * k_;
        sum_.move(x[0], x[1], x[2], a_.substeps);
        return sum_.count();
    }

private:
    const CellPassArguments<Real>& a_;
    std::size_t k_;
    PushSum<Real> sum_;
};

template <>
class SortedPush<float> {
    using D = hn::FixedTag<float, 4>;

public:
    HWY_INLINE SortedPush(const CellPassArguments<float>& a, std::size_t k)
        : a_(a), at_(a.sorted + 4 * k), x_(hn::Load(D(), at_)), sum_(hn::Zero(D())), count_(hn::Zero(D())) {}
    HWY_INLINE void add(std::size_t q) {
        const D d;
        const auto v = hn::Sub(x_, hn::Load(d, a_.sorted + 4 * q)), squares = hn::Mul(v, v);
        const auto length =
            hn::Sqrt(hn::Add(hn::Add(hn::Broadcast<0>(squares), hn::Broadcast<1>(squares)), hn::Broadcast<2>(squares)));
        const auto apart = hn::Set(d, a_.apart);
        const auto touching = hn::And(hn::Lt(length, apart), hn::Gt(length, hn::Zero(d)));
        const auto push = hn::IfThenElseZero(touching, hn::Div(hn::Sub(apart, length), length));
        sum_ = hn::Add(sum_, hn::Mul(push, v));
        count_ = hn::Add(count_, hn::IfThenElseZero(touching, hn::Set(d, 1.0f)));
    }
    HWY_INLINE std::size_t move() {
        const D d;
        const auto share = hn::Mul(count_, hn::Set(d, a_.substeps));
        hn::Store(hn::IfThenElse(hn::Gt(count_, hn::Zero(d)), hn::Add(x_, hn::Div(sum_, share)), x_), d, at_);
        return static_cast<std::size_t>(hn::GetLane(count_));
    }

private:
    const CellPassArguments<float>& a_;
    float* at_;
    hn::Vec<D> x_, sum_, count_;
};

/// Moves a sorted point, and the point it stands for, unless it is pinned. Returns the number of pushes.
template <class Real>
HWY_INLINE std::size_t move_sorted(const CellPassArguments<Real>& a, std::size_t k, SortedPush<Real>& push) {
    const std::uint32_t i = a.order[k];
    if (a.pinned[i])
        return 0;
    const std::size_t count = push.move();
    for (std::size_t axis = 0; axis < 3; ++axis)
        a.x[axis][i] = a.sorted[4 * k + axis];
    return count;
}

/// Moves the points as the pushes say, one after the other. Returns how many really were near enough.
template <class Real>
std::size_t apply_pushes(const CellPassArguments<Real>& a, Pushes<Real>& pushes) {
    std::size_t total = 0;
    for (std::size_t at = 0; at < pushes.count;) {
        const Real of = pushes.of[at];
        const auto k = static_cast<std::size_t>(static_cast<std::int32_t>(of));
        SortedPush<Real> push(a, k);
        do {
            push.add(static_cast<std::size_t>(static_cast<std::int32_t>(pushes.by[at])));
        } while (++at < pushes.count && pushes.of[at] == of);
        total += move_sorted(a, k, push);
    }
    pushes.count = 0;
    return total;
}

/// A bucket as the plain loop does it: for those with very many points.
template <class Real>
HWY_NOINLINE std::size_t crowded_bucket(const CellPassArguments<Real>& a, std::size_t begin, std::size_t end) {
    // Cells are those of the beginning, so they are found before a point moves.
    std::size_t total = 0;
    std::uint32_t* group = a.scratch + begin;
    for (std::size_t k = begin; k < end; ++k) { // the first point of the same cell stands for the cell
        const auto cell = [&](std::size_t q, std::size_t axis) {
            return std::floor(a.sorted[4 * q + axis] / a.cell[axis]);
        };
        group[k - begin] = static_cast<std::uint32_t>(end);
        for (std::size_t q = begin; q <= k; ++q)
            if (cell(q, 0) == cell(k, 0) && cell(q, 1) == cell(k, 1) && cell(q, 2) == cell(k, 2)) {
                group[k - begin] = static_cast<std::uint32_t>(q);
                break;
            }
    }
    for (std::size_t k = begin; k < end; ++k) {
        SortedPush<Real> push(a, k);
        for (std::size_t q = begin; q < end; ++q)
            if (q != k && group[q - begin] == group[k - begin] && group[k - begin] != end)
                push.add(q);
        total += move_sorted(a, k, push);
    }
    return total;
}

/// A bucket may hold several cells; only points of the same cell push each other, and so each pair counts once.
template <class Real>
std::size_t cell_pass(const CellPassArguments<Real>& a) {
    Pushes<Real> pushes;
    BucketPoints<Real> points;
    std::size_t total = 0;
    std::size_t begin = a.first_bucket == 0 ? 0 : a.bucket_end[a.first_bucket - 1];
    const std::size_t all_end = a.last_bucket == 0 ? 0 : a.bucket_end[a.last_bucket - 1];
    for (std::size_t bucket = a.first_bucket; bucket < a.last_bucket; ++bucket) {
        const std::size_t end = a.bucket_end[bucket], size = end - begin;
        if (size > 1) {
            if (pushes.count + size * size > Pushes<Real>::most)
                total += apply_pushes(a, pushes);
            if (HWY_UNLIKELY(size * size > Pushes<Real>::most || size > BucketPoints<Real>::most)) {
                total += crowded_bucket(a, begin, end);
            } else {
                const bool one_cell = load_bucket(a, begin, size, all_end, points);
                const bool one_vector = size <= HWY_LANES(Real);
                if (HWY_LIKELY(one_cell && one_vector))
                    find_pushes<true, true>(a, points, begin, size, pushes);
                else if (one_cell)
                    find_pushes<false, true>(a, points, begin, size, pushes);
                else if (one_vector)
                    find_pushes<true, false>(a, points, begin, size, pushes);
                else
                    find_pushes<false, false>(a, points, begin, size, pushes);
            }
        }
        begin = end;
    }
    return total + apply_pushes(a, pushes);
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
