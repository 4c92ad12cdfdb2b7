// Forces of all springs and the Verlet step in one pass over the points, each spring computed once.
//
// The edge list's order, as seen from one point: its own springs (up, left, upper left, upper right, two to the left,
// two above), then, with the opposite sign, the springs of later points that end at it (of the right neighbour, of the
// second to the right, then of the row below: lower left, below, lower right, and of the second row below). So the
// force on a point is complete two rows after its own springs, and a window of two rows of unfinished forces is all
// that has to be kept: it lies in the first-level cache up to some hundred columns.
//
// A deviation from the design: no row is padded and there is no halo. Vectors run across row ends, and the lanes
// whose neighbour does not exist are masked, which costs three comparisons and nine masked multiplications a vector;
// padding 50 columns to 64 would cost 28 %.
#if defined(CLOTHLAB_SIM_KERNELS_SPRING_SWEEP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLOTHLAB_SIM_KERNELS_SPRING_SWEEP_INL_H
#undef CLOTHLAB_SIM_KERNELS_SPRING_SWEEP_INL_H
#else
#define CLOTHLAB_SIM_KERNELS_SPRING_SWEEP_INL_H
#endif

#include <algorithm>
#include <cstring>

#include "sim/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clothlab::sim::HWY_NAMESPACE {

/// The forces of one vector of points' own springs, and their sum with gravity.
template <class Real>
struct OwnSprings {
    Lane3<Real> up, left, upper_left, upper_right, two_left, two_up, sum;
};

/// A window of unfinished forces along the flat array, which moves with the sweep.
template <class Real>
class ForceWindow {
public:
    ForceWindow(Real* memory, std::ptrdiff_t columns, std::ptrdiff_t begin)
        : capacity_(6 * columns + 8 * static_cast<std::ptrdiff_t>(sweep_grain)), base_(begin - 2 * columns) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            axes_[axis] = memory + static_cast<std::ptrdiff_t>(axis) * capacity_;
    }
    HWY_INLINE Lane3<Real> load(std::ptrdiff_t i) const { return load3(axes_, i - base_); }
    HWY_INLINE void store(const Lane3<Real>& v, std::ptrdiff_t i) const { store3(v, axes_, i - base_); }
    /// Makes room up to `end`; what is before `from` is no longer needed.
    HWY_INLINE void require(std::ptrdiff_t from, std::ptrdiff_t end) {
        if (end - base_ <= capacity_)
            return;
        for (Real* axis : axes_)
            std::memmove(axis, axis + (from - base_),
                         static_cast<std::size_t>(base_ + capacity_ - from) * sizeof(Real));
        base_ = from;
    }

private:
    std::ptrdiff_t capacity_, base_;
    Axes<Real> axes_{};
};

/// What becomes of the complete forces on the points i, i + 1, ...
template <SweepSink sink, class Real>
HWY_INLINE Lane3<Real> swept(const SweepArguments<Real>& a, const Lane3<Real>& f, const ConstAxes<Real>& position,
                             const ConstAxes<Real>& previous, std::ptrdiff_t i) {
    const Tag<Real> d;
    if constexpr (sink == SweepSink::force)
        return f;
    const Lane3<Real> x = load3(position, i), p = load3(previous, i);
    Lane3<Real> moved = subtract3(x, p);
    if constexpr (sink == SweepSink::verlet_damped)
        moved = scale3<Real>(hn::Set(d, a.keep), moved);
    return add3(add3(x, moved), scale3<Real>(hn::Set(d, a.c), f));
}

