// The vector parts of the self-collision: which points are near each other in the grid, cells, and the course's rule
// within one cell.
#if defined(CLOTHLAB_SIM_KERNELS_SELF_COLLISION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLOTHLAB_SIM_KERNELS_SELF_COLLISION_INL_H
#undef CLOTHLAB_SIM_KERNELS_SELF_COLLISION_INL_H
#else
#define CLOTHLAB_SIM_KERNELS_SELF_COLLISION_INL_H
#endif

#include <bit>
#include <cmath>
#include <limits>

#include "sim/collision/push_sum.h"
#include "sim/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clothlab::sim::HWY_NAMESPACE {

template <class Real>
void proximity(ProximityArguments<Real>& a) {
    const Tag<Real> d;
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    Lane3<Real> low = set3(infinity, infinity, infinity), high = set3(-infinity, -infinity, -infinity);
    const auto columns = static_cast<std::ptrdiff_t>(a.columns);
    const auto end = static_cast<std::ptrdiff_t>(a.end);
    const auto reach = hn::Set(d, a.reach_squared);
    Columns<Real> column(a.columns, a.begin);
    std::size_t pairs = 0;
    const auto pair = [&](std::ptrdiff_t i, std::ptrdiff_t other) {
        if (pairs < a.most_pairs)
            a.pairs[pairs] = {static_cast<std::uint32_t>(other), static_cast<std::uint32_t>(i)};
        ++pairs;
    };
    const auto near_one = [&](std::ptrdiff_t i, std::ptrdiff_t other) {
        const Real dx = a.x[0][other] - a.x[0][i], dy = a.x[1][other] - a.x[1][i], dz = a.x[2][other] - a.x[2][i];
        if (!(dx * dx + dy * dy + dz * dz >= a.reach_squared))
            pair(i, other);
    };

    for (auto i = static_cast<std::ptrdiff_t>(a.begin); i < end; i += lanes<Real>, column.advance()) {
        const Lane3<Real> x = load3(a.x, i);
        const LaneMask<Real> inside = lanes_before<Real>(end - i);
        if (a.anchor[0]) {
            const Lane3<Real> u = subtract3(x, load3(a.anchor, i));
            const Lane3<Real> u_low = choose3(inside, u, low), u_high = choose3(inside, u, high);
            low = {hn::Min(low.x, u_low.x), hn::Min(low.y, u_low.y), hn::Min(low.z, u_low.z)};
            high = {hn::Max(high.x, u_high.x), hn::Max(high.y, u_high.y), hn::Max(high.z, u_high.z)};
        }
        if (i < columns + 1) { // no whole row before it: one by one
            for (std::ptrdiff_t j = i; j < HWY_MIN(i + lanes<Real>, end); ++j) {
                const std::ptrdiff_t c = j % columns;
                if (c > 0)
                    near_one(j, j - 1);
                if (j >= columns)
                    near_one(j, j - columns);
                if (j >= columns && c > 0)
                    near_one(j, j - columns - 1);
                if (j >= columns && c + 1 < columns)
                    near_one(j, j - columns + 1);
            }
            continue;
        }
        // Not "nearer than", so that NaN counts as near: such a point is to be looked at.
        const auto near = [&](std::ptrdiff_t other) HWY_ATTR {
            const Lane3<Real> v = subtract3(load3(a.x, i + other), x);
            return hn::And(hn::Not(hn::Ge(dot3(v, v), reach)), inside);
        };
        const auto left = hn::And(near(-1), column.has_left());
        const auto up = near(-columns);
        const auto upper_left = hn::And(near(-columns - 1), column.has_left());
        const auto upper_right = hn::And(near(-columns + 1), column.has_right());
        if (HWY_LIKELY(hn::AllFalse(d, hn::Or(hn::Or(left, up), hn::Or(upper_left, upper_right)))))
            continue;
        const auto mark = [&](LaneMask<Real> mask, std::ptrdiff_t other) HWY_ATTR {
            for (std::uint32_t bits = bits_of<Real>(mask); bits != 0; bits &= bits - 1) {
                const std::ptrdiff_t j = i + std::countr_zero(bits);
                pair(j, j + other);
            }
        };
        mark(left, -1);
        mark(up, -columns);
        mark(upper_left, -columns - 1);
        mark(upper_right, -columns + 1);
    }
    a.count = pairs;
    HWY_ALIGN Real lane_values[HWY_LANES(Real)];
    const auto reduce = [&](Lane<Real> v, bool smallest) HWY_ATTR {
        hn::Store(v, d, lane_values);
        Real result = lane_values[0];
        for (const Real value : lane_values)
            result = smallest ? HWY_MIN(result, value) : HWY_MAX(result, value);
        return result;
    };
    a.low = {reduce(low.x, true), reduce(low.y, true), reduce(low.z, true)};
    a.high = {reduce(high.x, false), reduce(high.y, false), reduce(high.z, false)};
}

