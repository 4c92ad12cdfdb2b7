// Forces of all springs and the Verlet step in one pass over the points, each spring computed once.
//
// The edge list's order, as seen from one point: its own springs (up, left, upper left, upper right, two to the left,
// two above), then, with the opposite sign, the springs of later points that end at it (of the right neighbour, of the
// second to the right, then of the row below: upper right, up, upper left, and of the second row below). So the force
// on a point is complete two rows after its own springs. Until then a ring, which lies in the first-level cache up to
// some hundred columns, keeps what its own springs and those of the points to its right pull, and what each point's
// springs to the row above do; springs along the row meet in registers, shifted by one lane or two.
//
// A vector's own springs wait for square roots and divisions, which take long and depend on nothing but positions; to
// sum what was put into the ring rows ago and to move the points waits for nothing. So the two take turns.
//
// A deviation from the design: no row is padded and there is no halo. Vectors run across row ends, and the lanes
// whose neighbour does not exist are masked, which costs three comparisons and twelve masked values a vector; padding
// 50 columns to 64 would cost 28 %.
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

/// Where points at x that were at p get to along one axis without a force; nothing where the forces are what is wanted.
template <SweepSink sink, class Real>
HWY_INLINE Lane<Real> coasted(const SweepArguments<Real>& a, const Real* x, const Real* p) {
    const Tag<Real> d;
    if constexpr (sink == SweepSink::force) {
        return hn::Zero(d);
    } else {
        const auto now = hn::LoadU(d, x);
        auto moved = hn::Sub(now, hn::LoadU(d, p));
        if constexpr (sink == SweepSink::verlet_damped)
            moved = hn::Mul(hn::Set(d, a.keep), moved);
        auto sum = hn::Add(now, moved);
        compute_here<Real>(sum);
        return sum;
    }
}

/// What becomes of the complete forces f on points that get there without them.
template <SweepSink sink, class Real>
HWY_INLINE Lane<Real> swept(const SweepArguments<Real>& a, Lane<Real> there, Lane<Real> f) {
    if constexpr (sink == SweepSink::force)
        return f;
    else
        return hn::Add(there, hn::Mul(hn::Set(Tag<Real>(), a.c), f));
}

/// The same for a vector of which only some lanes are in the sweep's range: the others belong to another thread, or to
/// nobody.
template <SweepSink sink, std::size_t axis, class Real>
HWY_INLINE void sweep_some(const SweepArguments<Real>& a, Lane<Real> f, std::ptrdiff_t i) {
    HWY_ALIGN Real x[HWY_LANES(Real)] = {}, p[HWY_LANES(Real)] = {};
    const std::ptrdiff_t from = std::max(static_cast<std::ptrdiff_t>(a.begin) - i, std::ptrdiff_t{0});
    const std::ptrdiff_t to = std::min(static_cast<std::ptrdiff_t>(a.end) - i, lanes<Real>);
    for (std::ptrdiff_t l = from; l < to; ++l) {
        x[l] = a.x[axis][i + l];
        p[l] = a.out[axis][i + l];
    }
    hn::Store(swept<sink, Real>(a, coasted<sink, Real>(a, x, p), f), Tag<Real>(), p);
    for (std::ptrdiff_t l = from; l < to; ++l)
        a.out[axis][i + l] = p[l];
}

/// What is known of forces on points that are not complete yet, by point. A point's slot is its distance from the first
/// point modulo the ring's length; the ring's first vector is repeated behind it and its last one before it, so that a
/// vector may begin at any slot, or one before. `fixed` is the distance from one array to the next if it is known when
/// this is compiled, and 0 if not.
template <class Real, std::ptrdiff_t fixed>
class ForceRing {
public:
    /// What the springs of a point and those to its right pull at it; what its springs upwards pull at it.
    enum Entry : std::ptrdiff_t { sum, up, upper_left, upper_right, entries };

