// The vector parts of the self-collision: which points are near each other in the grid, cells, and the course's rule
// within one cell.
#if defined(CLOTHLAB_SIM_KERNELS_SELF_COLLISION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLOTHLAB_SIM_KERNELS_SELF_COLLISION_INL_H
#undef CLOTHLAB_SIM_KERNELS_SELF_COLLISION_INL_H
#else
#define CLOTHLAB_SIM_KERNELS_SELF_COLLISION_INL_H
#endif

#include <bit>
#include <limits>

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
        mark_near(a.near, static_cast<std::size_t>(i));
        mark_near(a.near, static_cast<std::size_t>(other));
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
    a.pairs = pairs;
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
void cells(const CellArguments<Real>& a, ConstAxes<Real> x, std::size_t count, Axes<Real> out) {
    const Tag<Real> d;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t k = 0; k < count; k += HWY_LANES(Real))
            hn::StoreU(cell_of<Real>(hn::LoadU(d, x[axis] + k), a.cell[axis]), d, out[axis] + k);
}

template <class Real>
void buckets(const CellArguments<Real>& a) {
    const Tag<Real> d;
    const hn::Rebind<std::int32_t, Tag<Real>> di;
    HWY_ALIGN Real gathered[3][HWY_LANES(Real)] = {};
    HWY_ALIGN std::int32_t hashes[HWY_LANES(Real)];
    constexpr std::int32_t primes[3] = {73856093, 19349663, 83492791};
    for (std::size_t k = 0; k < a.count; k += HWY_LANES(Real)) {
        const std::size_t n = HWY_MIN(a.count - k, HWY_LANES(Real));
        for (std::size_t l = 0; l < n; ++l)
            for (std::size_t axis = 0; axis < 3; ++axis)
                gathered[axis][l] = a.x[axis][a.active[k + l]];
        auto hash = hn::Zero(di);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto cell = cell_of<Real>(hn::Load(d, gathered[axis]), a.cell[axis]);
            hash = hn::Xor(hash, hn::Mul(whole<Real>(cell), hn::Set(di, primes[axis])));
        }
        hash = hn::Xor(hash, hn::ShiftRight<13>(hash));
        hn::Store(hash, di, hashes);
        for (std::size_t l = 0; l < n; ++l)
            a.bucket[k + l] = static_cast<std::uint32_t>(hashes[l]) & a.bucket_mask;
    }
}

/// The pushes on the point at (x, y, z) in a cell from the sorted points `first`, `first + 1`, ...: added to `sum` one
/// by one in their order, as the plain loop does. Returns how many.
template <class Real>
HWY_INLINE int add_pushes(const Lane3<Real>& others, const ConstAxes<Real>& cells, std::size_t first,
                          const Lane3<Real>& x, const Lane3<Real>& cell, Real apart, Real (&sum)[3]) {
    const Tag<Real> d;
    const Lane3<Real> v = subtract3(x, others);
    const auto square = dot3(v, v);
    const auto reach = hn::Set(d, apart);
    const Lane3<Real> c = load3(cells, static_cast<std::ptrdiff_t>(first));
    const auto same = hn::And(hn::And(hn::Eq(c.x, cell.x), hn::Eq(c.y, cell.y)), hn::Eq(c.z, cell.z));
    const auto length = hn::Sqrt(square);
    const auto near = hn::And(same, hn::And(hn::Lt(length, reach), hn::Gt(length, hn::Zero(d))));
    if (hn::AllFalse(d, near))
        return 0;
    const Lane3<Real> push = scale3<Real>(hn::Div(hn::Sub(reach, length), length), v);
    HWY_ALIGN Real pushes[3][HWY_LANES(Real)];
    hn::Store(push.x, d, pushes[0]);
    hn::Store(push.y, d, pushes[1]);
    hn::Store(push.z, d, pushes[2]);
    std::uint32_t bits = bits_of<Real>(near);
    const int count = std::popcount(bits);
    for (; bits != 0; bits &= bits - 1) {
        const int l = std::countr_zero(bits);
        sum[0] += pushes[0][l];
        sum[1] += pushes[1][l];
        sum[2] += pushes[2][l];
    }
    return count;
}

/// One bucket after the other, each point in index order, against all points of its bucket, where they are by then. A
/// bucket may hold several cells; only points of the same cell push each other, and so each pair counts once.
template <class Real>
std::size_t cell_pass(const CellPassArguments<Real>& a) {
    const Tag<Real> d;
    constexpr std::size_t step = HWY_LANES(Real);
    const ConstAxes<Real> sorted{a.sorted[0], a.sorted[1], a.sorted[2]};
    std::size_t pairs = 0;
    std::size_t begin = a.first_bucket == 0 ? 0 : a.bucket_end[a.first_bucket - 1];
    for (std::size_t bucket = a.first_bucket; bucket < a.last_bucket; ++bucket) {
        const std::size_t end = a.bucket_end[bucket];
        const std::size_t count = end - begin;
        // Up to a vector of points stay in registers while they are moved.
        Lane3<Real> held = load3(sorted, static_cast<std::ptrdiff_t>(begin));
        for (std::size_t k = begin; k < end && count > 1; ++k) {
            const std::uint32_t i = a.order[k];
            if (a.pinned[i])
                continue;
            const Lane3<Real> x = set3(sorted[0][k], sorted[1][k], sorted[2][k]);
            const Lane3<Real> cell = set3(a.cells[0][k], a.cells[1][k], a.cells[2][k]);
            Real sum[3] = {};
            int pushes = 0;
            if (count <= step)
                pushes = add_pushes<Real>(held, a.cells, begin, x, cell, a.apart, sum);
            else
                for (std::size_t first = begin; first < end; first += step)
                    pushes += add_pushes<Real>(load3(sorted, static_cast<std::ptrdiff_t>(first)), a.cells, first, x,
                                               cell, a.apart, sum);
            if (pushes == 0)
                continue;
            const Real share = static_cast<Real>(pushes) * a.substeps;
            for (std::size_t axis = 0; axis < 3; ++axis)
                a.x[axis][i] = a.sorted[axis][k] += sum[axis] / share;
            if (count <= step) {
                const auto own = hn::Eq(hn::Iota(d, Real(0)), hn::Set(d, static_cast<Real>(k - begin)));
                held = choose3<Real>(own, set3(sorted[0][k], sorted[1][k], sorted[2][k]), held);
            }
            pairs += static_cast<std::size_t>(pushes);
        }
        begin = end;
    }
    return pairs;
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