template <class Real>
std::size_t far_pairs(const FarPairArguments<Real>& a) {
    const Tag<Real> d;
    const auto reach = hn::Set(d, a.reach_squared), one = hn::Set(d, Real(1));
    const auto row_before = hn::Set(d, static_cast<Real>(a.columns - 1)),
               row_after = hn::Set(d, static_cast<Real>(a.columns + 1));
    const auto [nx, ny, nz] = a.cells;
    std::size_t count = 0;
    const auto cell_begin = [&](std::size_t cell) { return cell == 0 ? 0 : a.cell_end[cell - 1]; };
    std::uint32_t k = 0;
    for (std::uint32_t z = 0; z < nz; ++z)
        for (std::uint32_t y = 0; y < ny; ++y) {
            const std::size_t row = (std::size_t{z} * ny + y) * nx;
            if (a.cell_end[row + nx - 1] == k)
                continue; // an empty row of cells
            for (std::uint32_t x = 0; x < nx; ++x) {
                const std::uint32_t cell_end = a.cell_end[row + x];
                if (k == cell_end)
                    continue;
                // Each pair is met once, at the point that comes first in the order: in what is left of its own cell
                // and the one after, in the row after, and in the three of the layer after. Three cells along x are one
                // run.
                const std::uint32_t first = x > 0 ? x - 1 : 0, last = HWY_MIN(x + 1, nx - 1);
                std::uint32_t from[5], to[5];
                int runs = 1;
                to[0] = a.cell_end[row + last];
                for (int next = 0; next < 4; ++next) {
                    const std::uint32_t next_z = next == 0 ? z : z + 1;
                    const std::uint32_t next_y = next == 0 ? y + 1 : y + static_cast<std::uint32_t>(next) - 2;
                    if (next_z >= nz || next_y >= ny) // the latter also when y was 0 - 1
                        continue;
                    const std::size_t next_row = (std::size_t{next_z} * ny + next_y) * nx;
                    from[runs] = cell_begin(next_row + first);
                    to[runs] = a.cell_end[next_row + last];
                    runs += from[runs] < to[runs] ? 1 : 0;
                }
                for (; k < cell_end; ++k) {
                    const std::uint32_t i = a.order[k], column = i % a.columns;
                    const bool at_border = column == 0 || column + 1 == a.columns;
                    const auto index = hn::Set(d, a.index[k]);
                    const Lane3<Real> point = set3(a.sorted[0][k], a.sorted[1][k], a.sorted[2][k]);
                    from[0] = k + 1;
                    for (int r = 0; r < runs; ++r)
                        for (std::uint32_t q = from[r]; q < to[r]; q += HWY_LANES(Real)) {
                            const Lane3<Real> v = subtract3(load3(a.sorted, q), point);
                            // The eight around it in the grid, or across the border from the end of one row to the
                            // beginning of the next.
                            const auto apart = hn::Abs(hn::Sub(hn::LoadU(d, a.index + q), index));
                            const auto around = hn::Or(hn::Eq(apart, one),
                                                       hn::And(hn::Ge(apart, row_before), hn::Le(apart, row_after)));
                            auto near = hn::And(hn::Le(dot3(v, v), reach),
                                                lanes_before<Real>(static_cast<std::ptrdiff_t>(to[r] - q)));
                            if (HWY_LIKELY(!at_border))
                                near = hn::AndNot(around, near);
                            if (HWY_LIKELY(hn::AllFalse(d, near)))
                                continue;
                            for (std::uint32_t bits = bits_of<Real>(near); bits != 0; bits &= bits - 1) {
                                const std::uint32_t j = a.order[q + static_cast<std::uint32_t>(std::countr_zero(bits))];
                                if (at_border) {
                                    const std::uint32_t to_column = j % a.columns;
                                    const std::uint32_t rows =
                                        i > j ? i / a.columns - j / a.columns : j / a.columns - i / a.columns;
                                    if (rows <= 1 && to_column + 1 >= column && to_column <= column + 1)
                                        continue;
                                }
                                if (count == a.most_pairs)
                                    return count + 1;
                                a.pairs[count++] = {i, j};
                            }
                        }
                }
            }
        }
    return count;
}

