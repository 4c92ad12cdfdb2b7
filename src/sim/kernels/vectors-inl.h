// What the kernels share: vectors of three coordinates, lane masks of the grid's borders, shifts across vectors.
// Included once per instruction set, as Highway's foreach_target.h does it.
#if defined(CLOTHLAB_SIM_KERNELS_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLOTHLAB_SIM_KERNELS_VECTORS_INL_H
#undef CLOTHLAB_SIM_KERNELS_VECTORS_INL_H
#else
#define CLOTHLAB_SIM_KERNELS_VECTORS_INL_H
#endif

#include <hwy/highway.h>

#include "sim/kernels/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace clothlab::sim::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class Real>
using Tag = hn::ScalableTag<Real>;
template <class Real>
using Lane = hn::Vec<Tag<Real>>;
template <class Real>
using LaneMask = hn::Mask<Tag<Real>>;
/// Lanes of a vector: fixed for each instruction set that is compiled.
template <class Real>
inline constexpr std::ptrdiff_t lanes = static_cast<std::ptrdiff_t>(HWY_LANES(Real));

template <class Real>
struct Lane3 {
    Lane<Real> x, y, z;
};

template <class Real>
HWY_INLINE Lane3<Real> zero3() {
    const auto zero = hn::Zero(Tag<Real>());
    return {zero, zero, zero};
}
template <class Real>
HWY_INLINE Lane3<Real> load3(const ConstAxes<Real>& axes, std::ptrdiff_t i) {
    const Tag<Real> d;
    return {hn::LoadU(d, axes[0] + i), hn::LoadU(d, axes[1] + i), hn::LoadU(d, axes[2] + i)};
}
template <class Real>
HWY_INLINE Lane3<Real> load3(const Axes<Real>& axes, std::ptrdiff_t i) {
    return load3(ConstAxes<Real>{axes[0], axes[1], axes[2]}, i);
}
template <class Real>
HWY_INLINE void store3(const Lane3<Real>& v, const Axes<Real>& axes, std::ptrdiff_t i) {
    const Tag<Real> d;
    hn::StoreU(v.x, d, axes[0] + i);
    hn::StoreU(v.y, d, axes[1] + i);
    hn::StoreU(v.z, d, axes[2] + i);
}
template <class Real>
HWY_INLINE Lane3<Real> add3(const Lane3<Real>& a, const Lane3<Real>& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
template <class Real>
HWY_INLINE Lane3<Real> subtract3(const Lane3<Real>& a, const Lane3<Real>& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class Real>
HWY_INLINE Lane3<Real> scale3(Lane<Real> s, const Lane3<Real>& a) {
    return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
template <class Real>
HWY_INLINE Lane3<Real> keep3(LaneMask<Real> mask, const Lane3<Real>& a) {
    return {hn::IfThenElseZero(mask, a.x), hn::IfThenElseZero(mask, a.y), hn::IfThenElseZero(mask, a.z)};
}
template <class Real>
HWY_INLINE Lane3<Real> choose3(LaneMask<Real> mask, const Lane3<Real>& a, const Lane3<Real>& b) {
    return {hn::IfThenElse(mask, a.x, b.x), hn::IfThenElse(mask, a.y, b.y), hn::IfThenElse(mask, a.z, b.z)};
}
/// Summed from the left, as the plain loops do.
template <class Real>
HWY_INLINE Lane<Real> dot3(const Lane3<Real>& a, const Lane3<Real>& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
template <class Real>
HWY_INLINE Lane3<Real> set3(Real x, Real y, Real z) {
    const Tag<Real> d;
    return {hn::Set(d, x), hn::Set(d, y), hn::Set(d, z)};
}

/// The lanes n, n + 1, ... of `low` followed by `high`; n is at most half of a vector, or all of it.
template <int n, class Real>
HWY_INLINE Lane<Real> shifted(Lane<Real> high, Lane<Real> low) {
    constexpr int all = static_cast<int>(lanes<Real>);
    static_assert(n > 0 && (2 * n <= all || n == all));
    const Tag<Real> d;
    if constexpr (n == all) {
        return high;
    } else {
#if HWY_TARGET == HWY_AVX3
        const hn::RebindToSigned<Tag<Real>> di;
        using Bits = hn::Vec<decltype(di)>;
        const auto h = hn::BitCast(di, high).raw, l = hn::BitCast(di, low).raw;
        if constexpr (sizeof(Real) == 4)
            return hn::BitCast(d, Bits{_mm512_alignr_epi32(h, l, n)});
        else
            return hn::BitCast(d, Bits{_mm512_alignr_epi64(h, l, n)});
#elif HWY_TARGET == HWY_AVX2
        const auto middle = hn::ConcatLowerUpper(d, high, low);
        if constexpr (2 * n == all)
            return middle;
        else
            return hn::CombineShiftRightLanes<n>(d, middle, low);
#else
        return hn::CombineShiftRightLanes<n>(d, high, low);
#endif
    }
}
template <int n, class Real>
HWY_INLINE Lane3<Real> shifted3(const Lane3<Real>& high, const Lane3<Real>& low) {
    return {shifted<n, Real>(high.x, low.x), shifted<n, Real>(high.y, low.y), shifted<n, Real>(high.z, low.z)};
}

/// Lanes l with l >= count.
template <class Real>
HWY_INLINE LaneMask<Real> lanes_from(std::ptrdiff_t count) {
    const Tag<Real> d;
    const std::ptrdiff_t clamped = HWY_MIN(HWY_MAX(count, std::ptrdiff_t{0}), lanes<Real>);
    return hn::Ge(hn::Iota(d, Real(0)), hn::Set(d, static_cast<Real>(clamped)));
}
/// Lanes l with l < count.
template <class Real>
HWY_INLINE LaneMask<Real> lanes_before(std::ptrdiff_t count) {
    const Tag<Real> d;
    const std::ptrdiff_t clamped = HWY_MIN(HWY_MAX(count, std::ptrdiff_t{0}), lanes<Real>);
    return hn::Lt(hn::Iota(d, Real(0)), hn::Set(d, static_cast<Real>(clamped)));
}

/// One bit per lane.
template <class Real>
HWY_INLINE std::uint32_t bits_of(LaneMask<Real> mask) {
#if HWY_TARGET == HWY_AVX3
    return static_cast<std::uint32_t>(mask.raw);
#elif HWY_TARGET == HWY_AVX2
    if constexpr (sizeof(Real) == 4)
        return static_cast<std::uint32_t>(_mm256_movemask_ps(mask.raw));
    else
        return static_cast<std::uint32_t>(_mm256_movemask_pd(mask.raw));
#else
    std::uint8_t bytes[8] = {}; // the function may write as many
    hn::StoreMaskBits(Tag<Real>(), mask, bytes);
    return bytes[0] & ((1u << lanes<Real>)-1u);
#endif
}

/// Has v computed where this stands. GCC would do it where v is used, and keep in memory until then, for want of
/// registers, what it is made of.
template <class Real>
HWY_INLINE void compute_here(Lane<Real>& v) {
#if HWY_ARCH_X86 && !HWY_COMPILER_MSVC
    asm("" : "+v"(v.raw));
#else
    (void)v;
#endif
}

/// Follows the column of each lane along the flat array, to tell which neighbours there are.
#if HWY_TARGET == HWY_AVX3
/// Where masks are bits they need no vector: of the columns' vectors and constants some would not fit into registers.
template <class Real>
class Columns {
public:
    Columns(std::size_t columns, std::size_t start)
        : columns_(columns), step_(HWY_LANES(Real) % columns), next_row_((columns - start % columns) % columns) {
        for (std::size_t bit = 0; bit < 64; bit += columns)
            row_starts_ |= std::uint64_t{1} << bit;
    }
    HWY_INLINE LaneMask<Real> has_left() const { return none_of(starts()); }
    HWY_INLINE LaneMask<Real> has_two_left() const {
        return none_of(starts() | starts() << 1 | (next_row_ + 1 == columns_ ? 1 : 0));
    }
    HWY_INLINE LaneMask<Real> has_right() const { return none_of(starts() >> 1); }
    HWY_INLINE void advance() {
        next_row_ += next_row_ >= step_ ? 0 : columns_;
        next_row_ -= step_;
    }

private:
    /// The lanes in which a row begins, and those that would follow the last lane.
    HWY_INLINE std::uint64_t starts() const { return row_starts_ << HWY_MIN(next_row_, std::size_t{63}); }
    static HWY_INLINE LaneMask<Real> none_of(std::uint64_t lanes) {
        LaneMask<Real> mask;
        mask.raw = static_cast<decltype(mask.raw)>(~lanes);
        return mask;
    }
    std::size_t columns_, step_, next_row_; ///< lanes from the first one to where a row begins
    std::uint64_t row_starts_ = 0;          ///< as if the first lane began one
};
#else
template <class Real>
class Columns {
public:
    Columns(std::size_t columns, std::size_t start) {
        const Tag<Real> d;
        HWY_ALIGN Real first[HWY_LANES(Real)];
        // One division, not one for each lane: a sweep of a small cloth would notice.
        std::size_t column = start % columns;
        for (std::size_t l = 0; l < HWY_LANES(Real); ++l) {
            first[l] = static_cast<Real>(column);
            column = column + 1 < columns ? column + 1 : 0;
        }
        column_ = hn::Load(d, first);
        width_ = hn::Set(d, static_cast<Real>(columns));
        last_ = hn::Set(d, static_cast<Real>(columns - 1));
        step_ = hn::Set(d, static_cast<Real>(HWY_LANES(Real) % columns));
    }
    HWY_INLINE LaneMask<Real> has_left() const { return hn::Ge(column_, hn::Set(Tag<Real>(), Real(1))); }
    HWY_INLINE LaneMask<Real> has_two_left() const { return hn::Ge(column_, hn::Set(Tag<Real>(), Real(2))); }
    HWY_INLINE LaneMask<Real> has_right() const { return hn::Lt(column_, last_); }
    HWY_INLINE void advance() {
        column_ = hn::Add(column_, step_);
        column_ = hn::Sub(column_, hn::IfThenElseZero(hn::Ge(column_, width_), width_));
    }

private:
    Lane<Real> column_, width_, last_, step_;
};
#endif

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
