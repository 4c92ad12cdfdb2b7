// The stretch limit's Gauss-Seidel sweep in spring order. Most springs are within the limit: they are tested a vector
// of points at a time, and only where a point has a spring that may be over it are its springs gone through one by one.
//
// That gives the plain sweep's bits. A point's springs are tested after all that comes before its vector is done; a
// correction within the vector moves the point i or one before it, which, of the later points of the same vector, only
// i + 1 and i + 2 have springs to (a vector being shorter than a row less three): they are gone through as well.
#if defined(CLOTHLAB_SIM_KERNELS_STRETCH_LIMIT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLOTHLAB_SIM_KERNELS_STRETCH_LIMIT_INL_H
#undef CLOTHLAB_SIM_KERNELS_STRETCH_LIMIT_INL_H
#else
#define CLOTHLAB_SIM_KERNELS_STRETCH_LIMIT_INL_H
#endif

#include <bit>
#include <cmath>

#include "sim/kernels/vectors-inl.h"
#include "sim/stretch_limit.h"

HWY_BEFORE_NAMESPACE();
namespace clothlab::sim::HWY_NAMESPACE {

/// The points i, i + 1, ... of which an own spring may be over the limit, by squares; a few units in the last place
/// early, so that none is missed. Two rows must lie before i.
template <class Real>
HWY_INLINE LaneMask<Real> may_be_over(const LimitArguments<Real>& a, const Columns<Real>& column, std::ptrdiff_t i) {
    const Tag<Real> d;
    const ConstAxes<Real> axes{a.x[0], a.x[1], a.x[2]};
    const auto columns = static_cast<std::ptrdiff_t>(a.columns);
    const Lane3<Real> x = load3(axes, i);
    const auto square_limit = hn::Set(d, limit_filter<Real>);
    const auto over = [&](std::size_t s, std::ptrdiff_t other) HWY_ATTR {
        const Lane3<Real> v = subtract3(load3(axes, i + other), x);
        const auto rest = hn::LoadU(d, a.rest.of[s] + (static_cast<std::size_t>(i) & a.rest.mask));
        return hn::Gt(dot3(v, v), hn::Mul(hn::Mul(rest, rest), square_limit));
    };
    auto any = hn::Or(over(0, -columns), over(5, -2 * columns));
    any = hn::Or(any, hn::And(hn::Or(over(1, -1), over(2, -columns - 1)), column.has_left()));
    any = hn::Or(any, hn::And(over(3, -columns + 1), column.has_right()));
    any = hn::Or(any, hn::And(over(4, -2), column.has_two_left()));
    return hn::And(any, lanes_before<Real>(static_cast<std::ptrdiff_t>(a.points) - i));
}

/// Where vectors begin that have two rows before them.
template <class Real>
HWY_INLINE std::size_t vectors_from(const LimitArguments<Real>& a) {
    return (2 * a.columns + HWY_LANES(Real) - 1) / HWY_LANES(Real) * HWY_LANES(Real);
}

template <class Real>
std::size_t first_over_limit(const LimitArguments<Real>& a, std::size_t from, std::size_t to) {
    const Tag<Real> d;
    from = HWY_MAX(from, vectors_from(a)); // those before it the sweep does one by one in any case
    Columns<Real> column(a.columns, from);
    for (std::size_t i = from; i < to; i += HWY_LANES(Real)) {
        if (!hn::AllFalse(d, may_be_over(a, column, static_cast<std::ptrdiff_t>(i))))
            return i;
        column.advance();
    }
    return a.points;
}

template <class Real>
std::size_t limit(const LimitArguments<Real>& a, std::size_t from) {
    const Tag<Real> d;
    std::size_t shortened = 0;
    const std::size_t vectors = vectors_from(a);
    for (std::size_t i = 0; i < HWY_MIN(vectors, a.points); ++i)
        shortened += limit_point(a, i);
    if (shortened != 0 || from < vectors)
        from = vectors;
    Columns<Real> column(a.columns, from);
    const bool short_rows = a.columns < HWY_LANES(Real) + 3;
    for (std::size_t i = from; i < a.points; i += HWY_LANES(Real)) {
        std::uint32_t bits = 0;
        if (const auto over = may_be_over(a, column, static_cast<std::ptrdiff_t>(i)); !hn::AllFalse(d, over))
            bits = bits_of<Real>(over);
        column.advance();
        const std::uint32_t all = static_cast<std::uint32_t>((1u << HWY_MIN(a.points - i, HWY_LANES(Real))) - 1u);
        while (bits != 0) {
            const int lane = std::countr_zero(bits);
            bits &= bits - 1;
            const std::size_t done = limit_point(a, i + static_cast<std::size_t>(lane));
            shortened += done;
            if (done != 0)
                bits |= all & (short_rows ? ~0u << (lane + 1) : 6u << lane);
        }
    }
    return shortened;
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