/// Cell coordinates as integers, for hashing only: what is out of range goes to some integer.
template <class Real>
HWY_INLINE hn::Vec<hn::Rebind<std::int32_t, Tag<Real>>> whole(Lane<Real> cell) {
    const hn::Rebind<std::int32_t, Tag<Real>> di;
    if constexpr (sizeof(Real) == 4)
        return hn::ConvertTo(di, cell);
    else
        return hn::DemoteTo(di, cell);
}

/// Cells along one axis, kept as whole numbers in Real: a position of 1e30 has a cell too, and NaN equals no cell.
/// Adding zero turns -0 into 0: they are the same cell.
template <class Real>
HWY_INLINE Lane<Real> cell_of(Lane<Real> x, Real size) {
    const Tag<Real> d;
    return hn::Add(hn::Floor(hn::Div(x, hn::Set(d, size))), hn::Zero(d));
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

template <class Real>
std::size_t keep_pairs(const CellArguments<Real>& a, Real reach_squared, PointPair* pairs, std::size_t count) {
    const Tag<Real> d;
    constexpr std::size_t step = HWY_LANES(Real);
    HWY_ALIGN Real ends[2][3][step] = {};
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count; k += step) {
        const std::size_t n = HWY_MIN(count - k, step);
        for (std::size_t l = 0; l < n; ++l)
            for (std::size_t end = 0; end < 2; ++end)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    ends[end][axis][l] = a.x[axis][pairs[k + l][end]];
        auto square = hn::Zero(d);
        auto keep = lanes_before<Real>(static_cast<std::ptrdiff_t>(n));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto first = hn::Load(d, ends[0][axis]), second = hn::Load(d, ends[1][axis]);
            const auto v = hn::Sub(first, second);
            square = hn::Add(square, hn::Mul(v, v));
            keep = hn::And(keep, hn::Eq(cell_of<Real>(first, a.cell[axis]), cell_of<Real>(second, a.cell[axis])));
        }
        keep = hn::AndNot(hn::Ge(square, hn::Set(d, reach_squared)), keep);
        for (std::uint32_t bits = bits_of<Real>(keep); bits != 0; bits &= bits - 1)
            pairs[kept++] = pairs[k + static_cast<std::size_t>(std::countr_zero(bits))];
    }
    return kept;
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
HWY_INLINE bool load_bucket(const CellPassArguments<Real>& a, std::size_t begin, std::size_t count,
                            BucketPoints<Real>& out) {
    const Tag<Real> d;
    bool one_cell = true;
    for (std::size_t k = 0; k < count; k += HWY_LANES(Real)) {
        Lane3<Real> x;
        Lane<Real> unused;
        hn::LoadInterleaved4(d, a.sorted + 4 * (begin + k), x.x, x.y, x.z, unused);
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
    for (std::size_t bucket = a.first_bucket; bucket < a.last_bucket; ++bucket) {
        const std::size_t end = a.bucket_end[bucket], size = end - begin;
        if (size > 1) {
            if (pushes.count + size * size > Pushes<Real>::most)
                total += apply_pushes(a, pushes);
            if (HWY_UNLIKELY(size * size > Pushes<Real>::most || size > BucketPoints<Real>::most)) {
                total += crowded_bucket(a, begin, end);
            } else {
                const bool one_cell = load_bucket(a, begin, size, points);
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
