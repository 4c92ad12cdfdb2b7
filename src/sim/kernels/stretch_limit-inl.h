// The stretch limit's Gauss-Seidel sweep in spring order. Most springs are within the limit: they are tested a vector
// of points at a time, and only where a point has a spring that may be over it are its springs gone through one by one.
//
// That gives the plain sweep's bits. A point's springs are tested after all that comes before its vector is done; a
// correction within the vector moves the point i or one before it, which, of the later points of the same vector, only
// i + 1 and i + 2 have springs to (a vector being shorter than a row less three): those springs are gone through as
// well.
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

/// Of the points i, i + 1, ..., those of which a spring may be over the limit, by stencil entry; by squares, and a few
/// units in the last place early, so that none is missed.
template <class Real>
struct MayBeOver {
    LaneMask<Real> up, left, upper_left, upper_right, two_left, two_up;
    LaneMask<Real> any() const {
        return hn::Or(hn::Or(hn::Or(up, left), hn::Or(upper_left, upper_right)), hn::Or(two_left, two_up));
    }
};

template <class Real>
HWY_INLINE LaneMask<Real> longer(const LimitArguments<Real>& a, const Lane3<Real>& x, std::size_t s, std::ptrdiff_t i,
                                 std::ptrdiff_t other) {
    const Tag<Real> d;
    const Lane3<Real> v = subtract3(load3(a.x, other), x);
    const auto rest = hn::LoadU(d, a.rest.of[s] + (static_cast<std::size_t>(i) & a.rest.mask));
    return hn::Gt(dot3(v, v), hn::Mul(hn::Mul(rest, rest), hn::Set(d, limit_filter<Real>)));
}

/// Of the points before `end`, which have so many rows above them, up to two. What their springs reach must lie in the
/// array, also where there is no spring.
template <int rows_above, class Real>
HWY_INLINE MayBeOver<Real> may_be_over(const LimitArguments<Real>& a, const Columns<Real>& column, std::ptrdiff_t i,
                                       std::size_t end) {
    const auto columns = static_cast<std::ptrdiff_t>(a.columns);
    const Lane3<Real> x = load3(a.x, i);
    const auto exists = lanes_before<Real>(static_cast<std::ptrdiff_t>(end) - i);
    const auto has_left = hn::And(exists, column.has_left());
    const auto none = hn::FirstN(Tag<Real>(), 0);
    MayBeOver<Real> over{none,
                         hn::And(has_left, longer(a, x, 1, i, i - 1)),
                         none,
                         none,
                         hn::And(hn::And(exists, column.has_two_left()), longer(a, x, 4, i, i - 2)),
                         none};
    if constexpr (rows_above >= 1) {
        over.up = hn::And(exists, longer(a, x, 0, i, i - columns));
        over.upper_left = hn::And(has_left, longer(a, x, 2, i, i - columns - 1));
        over.upper_right = hn::And(hn::And(exists, column.has_right()), longer(a, x, 3, i, i - columns + 1));
    }
    if constexpr (rows_above == 2)
        over.two_up = hn::And(exists, longer(a, x, 5, i, i - 2 * columns));
    return over;
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
        if (!hn::AllFalse(d, may_be_over<2>(a, column, static_cast<std::ptrdiff_t>(i), a.points).any()))
            return i;
        column.advance();
    }
    return a.points;
}

/// A vector of points before `end`, of which some springs may be over the limit, gone through one by one: those with a
/// bit set, by stencil entry.
template <class Real>
HWY_INLINE std::size_t limit_vector(const LimitArguments<Real>& a, std::size_t i, std::size_t end,
                                    const MayBeOver<Real>& over) {
    constexpr std::size_t step = HWY_LANES(Real);
    const std::uint32_t bits[stencil_size] = {bits_of<Real>(over.up),         bits_of<Real>(over.left),
                                              bits_of<Real>(over.upper_left), bits_of<Real>(over.upper_right),
                                              bits_of<Real>(over.two_left),   bits_of<Real>(over.two_up)};
    const auto over_limit = [&](std::uint32_t l) {
        SpringSet springs = 0;
        for (std::uint32_t s = 0; s < stencil_size; ++s)
            springs |= (bits[s] >> l & 1u) << s;
        return springs;
    };
    const std::uint32_t all = static_cast<std::uint32_t>((1u << HWY_MIN(end - i, step)) - 1u);
    const bool short_rows = a.columns < step + 3;
    std::size_t count = 0;
    // What corrections make necessary at the next two points.
    SpringSet next = 0, second = 0;
    std::uint32_t last = 0;
    for (std::uint32_t points = bits_of<Real>(over.any()); points != 0; points &= points - 1) {
        const auto l = static_cast<std::uint32_t>(std::countr_zero(points));
        SpringSet todo = over_limit(l) | (l == last + 1 ? next : l == last + 2 ? second : 0);
        next = l == last + 1 ? second : 0;
        second = 0;
        last = l;
        if (short_rows && count != 0)
            todo = all_springs; // a correction may have moved any point that these springs tie
        const SpringSet done = limit_point(a, i + l, todo);
        if (done == 0)
            continue;
        count += static_cast<std::size_t>(std::popcount(done));
        if (short_rows) {
            points |= all & (~1u << l);
            continue;
        }
        // What moved is this point and the other ends of `done`: which springs of the next two points end there?
        constexpr SpringSet up = 1, left = 2, upper_left = 4, upper_right = 8, two_left = 16;
        next |= left | ((done & up) != 0 ? upper_left : 0) | ((done & left) != 0 ? two_left : 0) |
                ((done & upper_right) != 0 ? up : 0);
        second = two_left | ((done & upper_right) != 0 ? upper_left : 0);
        points |= all & (6u << l);
    }
    return count;
}

/// The sweep at the points [begin, end), that have so many rows above them, up to two. Returns how many springs it
/// shortened.
template <int rows_above, class Real>
HWY_INLINE std::size_t limit_rows(const LimitArguments<Real>& a, std::size_t begin, std::size_t end) {
    const Tag<Real> d;
    std::size_t shortened = 0;
    Columns<Real> column(a.columns, begin);
    for (std::size_t i = begin; i < end; i += HWY_LANES(Real)) {
        const MayBeOver<Real> over = may_be_over<rows_above>(a, column, static_cast<std::ptrdiff_t>(i), end);
        if (HWY_UNLIKELY(!hn::AllFalse(d, over.any())))
            shortened += limit_vector(a, i, end, over);
        column.advance();
    }
    return shortened;
}

template <class Real>
std::size_t limit(const LimitArguments<Real>& a, std::size_t from) {
    const std::size_t vectors = vectors_from(a), head = HWY_MIN(vectors, a.points);
    // In the first two rows all but those points whose springs would reach before the array.
    const auto one = [&](std::size_t i) {
        return i < head ? static_cast<std::size_t>(std::popcount(limit_point(a, i))) : 0;
    };
    const std::size_t first = HWY_MIN(a.columns, std::size_t{2});
    std::size_t shortened = 0;
    for (std::size_t i = 0; i < first; ++i)
        shortened += one(i);
    shortened += limit_rows<0>(a, first, HWY_MIN(a.columns, head));
    shortened += one(a.columns);
    shortened += limit_rows<1>(a, a.columns + 1, HWY_MIN(2 * a.columns, head));
    shortened += limit_rows<2>(a, 2 * a.columns, head);
    if (shortened != 0 || from < vectors)
        from = vectors;
    return shortened + limit_rows<2>(a, from, a.points);
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
