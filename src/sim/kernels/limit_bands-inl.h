// The stretch limit's Gauss-Seidel sweep as a wavefront (sim/limit_bands.h): vectors across rows. For cloths of which
// many springs are over the limit.
#if defined(CLOTHLAB_SIM_KERNELS_LIMIT_BANDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLOTHLAB_SIM_KERNELS_LIMIT_BANDS_INL_H
#undef CLOTHLAB_SIM_KERNELS_LIMIT_BANDS_INL_H
#else
#define CLOTHLAB_SIM_KERNELS_LIMIT_BANDS_INL_H
#endif

#include <bit>

#include "sim/kernels/vectors-inl.h"
#include "sim/limit_bands.h"
#include "sim/stretch_limit.h"

HWY_BEFORE_NAMESPACE();
namespace clothlab::sim::HWY_NAMESPACE {

/// Transposes four times four values, of lines that lie a step apart.
template <class Real>
HWY_INLINE void transpose4(const Real* from, std::ptrdiff_t from_step, Real* to, std::ptrdiff_t to_step) {
    if constexpr (sizeof(Real) == 4 || HWY_LANES(Real) >= 4) {
        const hn::FixedTag<Real, 4> d;
        const auto a = hn::LoadU(d, from), b = hn::LoadU(d, from + from_step), c = hn::LoadU(d, from + 2 * from_step),
                   e = hn::LoadU(d, from + 3 * from_step);
        const auto ab_lower = hn::InterleaveLower(d, a, b), ab_upper = hn::InterleaveUpper(d, a, b);
        const auto ce_lower = hn::InterleaveLower(d, c, e), ce_upper = hn::InterleaveUpper(d, c, e);
        // Two doubles are a block of 128 bits, within which vectors are interleaved; so are four floats.
        constexpr std::ptrdiff_t second = sizeof(Real) == 4 ? 1 : 2, third = 3 - second;
        hn::StoreU(hn::ConcatLowerLower(d, ce_lower, ab_lower), d, to);
        hn::StoreU(hn::ConcatUpperUpper(d, ce_lower, ab_lower), d, to + second * to_step);
        hn::StoreU(hn::ConcatLowerLower(d, ce_upper, ab_upper), d, to + third * to_step);
        hn::StoreU(hn::ConcatUpperUpper(d, ce_upper, ab_upper), d, to + 3 * to_step);
    } else {
        for (std::ptrdiff_t row = 0; row < 4; ++row)
            for (std::ptrdiff_t column = 0; column < 4; ++column)
                to[column * to_step + row] = from[row * from_step + column];
    }
}

/// Copies a band's points from where they lie by rows to where they lie by slots, or back.
template <bool back, class Real>
HWY_INLINE void copy_band(const BandArguments<Real>& a) {
    // Of four rows that follow each other, those columns that lie in the same slots: each four.
    constexpr std::ptrdiff_t block = 4, skew = block * band_lag - band_lag;
    static_assert(band_lag == block);
    const std::ptrdiff_t blocks = a.columns > skew ? (a.columns - skew) / block : 0;
    const std::ptrdiff_t row_step = a.columns - band_lag; // between places of the same slot
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto copy = [&](std::ptrdiff_t row, std::ptrdiff_t from, std::ptrdiff_t to) {
            Real *points = a.points[axis] + row * a.columns, *band = a.x[axis] + row * (band_lag * band_stride + 1);
            for (std::ptrdiff_t column = from; column < to; ++column)
                if constexpr (back)
                    points[column] = band[column * band_stride];
                else
                    band[column * band_stride] = points[column];
        };
        std::ptrdiff_t row = -a.above;
        for (; row < 0; ++row)
            copy(row, 0, a.columns);
        for (; row + block <= a.rows; row += block) {
            for (std::ptrdiff_t r = 0; r < block; ++r) {
                copy(row + r, 0, HWY_MIN(skew - band_lag * r, a.columns));
                copy(row + r, skew - band_lag * r + block * blocks, a.columns);
            }
            const std::ptrdiff_t first = band_lag * row + skew; // slot
            Real *points = a.points[axis] + row * row_step + first, *band = a.x[axis] + first * band_stride + row;
            for (std::ptrdiff_t b = 0; b < blocks; ++b) {
                if constexpr (back)
                    transpose4(band, band_stride, points, row_step);
                else
                    transpose4(points, row_step, band, band_stride);
                points += block;
                band += block * band_stride;
            }
        }
        for (; row < a.rows; ++row)
            copy(row, 0, a.columns);
    }
}

