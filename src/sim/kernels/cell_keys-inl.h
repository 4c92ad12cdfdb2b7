// Keys of the cells that points lie in, and where in them.
#if defined(CLOTHLAB_SIM_KERNELS_CELL_KEYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLOTHLAB_SIM_KERNELS_CELL_KEYS_INL_H
#undef CLOTHLAB_SIM_KERNELS_CELL_KEYS_INL_H
#else
#define CLOTHLAB_SIM_KERNELS_CELL_KEYS_INL_H
#endif

#include <array>
#include <cmath>
#include <limits>

#include "sim/kernels/near_pairs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clothlab::sim::HWY_NAMESPACE {

/// Whole numbers from 0 to 8388607 as integers, and all others as some integer of at most 23 bits.
template <class Real>
HWY_INLINE hn::Vec<hn::Rebind<std::uint32_t, Tag<Real>>> whole(Lane<Real> v) {
    const hn::Rebind<std::uint32_t, Tag<Real>> du;
    const auto bits = hn::Set(du, (1u << 23) - 1);
    if constexpr (sizeof(Real) == 4) // the last bits of a float that is so much larger count ones
        return hn::And(hn::BitCast(du, hn::Add(v, hn::Set(Tag<Real>(), Real(1 << 23)))), bits);
    else
        return hn::And(hn::BitCast(du, hn::DemoteTo(hn::Rebind<std::int32_t, Tag<Real>>(), v)), bits);
}

/// The cells that bound those of the points, which are the cells of the points' bounds. NaN is in no cell and bounds
/// nothing.
template <class Real>
HWY_INLINE CellKeys<Real> find_bounds(const CellKeyArguments<Real>& a) {
    const Tag<Real> d;
    const auto infinity = hn::Set(d, std::numeric_limits<Real>::infinity());
    Lane3<Real> low{infinity, infinity, infinity}, high{hn::Neg(infinity), hn::Neg(infinity), hn::Neg(infinity)};
    const auto include = [&](LaneMask<Real> counts, Lane<Real> x, Lane<Real>& least, Lane<Real>& largest) HWY_ATTR {
        least = hn::Min(least, hn::IfThenElse(counts, x, infinity));
        largest = hn::Max(largest, hn::IfThenElse(counts, x, hn::Neg(infinity)));
    };
    for (const PointSpan span : a.points) {
        std::size_t k = span.begin;
        for (; k + HWY_LANES(Real) <= span.end; k += HWY_LANES(Real)) {
            const Lane3<Real> x = load3(a.x, static_cast<std::ptrdiff_t>(k));
            include(hn::Eq(x.x, x.x), x.x, low.x, high.x);
            include(hn::Eq(x.y, x.y), x.y, low.y, high.y);
            include(hn::Eq(x.z, x.z), x.z, low.z, high.z);
        }
        const auto exists = lanes_before<Real>(static_cast<std::ptrdiff_t>(span.end - k));
        const Lane3<Real> x = load3(a.x, static_cast<std::ptrdiff_t>(k));
        include(hn::And(exists, hn::Eq(x.x, x.x)), x.x, low.x, high.x);
        include(hn::And(exists, hn::Eq(x.y, x.y)), x.y, low.y, high.y);
        include(hn::And(exists, hn::Eq(x.z, x.z)), x.z, low.z, high.z);
    }
    CellKeys<Real> keys{};
    const auto set = [&](std::size_t axis, Lane<Real> lows, Lane<Real> highs) HWY_ATTR {
        const Real least = hn::GetLane(hn::MinOfLanes(d, lows)), largest = hn::GetLane(hn::MaxOfLanes(d, highs));
        keys.low[axis] = hn::GetLane(cell_of<Real>(hn::Set(d, least), a.size[axis]));
        keys.high[axis] = hn::GetLane(cell_of<Real>(hn::Set(d, largest), a.size[axis]));
        keys.largest = HWY_MAX(keys.largest, HWY_MAX(std::abs(least), std::abs(largest)));
    };
    set(0, low.x, high.x);
    set(1, low.y, high.y);
    set(2, low.z, high.z);
    return keys;
}