    ForceRing(Real* memory, std::size_t columns)
        : first_(memory + sweep_ring_margin), length_(sweep_ring_length(columns)), stride_(sweep_ring_stride(columns)) {
    }
    std::ptrdiff_t length() const { return length_; }
    /// A vector that begins at `slot + beside`.
    template <Entry entry, std::size_t axis>
    HWY_INLINE Lane<Real> load(std::ptrdiff_t slot, std::ptrdiff_t beside = 0) const {
        return hn::LoadU(Tag<Real>(), at(entry, axis) + slot + beside);
    }
    template <Entry entry>
    HWY_INLINE void store(const Lane3<Real>& v, std::ptrdiff_t slot) const {
        const Tag<Real> d;
        hn::Store(v.x, d, at(entry, 0) + slot);
        hn::Store(v.y, d, at(entry, 1) + slot);
        hn::Store(v.z, d, at(entry, 2) + slot);
    }
    /// Brings up to date what is repeated. To be called when the first vector has been stored again.
    HWY_INLINE void repeat() const {
        const Tag<Real> d;
        for (Real *vector = first_, *end = first_ + 3 * entries * stride_; vector != end; vector += stride_) {
            hn::Store(hn::Load(d, vector), d, vector + length_);
            hn::Store(hn::Load(d, vector + length_ - lanes<Real>), d, vector - lanes<Real>);
        }
    }

private:
    HWY_INLINE Real* at(Entry entry, std::size_t axis) const {
        return first_ + (3 * entry + static_cast<std::ptrdiff_t>(axis)) * (fixed != 0 ? fixed : stride_);
    }
    Real* first_;
    std::ptrdiff_t length_, stride_;
};

enum class Place { inside, border, behind };

/// Slots of the vector at hand, of the one before it, of that which is completed and of that a row below it.
struct RingSlots {
    std::ptrdiff_t now, before, done, below;
};

/// `stride`: of the ring, if it is known when this is compiled, and 0 if not.
template <unsigned kinds, SweepSink sink, class Real, std::ptrdiff_t stride>
struct SpringSweep {
    using Ring = ForceRing<Real, stride>;
    static constexpr std::ptrdiff_t step = lanes<Real>;
    template <std::size_t s>
    static constexpr bool pulls = (kinds >> static_cast<unsigned>(spring_stencil[s].kind) & 1u) != 0;

    const SweepArguments<Real> a;
    const Ring ring;
    Columns<Real> column;
    /// Of the vector before: what its own springs pull at it, to the left, two to the left and two up among them.
    Lane3<Real> sum = zero3<Real>(), left = sum, two_left = sum, two_up = sum;

    explicit SpringSweep(const SweepArguments<Real>& arguments)
        : a(arguments), ring(a.scratch, a.columns), column(a.columns, a.begin) {}

    /// The forces on points so far back are completed: two rows, and a vector for what waits in registers.
    HWY_INLINE std::ptrdiff_t late() const { return 2 * static_cast<std::ptrdiff_t>(a.columns) + step; }

    static void run(const SweepArguments<Real>& a) {
        SpringSweep sweep(a);
        const auto columns = static_cast<std::ptrdiff_t>(a.columns), points = static_cast<std::ptrdiff_t>(a.points);
        const auto begin = static_cast<std::ptrdiff_t>(a.begin), end = static_cast<std::ptrdiff_t>(a.end);
        const std::ptrdiff_t springs_end = std::min(points, end + 2 * columns), late = sweep.late();
        std::ptrdiff_t i = begin;
        if (begin == 0)
            i = sweep.template go_on<Place::border>(i, std::min(2 * columns, springs_end), copy_head(a));
        i = sweep.template go_on<Place::border>(i, std::min(begin + late, springs_end), a.x);
        if (a.before_end) {
            i = sweep.template go_on<Place::inside>(i, end - step + 1, a.x);
            a.before_end(a.context);
        }
        i = sweep.template go_on<Place::inside>(i, springs_end - step + 1, a.x);
        i = sweep.template go_on<Place::border>(i, springs_end, a.x);
        sweep.template go_on<Place::behind>(i, end + late, a.x);
    }