/// The sweep at a vector of points of different rows, from `row` on, for their springs of stencil entry s. Returns how
/// many were shortened.
template <std::size_t s, bool pins, bool alike, class Real>
HWY_INLINE std::size_t limit_lanes(const BandArguments<Real>& a, std::ptrdiff_t slot, std::ptrdiff_t row) {
    constexpr SpringStencil spring = spring_stencil[s];
    constexpr std::ptrdiff_t other = (spring.columns + band_lag * spring.rows) * band_stride + spring.rows;
    const Tag<Real> d;
    const std::ptrdiff_t at = slot * band_stride + row,
                         entry = slot * static_cast<std::ptrdiff_t>(stencil_size) + static_cast<std::ptrdiff_t>(s);
    const Lane3<Real> x = load3(a.x, at), y = load3(a.x, at + other), v = subtract3(y, x);
    const auto square = dot3(v, v);
    auto rest = hn::Set(d, a.rest_of_all[s]);
    if constexpr (!alike)
        rest = hn::LoadU(d, a.rest + entry * band_rows + row);
    auto may_be_over = hn::Gt(square, hn::Mul(hn::Mul(rest, rest), hn::Set(d, limit_filter<Real>)));
    if constexpr (alike) {
        const std::uint32_t bits = a.exists[entry] >> row;
        may_be_over = hn::And(may_be_over, hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&bits)));
    }
    if (hn::AllFalse(d, may_be_over))
        return 0;
    const auto length = hn::Sqrt(square), longest = hn::Mul(hn::Set(d, static_cast<Real>(stretch_limit)), rest);
    auto over = hn::And(may_be_over, hn::Gt(length, longest));
    const auto whole = hn::Div(hn::Sub(length, longest), length);
    auto share = hn::Mul(hn::Set(d, Real(0.5)), whole);
    auto moves_x = over, moves_y = over;
    if constexpr (pins) {
        const auto x_free = hn::Gt(hn::LoadU(d, a.free + at), hn::Zero(d)),
                   y_free = hn::Gt(hn::LoadU(d, a.free + at + other), hn::Zero(d));
        share = hn::IfThenElse(hn::And(x_free, y_free), share, whole);
        moves_x = hn::And(over, x_free);
        moves_y = hn::And(over, y_free);
        over = hn::Or(moves_x, moves_y);
    }
    const Lane3<Real> move = scale3<Real>(share, v);
    store3(choose3<Real>(moves_x, add3(x, move), x), a.x, at);
    store3(choose3<Real>(moves_y, subtract3(y, move), y), a.x, at + other);
    return static_cast<std::size_t>(std::popcount(bits_of<Real>(over)));
}

template <bool pins, bool alike, class Real>
std::size_t limit_slots(const BandArguments<Real>& a) {
    std::size_t shortened = 0;
    for (std::ptrdiff_t slot = 0; slot < a.columns + band_lag * (a.rows - 1); ++slot) {
        // The rows that have a column at this slot. Their vectors do not wait for each other, a point's springs do.
        const std::ptrdiff_t first = slot < a.columns ? 0 : (slot - a.columns) / band_lag + 1;
        const std::ptrdiff_t last = HWY_MIN(a.rows - 1, slot / band_lag);
        const auto springs = [&](auto entry) HWY_ATTR __attribute__((always_inline)) {
            for (std::ptrdiff_t row = first / lanes<Real> * lanes<Real>; row <= last; row += lanes<Real>)
                shortened += limit_lanes<decltype(entry)::value, pins, alike>(a, slot, row);
        };
        static_assert(stencil_size == 6);
        springs(std::integral_constant<std::size_t, 0>());
        springs(std::integral_constant<std::size_t, 1>());
        springs(std::integral_constant<std::size_t, 2>());
        springs(std::integral_constant<std::size_t, 3>());
        springs(std::integral_constant<std::size_t, 4>());
        springs(std::integral_constant<std::size_t, 5>());
    }
    return shortened;
}

template <class Real>
std::size_t limit_band(const BandArguments<Real>& a) {
    copy_band<false>(a);
    const std::size_t shortened = a.rest ? (a.free ? limit_slots<true, false>(a) : limit_slots<false, false>(a))
                                         : (a.free ? limit_slots<true, true>(a) : limit_slots<false, true>(a));
    copy_band<true>(a);
    return shortened;
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
