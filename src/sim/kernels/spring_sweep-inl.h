// Forces of all springs and the Verlet step in one pass over the points, each spring computed once.
//
// The edge list's order, as seen from one point: its own springs (up, left, upper left, upper right, two to the left,
// two above), then, with the opposite sign, the springs of later points that end at it (of the right neighbour, of the
// second to the right, then of the row below: lower left, below, lower right, and of the second row below). So the
// force on a point is complete two rows after its own springs, and a window of two rows of unfinished forces is all
// that has to be kept: it lies in the first-level cache up to some hundred columns.
//
// A vector's own springs wait for square roots and divisions, which take long and depend on nothing but positions; what
// is done with forces of vectors some places before waits for nothing. So the two take turns, spring by spring. The
// forces between lie in a block of memory, where a neighbour along the row is a load one lane further.
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

/// A window of unfinished forces along the flat array, which moves with the sweep.
template <class Real>
class ForceWindow {
public:
    ForceWindow(Real* memory, std::ptrdiff_t columns, std::ptrdiff_t begin)
        : at_(memory), length_(sweep_window(static_cast<std::size_t>(columns))),
          base_(begin - 2 * columns - static_cast<std::ptrdiff_t>(sweep_grain)) {}
    template <std::size_t axis>
    HWY_INLINE Lane<Real> load(std::ptrdiff_t i) const {
        return hn::LoadU(Tag<Real>(), axes()[axis] + (i - base_));
    }
    template <std::size_t axis>
    HWY_INLINE void store(Lane<Real> v, std::ptrdiff_t i) const {
        hn::StoreU(v, Tag<Real>(), axes()[axis] + (i - base_));
    }
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

/// What becomes of the complete forces f along one axis on points at x that were at p.
template <SweepSink sink, class Real>
HWY_INLINE Lane<Real> swept(const SweepArguments<Real>& a, Lane<Real> f, const Real* x, const Real* p) {
    if constexpr (sink == SweepSink::force) {
        return f;
    } else {
        const Tag<Real> d;
        const auto now = hn::LoadU(d, x);
        auto moved = hn::Sub(now, hn::LoadU(d, p));
        if constexpr (sink == SweepSink::verlet_damped)
            moved = hn::Mul(hn::Set(d, a.keep), moved);
        return hn::Add(hn::Add(now, moved), hn::Mul(hn::Set(d, a.c), f));
    }
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
    hn::Store(swept<sink, Real>(a, f, x, p), Tag<Real>(), p);
    for (std::ptrdiff_t l = from; l < to; ++l)
        a.out[axis][i + l] = p[l];
}

/// Forces of the own springs of a block of points and of some vectors before it, by stencil entry.
template <class Real>
class BlockForces {
public:
    /// Forces are looked at so many points after they were stored: by then, what is loaded across two stores has
    /// reached the cache.
    static constexpr std::ptrdiff_t lag = 2 * lanes<Real>, points = 4 * static_cast<std::ptrdiff_t>(sweep_grain);

    /// Before the first block there is nothing; what is in it has been stored when it is looked at.
    BlockForces() {
        for (auto& entry : of_)
            for (auto& axis : entry)
                std::fill_n(axis, before, Real(0));
    }
    /// From point j of the block on, or before it.
    template <std::size_t s, std::size_t axis>
    HWY_INLINE Lane<Real> load(std::ptrdiff_t j) const {
        return hn::LoadU(Tag<Real>(), of_[s][axis] + before + j);
    }
    template <std::size_t s>
    HWY_INLINE void store(const Lane3<Real>& v, std::ptrdiff_t j) {
        store3(v, Axes<Real>{of_[s][0] + before, of_[s][1] + before, of_[s][2] + before}, j);
    }
    /// The next block begins.
    void go_on() {
        const Tag<Real> d;
        for (auto& entry : of_)
            for (auto& axis : entry)
                for (std::ptrdiff_t l = 0; l < before; l += lanes<Real>)
                    hn::Store(hn::Load(d, axis + points + l), d, axis + l);
    }

private:
    static constexpr std::ptrdiff_t before = lag + lanes<Real>; ///< a lane before the lag is looked at, too
    HWY_ALIGN Real of_[stencil_size][3][static_cast<std::size_t>(before + points)];
};

enum class Place { inside, border, behind };

template <unsigned kinds, SweepSink sink, class Real>
struct SpringSweep {
    static constexpr bool structural = (kinds & 1u) != 0, shear = (kinds & 2u) != 0, bending = (kinds & 4u) != 0;
    static constexpr std::ptrdiff_t step = lanes<Real>, lag = BlockForces<Real>::lag;
    template <std::size_t s>
    static constexpr bool pulls = (kinds >> static_cast<unsigned>(spring_stencil[s].kind) & 1u) != 0;
    using Block = BlockForces<Real>;