    /// The first two rows have neighbours before the array's start, which are masked but read: they are computed on a
    /// copy with memory before it.
    static ConstAxes<Real> copy_head(const SweepArguments<Real>& a) {
        const std::ptrdiff_t room = sweep_head(a.columns);
        Real* memory = a.scratch + sweep_ring(a.columns) + 2 * a.columns;
        ConstAxes<Real> head{};
        for (std::size_t axis = 0; axis < 3; ++axis, memory += room) {
            head[axis] = memory;
            std::memcpy(memory, a.x[axis], std::min(2 * a.columns + HWY_LANES(Real), a.points) * sizeof(Real));
        }
        return head;
    }

    /// Vectors from point i on, which begin before `end`. Returns where the next begins. On a copy of the sweep, so
    /// that what changes and what is read is kept in registers.
    template <Place place>
    HWY_NOINLINE std::ptrdiff_t go_on(std::ptrdiff_t i, std::ptrdiff_t end, ConstAxes<Real> axes) {
        SpringSweep at = *this;
        const std::ptrdiff_t mask = ring.length() - 1;
        for (; i < end; i += step) {
            const std::ptrdiff_t done = i - late();
            const RingSlots slots{i & mask, (i - step) & mask, done & mask,
                                  (done + static_cast<std::ptrdiff_t>(a.columns)) & mask};
            at.template advance<place>(i, axes, slots);
        }
        column = at.column;
        sum = at.sum, left = at.left, two_left = at.two_left, two_up = at.two_up;
        return i;
    }

    /// What the springs of stencil entry s pull, over their length, and v, their vectors from the points at x.
    template <Place place, std::size_t s>
    HWY_INLINE Lane<Real> pull(const ConstAxes<Real>& axes, const Lane3<Real>& x, std::ptrdiff_t i,
                               Lane3<Real>& v) const {
        constexpr SpringStencil stencil = spring_stencil[s];
        const Tag<Real> d;
        if constexpr (place == Place::behind || !pulls<s>) {
            v = zero3<Real>();
            return hn::Zero(d);
        } else {
            const Real k = stencil.kind == SpringKind::bending ? a.bending_k : a.k;
            const auto rest = hn::LoadU(d, a.rest.of[s] + (static_cast<std::size_t>(i) & a.rest.mask));
            v = subtract3(load3(axes, i + stencil.rows * static_cast<std::ptrdiff_t>(a.columns) + stencil.columns), x);
            const auto length = hn::Sqrt(dot3(v, v));
            const auto pull = hn::Div(hn::Mul(hn::Set(d, k), hn::Sub(length, rest)), length);
            return hn::IfThenElseZero(hn::Gt(length, hn::Zero(d)), pull);
        }
    }
    /// The forces of stencil entry s, masked where the spring does not exist.
    template <Place place, std::size_t s>
    static HWY_INLINE Lane3<Real> force(Lane<Real> pull, const Lane3<Real>& v, LaneMask<Real> exists) {
        const Lane3<Real> f = scale3<Real>(pull, v);
        if constexpr (place == Place::inside && spring_stencil[s].columns == 0)
            return f;
        else
            return keep3<Real>(exists, f);
    }

