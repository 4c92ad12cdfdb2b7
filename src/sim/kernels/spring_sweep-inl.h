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

/// A window of unfinished forces along the flat array, which moves with the sweep.
template <class Real>
class ForceWindow {
public:
    ForceWindow(Real* memory, std::ptrdiff_t columns, std::ptrdiff_t begin)
        : at_(memory), length_(sweep_window(static_cast<std::size_t>(columns))),
          base_(begin - 2 * columns - static_cast<std::ptrdiff_t>(sweep_grain)) {}
    HWY_INLINE Lane3<Real> load(std::ptrdiff_t i) const { return load3(axes(), i - base_); }
    HWY_INLINE void store(const Lane3<Real>& v, std::ptrdiff_t i) const { store3(v, axes(), i - base_); }
    /// How far there is room.
    std::ptrdiff_t end() const { return base_ + length_; }
    /// Makes room behind; what is before `from` is no longer needed.
    void move(std::ptrdiff_t from) {
        for (Real* axis : axes())
            std::memmove(axis, axis + (from - base_), static_cast<std::size_t>(end() - from) * sizeof(Real));
        base_ = from;
    }

private:
    HWY_INLINE Axes<Real> axes() const { return {at_, at_ + length_, at_ + 2 * length_}; }
    Real* at_;
    std::ptrdiff_t length_, base_;
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
/// nobody.
template <SweepSink sink, class Real>
HWY_NOINLINE void sweep_some(const SweepArguments<Real>& a, Lane3<Real> f, std::ptrdiff_t i) {
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

/// The forces of one stencil entry's springs on their own points, from x to those `other` further along the array.
template <class Real>
HWY_INLINE Lane3<Real> spring_forces(const ConstAxes<Real>& axes, const Lane3<Real>& x, std::ptrdiff_t other,
                                     Lane<Real> rest, Real k) {
    const Tag<Real> d;
    const Lane3<Real> v = subtract3(load3(axes, other), x);
    const auto length = hn::Sqrt(dot3(v, v));
    const auto pull = hn::Div(hn::Mul(hn::Set(d, k), hn::Sub(length, rest)), length);
    return scale3<Real>(hn::IfThenElseZero(hn::Gt(length, hn::Zero(d)), pull), v);
}

/// What one vector of points hands to the next: the forces of its own springs, their sum with gravity, and those of its
/// springs to the upper right, moved by a lane to where they end, one row up.
template <class Real>
struct Handed {
    Lane3<Real> up = zero3<Real>(), left = zero3<Real>(), upper_left = zero3<Real>(), upper_right = zero3<Real>(),
                lower_left = zero3<Real>(), two_left = zero3<Real>(), two_up = zero3<Real>(), sum = zero3<Real>();
};

enum class Place { inside, border, behind };

template <unsigned kinds, SweepSink sink, class Real>
struct SpringSweep {
    static constexpr bool structural = (kinds & 1u) != 0, shear = (kinds & 2u) != 0, bending = (kinds & 4u) != 0;
    static constexpr std::ptrdiff_t step = lanes<Real>;

    const SweepArguments<Real> a;
    Columns<Real> column;
    ForceWindow<Real> window;
    Handed<Real> before;

    static void run(const SweepArguments<Real>& a) {
        const auto columns = static_cast<std::ptrdiff_t>(a.columns), points = static_cast<std::ptrdiff_t>(a.points);
        const auto begin = static_cast<std::ptrdiff_t>(a.begin), end = static_cast<std::ptrdiff_t>(a.end);
        SpringSweep sweep{a, Columns<Real>(a.columns, a.begin), ForceWindow<Real>(a.scratch, columns, begin), {}};
        const ConstAxes<Real> head = begin == 0 ? copy_head(a) : a.x;
        const std::ptrdiff_t springs_end = std::min(points, end + 2 * columns);
        const std::ptrdiff_t stop = end + 2 * columns + step; // complete after two rows more, and one vector more
        for (std::ptrdiff_t i = begin; i < stop;) {
            if (sweep.window.end() < i)
                sweep.window.move(i - 2 * columns - step);
            const std::ptrdiff_t vectors = (std::min(springs_end, sweep.window.end()) - i) / step;
            if (i >= 2 * columns && vectors > 0) {
                sweep.go_on_inside(i, i + vectors * step);
                i += vectors * step;
            } else {
                if (i < springs_end)
                    sweep.template go_on<Place::border>(i, i < 2 * columns ? head : a.x);
                else
                    sweep.template go_on<Place::behind>(i, a.x);
                i += step;
            }
        }
    }

    /// The first two rows have neighbours before the array's start, which are masked but read: they are computed on a
    /// copy with memory before it.
    static ConstAxes<Real> copy_head(const SweepArguments<Real>& a) {
        const std::ptrdiff_t room = sweep_head(a.columns);
        Real* memory = a.scratch + 3 * sweep_window(a.columns) + 2 * a.columns;
        ConstAxes<Real> head{};
        for (std::size_t axis = 0; axis < 3; ++axis, memory += room) {
            head[axis] = memory;
            std::memcpy(memory, a.x[axis], std::min(2 * a.columns + HWY_LANES(Real), a.points) * sizeof(Real));
        }
        return head;
    }

    /// On copies of all that changes, so that it is kept in registers.
    HWY_NOINLINE void go_on_inside(std::ptrdiff_t i, std::ptrdiff_t end) {
        Handed<Real> handed = before;
        Columns<Real> at = column;
        const ForceWindow<Real> forces = window;
        for (; i < end; i += step) {
            advance<Place::inside>(a, forces, at, i, a.x, handed);
            at.advance();
        }
        before = handed;
        column = at;
    }
    template <Place place>
    HWY_NOINLINE void go_on(std::ptrdiff_t i, const ConstAxes<Real>& axes) {
        advance<place>(a, window, column, i, axes, before);
        column.advance();
    }

    /// The forces of stencil entry s, masked where the spring does not exist.
    template <Place place, std::size_t s>
    static HWY_INLINE Lane3<Real> spring(const SweepArguments<Real>& a, const ConstAxes<Real>& axes,
                                         const Lane3<Real>& x, std::ptrdiff_t i, LaneMask<Real> exists) {
        if constexpr (place == Place::behind) {
            return zero3<Real>();
        } else {
            constexpr SpringStencil stencil = spring_stencil[s];
            const Real k = stencil.kind == SpringKind::bending ? a.bending_k : a.k;
            const auto rest = hn::LoadU(Tag<Real>(), a.rest.of[s] + (static_cast<std::size_t>(i) & a.rest.mask));
            const std::ptrdiff_t other = i + stencil.rows * static_cast<std::ptrdiff_t>(a.columns) + stencil.columns;
            const Lane3<Real> force = spring_forces(axes, x, other, rest, k);
            return place == Place::inside && stencil.columns == 0 ? force : keep3<Real>(exists, force);
        }
    }

    /// The own springs of the points i, i + 1, ...; then what those to the right pull at the vector before, what these
    /// pull at the points a row above it, and what at the points two rows above it, on which the force is complete
    /// then.
    template <Place place>
    static HWY_INLINE void advance(const SweepArguments<Real>& a, const ForceWindow<Real>& window,
                                   const Columns<Real>& column, std::ptrdiff_t i, const ConstAxes<Real>& axes,
                                   Handed<Real>& before) {
        const auto columns = static_cast<std::ptrdiff_t>(a.columns);
        LaneMask<Real> has_left = column.has_left(), has_right = column.has_right(),
                       has_two_left = column.has_two_left(), below_first = has_left, below_second = has_left;
        LaneMask<Real> has_upper_left = has_left;
        if constexpr (place == Place::border) {
            const auto exists = lanes_before<Real>(static_cast<std::ptrdiff_t>(a.points) - i);
            below_first = hn::And(exists, lanes_from<Real>(columns - i));
            below_second = hn::And(exists, lanes_from<Real>(2 * columns - i));
            has_upper_left = hn::And(below_first, has_left);
            has_right = hn::And(below_first, has_right);
            has_left = hn::And(exists, has_left);
            has_two_left = hn::And(exists, has_two_left);
        }
        const Lane3<Real> none = zero3<Real>();
        const Lane3<Real> x = place == Place::behind ? none : load3(axes, i);
        const Lane3<Real> up = structural ? spring<place, 0>(a, axes, x, i, below_first) : none;
        const Lane3<Real> left = structural ? spring<place, 1>(a, axes, x, i, has_left) : none;
        const Lane3<Real> upper_left = shear ? spring<place, 2>(a, axes, x, i, has_upper_left) : none;
        const Lane3<Real> upper_right = shear ? spring<place, 3>(a, axes, x, i, has_right) : none;
        const Lane3<Real> two_left = bending ? spring<place, 4>(a, axes, x, i, has_two_left) : none;
        const Lane3<Real> two_up = bending ? spring<place, 5>(a, axes, x, i, below_second) : none;
        Lane3<Real> sum = set3(a.gravity[0], a.gravity[1], a.gravity[2]);
        if constexpr (structural)
            sum = add3(add3(sum, up), left);
        if constexpr (shear)
            sum = add3(add3(sum, upper_left), upper_right);
        if constexpr (bending)
            sum = add3(add3(sum, two_left), two_up);

        Lane3<Real> f = before.sum;
        if constexpr (structural)
            f = subtract3(f, shifted3<1>(left, before.left));
        if constexpr (bending)
            f = subtract3(f, shifted3<2>(two_left, before.two_left));
        const std::ptrdiff_t own = i - step, above = own - columns, two_above = above - columns;
        window.store(f, own);
        if constexpr (structural || shear) {
            f = window.load(above);
            if constexpr (shear)
                f = subtract3(f, before.lower_left);
            if constexpr (structural)
                f = subtract3(f, before.up);
            if constexpr (shear)
                f = subtract3(f, shifted3<1>(upper_left, before.upper_left));
            window.store(f, above);
        }
        f = window.load(two_above);
        if constexpr (bending)
            f = subtract3(f, before.two_up);
        before.lower_left = shifted3<static_cast<int>(step) - 1>(upper_right, before.upper_right);
        before.up = up;
        before.left = left;
        before.upper_left = upper_left;
        before.upper_right = upper_right;
        before.two_left = two_left;
        before.two_up = two_up;
        before.sum = sum;

        const auto begin = static_cast<std::ptrdiff_t>(a.begin), end = static_cast<std::ptrdiff_t>(a.end);
        if (HWY_LIKELY(two_above >= begin && two_above + step <= end))
            store3(swept<sink, Real>(a, f, a.x, {a.out[0], a.out[1], a.out[2]}, two_above), a.out, two_above);
        else if (two_above + step > begin && two_above < end)
            sweep_some<sink, Real>(a, f, two_above);
    }
};

template <unsigned kinds, SweepSink sink, class Real>
void sweep(const SweepArguments<Real>& arguments) {
    SpringSweep<kinds, sink, Real>::run(arguments);
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