/// The same for a vector of which only some lanes are in the sweep's range: the others belong to another thread, or to
/// nobody. Not a member, so that the sweep's own variables stay in registers.
template <SweepSink sink, class Real>
HWY_NOINLINE void sweep_some(const SweepArguments<Real>& a, const Lane3<Real>& f, std::ptrdiff_t i) {
    HWY_ALIGN Real x[3][HWY_LANES(Real)] = {}, p[3][HWY_LANES(Real)] = {};
    const std::ptrdiff_t from = std::max(static_cast<std::ptrdiff_t>(a.begin) - i, std::ptrdiff_t{0});
    const std::ptrdiff_t to = std::min(static_cast<std::ptrdiff_t>(a.end) - i, lanes<Real>);
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::ptrdiff_t l = from; l < to; ++l) {
            x[axis][l] = a.x[axis][i + l];
            p[axis][l] = a.out[axis][i + l];
        }
    store3(swept<sink, Real>(a, f, {x[0], x[1], x[2]}, {p[0], p[1], p[2]}, 0), Axes<Real>{p[0], p[1], p[2]}, 0);
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::ptrdiff_t l = from; l < to; ++l)
            a.out[axis][i + l] = p[axis][l];
}

template <unsigned kinds, SweepSink sink, class Real>
class SpringSweep {
    static constexpr bool structural = (kinds & 1u) != 0, shear = (kinds & 2u) != 0, bending = (kinds & 4u) != 0;
    static constexpr std::ptrdiff_t step = lanes<Real>;

public:
    explicit SpringSweep(const SweepArguments<Real>& a)
        : arguments_(a), a_(a), columns_(static_cast<std::ptrdiff_t>(a.columns)),
          points_(static_cast<std::ptrdiff_t>(a.points)), begin_(static_cast<std::ptrdiff_t>(a.begin)),
          end_(static_cast<std::ptrdiff_t>(a.end)), column_(a.columns, a.begin), window_(a.scratch, columns_, begin_) {}