    const SweepArguments<Real> a;
    Columns<Real> column;
    ForceWindow<Real> window;
    Block block;

    static void run(const SweepArguments<Real>& a) {
        const auto columns = static_cast<std::ptrdiff_t>(a.columns), points = static_cast<std::ptrdiff_t>(a.points);
        const auto begin = static_cast<std::ptrdiff_t>(a.begin), end = static_cast<std::ptrdiff_t>(a.end);
        SpringSweep sweep{a, Columns<Real>(a.columns, a.begin), ForceWindow<Real>(a.scratch, columns, begin), {}};
        const ConstAxes<Real> head = begin == 0 ? copy_head(a) : a.x;
        const std::ptrdiff_t springs_end = std::min(points, end + 2 * columns);
        // Forces are complete after two rows more, and are looked at some vectors later.
        const std::ptrdiff_t late = 2 * columns + lag, stop = end + late;
        for (std::ptrdiff_t from = begin; from < stop; from += Block::points) {
            const std::ptrdiff_t to = std::min(from + Block::points, stop);
            if (sweep.window.end() < from + Block::points)
                sweep.window.move(from - late);
            for (std::ptrdiff_t i = from; i < to;) {
                const std::ptrdiff_t vectors = (std::min(springs_end, to) - i) / step;
                if (i >= begin + late && vectors > 0) {
                    sweep.go_on_inside(i, i - from, vectors);
                    i += vectors * step;
                } else {
                    if (i < springs_end)
                        sweep.template go_on<Place::border>(i, i - from, i < 2 * columns ? head : a.x);
                    else
                        sweep.template go_on<Place::behind>(i, i - from, a.x);
                    i += step;
                }
            }
            sweep.block.go_on();
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

    /// Vectors from point i on, the block's point j. On copies of what changes and of what is read, so that it is kept
    /// in registers.
    HWY_NOINLINE void go_on_inside(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t vectors) {
        Columns<Real> at = column;
        const ForceWindow<Real> forces = window;
        const SweepArguments<Real> arguments = a;
        for (const std::ptrdiff_t end = j + vectors * step; j < end; i += step, j += step) {
            advance<Place::inside>(arguments, forces, at, i, j, arguments.x, block);
            at.advance();
        }
        column = at;
    }
    template <Place place>
    HWY_NOINLINE void go_on(std::ptrdiff_t i, std::ptrdiff_t j, const ConstAxes<Real>& axes) {
        advance<place>(a, window, column, i, j, axes, block);
        column.advance();
    }

    /// What the springs of stencil entry s pull, over their length, and v, their vectors from the points at x.
    template <Place place, std::size_t s>
    static HWY_INLINE Lane<Real> pull(const SweepArguments<Real>& a, const ConstAxes<Real>& axes, const Lane3<Real>& x,
                                      std::ptrdiff_t i, Lane3<Real>& v) {
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
    /// Adds the forces of stencil entry s, masked where the spring does not exist.
    template <Place place, std::size_t s>
    static HWY_INLINE void add(Lane<Real> pull, const Lane3<Real>& v, LaneMask<Real> exists, std::ptrdiff_t j,
                               Block& block, Lane3<Real>& sum) {
        if constexpr (pulls<s>) {
            Lane3<Real> force = scale3<Real>(pull, v);
            if constexpr (place != Place::inside || spring_stencil[s].columns != 0)
                force = keep3<Real>(exists, force);
            block.template store<s>(force, j);
            sum = add3(sum, force);
        }
    }

    /// The own springs of the points i, i + 1, ..., the block's points j, j + 1, ..., in turns with what those
    /// `lag` points before do to others.
    template <Place place>
    static HWY_INLINE void advance(const SweepArguments<Real>& a, const ForceWindow<Real>& window,
                                   const Columns<Real>& column, std::ptrdiff_t i, std::ptrdiff_t j,
                                   const ConstAxes<Real>& axes, Block& block) {
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
        Lane3<Real> sum = set3(a.gravity[0], a.gravity[1], a.gravity[2]);
        Lane3<Real> v0, v1, v2, v3, v4, v5;
        const auto up = pull<place, 0>(a, axes, x, i, v0);
        const auto left = pull<place, 1>(a, axes, x, i, v1);
        add<place, 0>(up, v0, below_first, j, block, sum);
        pass_on<0>(window, i - lag, columns, j - lag, block);
        const auto upper_left = pull<place, 2>(a, axes, x, i, v2);
        add<place, 1>(left, v1, has_left, j, block, sum);
        finish<place, 0>(a, window, i - lag, j - lag, block);
        const auto upper_right = pull<place, 3>(a, axes, x, i, v3);
        add<place, 2>(upper_left, v2, has_upper_left, j, block, sum);
        pass_on<1>(window, i - lag, columns, j - lag, block);
        const auto two_left = pull<place, 4>(a, axes, x, i, v4);
        add<place, 3>(upper_right, v3, has_right, j, block, sum);
        finish<place, 1>(a, window, i - lag, j - lag, block);
        const auto two_up = pull<place, 5>(a, axes, x, i, v5);
        add<place, 4>(two_left, v4, has_two_left, j, block, sum);
        pass_on<2>(window, i - lag, columns, j - lag, block);
        add<place, 5>(two_up, v5, below_second, j, block, sum);
        finish<place, 2>(a, window, i - lag, j - lag, block);
        window.store(sum, i);
    }

    /// What the springs of later points in the row pull at the points i, i + 1, ..., and what these points and their
    /// neighbours pull at the points a row above.
    template <std::size_t axis>
    static HWY_INLINE void pass_on(const ForceWindow<Real>& window, std::ptrdiff_t i, std::ptrdiff_t columns,
                                   std::ptrdiff_t j, const Block& block) {
        auto f = window.template load<axis>(i);
        if constexpr (structural)
            f = hn::Sub(f, block.template load<1, axis>(j + 1));
        if constexpr (bending)
            f = hn::Sub(f, block.template load<4, axis>(j + 2));
        window.template store<axis>(f, i);
        if constexpr (structural || shear) {
            f = window.template load<axis>(i - columns);
            if constexpr (shear)
                f = hn::Sub(f, block.template load<3, axis>(j - 1));
            if constexpr (structural)
                f = hn::Sub(f, block.template load<0, axis>(j));
            if constexpr (shear)
                f = hn::Sub(f, block.template load<2, axis>(j + 1));
            window.template store<axis>(f, i - columns);
        }
    }
    /// What the points i, i + 1, ... pull at those two rows above, on which the force is complete then.
    template <Place place, std::size_t axis>
    static HWY_INLINE void finish(const SweepArguments<Real>& a, const ForceWindow<Real>& window, std::ptrdiff_t i,
                                  std::ptrdiff_t j, const Block& block) {
        const auto begin = static_cast<std::ptrdiff_t>(a.begin), end = static_cast<std::ptrdiff_t>(a.end);
        const std::ptrdiff_t to = i - 2 * static_cast<std::ptrdiff_t>(a.columns);
        auto f = window.template load<axis>(to);
        if constexpr (bending)
            f = hn::Sub(f, block.template load<5, axis>(j));
        if (place == Place::inside || (to >= begin && to + step <= end))
            hn::StoreU(swept<sink, Real>(a, f, a.x[axis] + to, a.out[axis] + to), Tag<Real>(), a.out[axis] + to);
        else if (to + step > begin && to < end)
            sweep_some<sink, axis, Real>(a, f, to);
    }
};

template <unsigned kinds, SweepSink sink, class Real>
void sweep(const SweepArguments<Real>& arguments) {
    SpringSweep<kinds, sink, Real>::run(arguments);
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