template <class Real>
CellKeys<Real> cell_keys(const CellKeyArguments<Real>& arguments) {
    const CellKeyArguments<Real> a = arguments; // what is stored is none of them: they stay in registers
    const Tag<Real> d;
    const hn::Rebind<std::uint32_t, Tag<Real>> du;
    CellKeys<Real> keys = find_bounds(a);
    // In a box that is not too large a cell's key is its place there, and otherwise some sum. Few enough along each
    // axis that a float tells them apart, few enough in all for an integer, and for a place.
    std::array<double, 3> along;
    for (std::size_t axis = 0; axis < 3; ++axis)
        along[axis] = static_cast<double>(keys.high[axis]) - static_cast<double>(keys.low[axis]) + 1;
    const double most = HWY_MIN(2e9, std::ldexp(no_cell, a.bucket_bits));
    keys.exact = along[0] < 8e6 && along[1] < 8e6 && along[2] < 8e6 && along[0] * along[1] * along[2] < most;
    std::array<std::uint32_t, 3> factor{73856093, 19349663, 83492791};
    if (keys.exact)
        factor = {1, static_cast<std::uint32_t>(along[0]), static_cast<std::uint32_t>(along[0] * along[1])};
    const Real longest = HWY_MAX(HWY_MAX(a.size[0], a.size[1]), a.size[2]);
    const auto per_cell = [&](std::size_t axis) { return Real(cell_units) * (a.size[axis] / longest); };
    const auto from = [&](std::size_t axis) { return keys.exact ? keys.low[axis] : Real(0); };
    const Lane3<Real> size = set3(a.size[0], a.size[1], a.size[2]), low = set3(from(0), from(1), from(2)),
                      units = set3(per_cell(0), per_cell(1), per_cell(2));
    const auto factor_x = hn::Set(du, factor[0]), factor_y = hn::Set(du, factor[1]), factor_z = hn::Set(du, factor[2]);
    const auto look = [&](Lane<Real> at, Lane<Real> length, Lane<Real> first, Lane<Real> scale, Lane<Real>& cells,
                          Lane<Real>& inside) HWY_ATTR {
        const auto share = hn::Div(at, length), c = hn::Floor(share);
        cells = hn::Sub(c, first);
        inside = hn::Mul(hn::Sub(share, c), scale);
    };
    const auto find = [&](std::size_t k) HWY_ATTR {
        const Lane3<Real> at = load3(a.x, static_cast<std::ptrdiff_t>(k));
        Lane3<Real> cells, inside;
        look(at.x, size.x, low.x, units.x, cells.x, inside.x);
        look(at.y, size.y, low.y, units.y, cells.y, inside.y);
        look(at.z, size.z, low.z, units.z, cells.z, inside.z);
        const auto bits =
            hn::Add(hn::Add(hn::Mul(whole<Real>(cells.x), factor_x), hn::Mul(whole<Real>(cells.y), factor_y)),
                    hn::Mul(whole<Real>(cells.z), factor_z));
        // Only numbers equal themselves.
        const auto all = hn::Add(hn::Add(inside.x, inside.y), inside.z);
        const auto none = whole<Real>(hn::IfThenElseZero(hn::Ne(all, all), hn::Set(d, Real(no_cell))));
        const auto which = hn::Or(hn::ShiftRightSame(bits, a.bucket_bits), none);
        hn::StoreU(bits, du, a.key + k);
        hn::StoreInterleaved2(hn::Or(whole<Real>(inside.x), hn::ShiftLeft<16>(whole<Real>(inside.y))),
                              hn::Or(whole<Real>(inside.z), hn::ShiftLeft<16>(which)), du,
                              reinterpret_cast<std::uint32_t*>(a.places + k));
    };
    for (const PointSpan span : a.points)
        for (std::size_t k = span.begin; k < span.end; k += HWY_LANES(Real))
            find(k);
    if (!keys.exact)
        for (const PointSpan span : a.points)
            for (std::size_t k = span.begin; k < span.end; k += HWY_LANES(Real))
                for (std::size_t axis = 0; axis < 3; ++axis)
                    hn::StoreU(cell_of<Real>(hn::LoadU(d, a.x[axis] + k), a.size[axis]), d, a.cell[axis] + k);
    return keys;
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