    void run() {
        if (begin_ == 0)
            copy_head();
        OwnSprings<Real> before = springs(begin_);
        Lane3<Real> upper_right_before = zero3<Real>();
        const std::ptrdiff_t stop =
            end_ + 2 * columns_; // the last point is complete after the springs of two rows more
        for (std::ptrdiff_t i = begin_; i < stop; i += step) {
            column_.advance();
            const OwnSprings<Real> now = springs(i + step);
            finish(i, before, now, upper_right_before);
            upper_right_before = before.upper_right;
            before = now;
        }
    }

private:
    /// The first two rows have neighbours before the array's start, which are masked but read: they are computed on a
    /// copy with memory before it.
    void copy_head() {
        const std::ptrdiff_t head = 2 * columns_ + step;
        Real* memory = a_.scratch + 3 * (6 * columns_ + 8 * static_cast<std::ptrdiff_t>(sweep_grain));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Real* copy = memory + 2 * columns_;
            std::memcpy(copy, a_.x[axis], static_cast<std::size_t>(std::min(head, points_)) * sizeof(Real));
            head_[axis] = copy;
            memory += 4 * columns_ + 2 * static_cast<std::ptrdiff_t>(sweep_grain);
        }
    }

    HWY_INLINE OwnSprings<Real> springs(std::ptrdiff_t i) const {
        if (HWY_LIKELY(i >= 2 * columns_ && i + step <= points_))
            return springs<false>(i, a_.x);
        if (i < points_)
            return springs<true>(i, i < 2 * columns_ ? head_ : a_.x);
        const Lane3<Real> none = zero3<Real>();
        return {none, none, none, none, none, none, none};
    }

    template <bool border>
    HWY_INLINE OwnSprings<Real> springs(std::ptrdiff_t i, const ConstAxes<Real>& axes) const {
        const Tag<Real> d;
        const Lane3<Real> x = load3(axes, i);
        const Lane3<Real> none = zero3<Real>();
        OwnSprings<Real> own{none, none, none, none, none, none, none};
        own.sum = set3(a_.gravity[0], a_.gravity[1], a_.gravity[2]);
        LaneMask<Real> inside = lanes_before<Real>(step), below_first = inside, below_second = inside;
        if constexpr (border) {
            inside = lanes_before<Real>(points_ - i);
            below_first = hn::And(inside, lanes_from<Real>(columns_ - i));
            below_second = hn::And(inside, lanes_from<Real>(2 * columns_ - i));
        }
        const auto spring = [&](std::size_t s, std::ptrdiff_t other, Real k, Lane3<Real>& out) HWY_ATTR {
            const Lane3<Real> v = subtract3(load3(axes, i + other), x);
            const auto length = hn::Sqrt(dot3(v, v));
            const auto rest = hn::LoadU(d, a_.rest.of[s] + (static_cast<std::size_t>(i) & a_.rest.mask));
            const auto pull = hn::Div(hn::Mul(hn::Set(d, k), hn::Sub(length, rest)), length);
            out = scale3(hn::IfThenElseZero(hn::Gt(length, hn::Zero(d)), pull), v);
        };
        const auto masked = [&](LaneMask<Real> column, LaneMask<Real> row, Lane3<Real>& out)
                                HWY_ATTR { out = keep3<Real>(border ? hn::And(column, row) : column, out); };
        if constexpr (structural) {
            spring(0, -columns_, a_.k, own.up);
            if constexpr (border)
                own.up = keep3<Real>(below_first, own.up);
            own.sum = add3(own.sum, own.up);
            spring(1, -1, a_.k, own.left);
            masked(column_.has_left(), inside, own.left);
            own.sum = add3(own.sum, own.left);
        }
        if constexpr (shear) {
            spring(2, -columns_ - 1, a_.k, own.upper_left);
            masked(column_.has_left(), below_first, own.upper_left);
            own.sum = add3(own.sum, own.upper_left);
            spring(3, -columns_ + 1, a_.k, own.upper_right);
            masked(column_.has_right(), below_first, own.upper_right);
            own.sum = add3(own.sum, own.upper_right);
        }
        if constexpr (bending) {
            spring(4, -2, a_.bending_k, own.two_left);
            masked(column_.has_two_left(), inside, own.two_left);
            own.sum = add3(own.sum, own.two_left);
            spring(5, -2 * columns_, a_.bending_k, own.two_up);
            if constexpr (border)
                own.two_up = keep3<Real>(below_second, own.two_up);
            own.sum = add3(own.sum, own.two_up);
        }
        return own;
    }

    /// Adds what the springs of the points i, i + 1, ... and of the vector behind them pull at earlier points; those
    /// two rows above are complete then.
    HWY_INLINE void finish(std::ptrdiff_t i, const OwnSprings<Real>& own, const OwnSprings<Real>& next,
                           const Lane3<Real>& upper_right_before) {
        window_.require(i - 2 * columns_, i + step);
        Lane3<Real> f = own.sum;
        if constexpr (structural)
            f = subtract3(f, shifted3<1>(next.left, own.left));
        if constexpr (bending)
            f = subtract3(f, shifted3<2>(next.two_left, own.two_left));
        window_.store(f, i);

        if constexpr (structural || shear) {
            f = window_.load(i - columns_);
            if constexpr (shear)
                f = subtract3(f, shifted3<static_cast<int>(step) - 1>(own.upper_right, upper_right_before));
            if constexpr (structural)
                f = subtract3(f, own.up);
            if constexpr (shear)
                f = subtract3(f, shifted3<1>(next.upper_left, own.upper_left));
            window_.store(f, i - columns_);
        }

        const std::ptrdiff_t done = i - 2 * columns_;
        if (done + step <= begin_ || done >= end_)
            return;
        f = window_.load(done);
        if constexpr (bending)
            f = subtract3(f, own.two_up);
        if (HWY_LIKELY(done >= begin_ && done + step <= end_))
            store3(swept<sink, Real>(a_, f, a_.x, {a_.out[0], a_.out[1], a_.out[2]}, done), a_.out, done);
        else
            sweep_some<sink, Real>(arguments_, f, done);
    }

    const SweepArguments<Real>& arguments_;
    const SweepArguments<Real> a_;
    const std::ptrdiff_t columns_, points_, begin_, end_;
    Columns<Real> column_;
    ForceWindow<Real> window_;
    ConstAxes<Real> head_{};
};

template <unsigned kinds, SweepSink sink, class Real>
void sweep(const SweepArguments<Real>& arguments) {
    SpringSweep<kinds, sink, Real>(arguments).run();
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