    /// The own springs of the points i, i + 1, ..., in turns with the last sum of what is complete then. Those along
    /// the row come first: where rows are short, the sum of the vector before is among what is completed.
    template <Place place>
    HWY_INLINE void advance(std::ptrdiff_t i, const ConstAxes<Real>& axes, const RingSlots& slots) {
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
        const Lane3<Real> x = place == Place::behind ? zero3<Real>() : load3(axes, i);
        Lane3<Real> v0, v1, v2, v3, v4, v5;
        const auto pull_left = pull<place, 1>(axes, x, i, v1);
        const auto pull_two_left = pull<place, 4>(axes, x, i, v4);
        const Lane3<Real> to_left = force<place, 1>(pull_left, v1, has_left);
        if constexpr (pulls<1>)
            sum = subtract3(sum, shifted3<1, Real>(to_left, left));
        const auto pull_up = pull<place, 0>(axes, x, i, v0);
        const Lane3<Real> to_two_left = force<place, 4>(pull_two_left, v4, has_two_left);
        if constexpr (pulls<4>)
            sum = subtract3(sum, shifted3<2, Real>(to_two_left, two_left));
        ring.template store<Ring::sum>(sum, slots.before);
        if (slots.now == step)
            ring.repeat();
        complete<place, 0>(i - late(), slots, two_up.x);
        const auto pull_upper_left = pull<place, 2>(axes, x, i, v2);
        const Lane3<Real> up = force<place, 0>(pull_up, v0, below_first);
        Lane3<Real> own = set3(a.gravity[0], a.gravity[1], a.gravity[2]);
        if constexpr (pulls<0>) {
            ring.template store<Ring::up>(up, slots.now);
            own = add3(add3(own, up), to_left);
        }
        complete<place, 1>(i - late(), slots, two_up.y);
        const auto pull_upper_right = pull<place, 3>(axes, x, i, v3);
        const Lane3<Real> upper_left = force<place, 2>(pull_upper_left, v2, has_upper_left);
        if constexpr (pulls<2>) {
            ring.template store<Ring::upper_left>(upper_left, slots.now);
            own = add3(own, upper_left);
        }
        complete<place, 2>(i - late(), slots, two_up.z);
        const auto pull_two_up = pull<place, 5>(axes, x, i, v5);
        const Lane3<Real> upper_right = force<place, 3>(pull_upper_right, v3, has_right);
        if constexpr (pulls<3>) {
            ring.template store<Ring::upper_right>(upper_right, slots.now);
            own = add3(own, upper_right);
        }
        const Lane3<Real> to_two_up = force<place, 5>(pull_two_up, v5, below_second);
        if constexpr (pulls<4>)
            own = add3(add3(own, to_two_left), to_two_up);
        sum = own, left = to_left, two_left = to_two_left, two_up = to_two_up;
        column.advance();
    }

    /// Completes the forces along one axis on the points t, t + 1, ..., on which `below` pulls from the second row
    /// below.
    template <Place place, std::size_t axis>
    HWY_INLINE void complete(std::ptrdiff_t t, const RingSlots& slots, Lane<Real> below) const {
        const auto begin = static_cast<std::ptrdiff_t>(a.begin), end = static_cast<std::ptrdiff_t>(a.end);
        if (place != Place::inside && (t + step <= begin || t >= end))
            return;
        const bool whole = place == Place::inside || (t >= begin && t + step <= end);
        const auto there = whole ? coasted<sink, Real>(a, a.x[axis] + t, a.out[axis] + t) : hn::Zero(Tag<Real>());
        auto f = ring.template load<Ring::sum, axis>(slots.done);
        if constexpr (pulls<3>)
            f = hn::Sub(f, ring.template load<Ring::upper_right, axis>(slots.below, -1));
        if constexpr (pulls<0>)
            f = hn::Sub(f, ring.template load<Ring::up, axis>(slots.below));
        if constexpr (pulls<2>)
            f = hn::Sub(f, ring.template load<Ring::upper_left, axis>(slots.below, 1));
        if constexpr (pulls<5>)
            f = hn::Sub(f, below);
        if (whole)
            hn::StoreU(swept<sink, Real>(a, there, f), Tag<Real>(), a.out[axis] + t);
        else
            sweep_some<sink, axis, Real>(a, f, t);
    }
};

template <unsigned kinds, SweepSink sink, class Real>
void sweep(const SweepArguments<Real>& arguments) {
    // With all kinds of springs and some fifty columns, as most scenes have it, the loop need not look up where the
    // ring's arrays begin: 2 to 5 % less.
    if constexpr (kinds == 7) {
        if (sweep_ring_stride(arguments.columns) == sweep_ring_narrow)
            return SpringSweep<kinds, sink, Real, sweep_ring_narrow>::run(arguments);
    }
    SpringSweep<kinds, sink, Real, 0>::run(arguments);
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
