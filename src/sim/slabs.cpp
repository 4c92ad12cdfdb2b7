#include "sim/slabs.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "sim/forces/springs.h"
#include "sim/spin.h"
#include "sim/stage_timer.h"
#include "sim/workspace.h"

namespace clothlab::sim {
namespace {

constexpr std::size_t most_points = std::size_t{1} << 19;

/// Values before and behind an axis of a slab: vectors begin and end there that reach beyond its points.
constexpr std::size_t margin = 64;
constexpr std::size_t whole_lines(std::size_t values) {
    return (values + 15) / 16 * 16;
}

/// The length of an axis of at least so many values: the six axes begin at places spread over a page, since a processor
/// takes a load for one of what is being stored at the same place of another page.
template <class Real>
constexpr std::size_t axis_length(std::size_t values) {
    constexpr std::size_t page = 4096 / sizeof(Real), apart = page / 6 / 16 * 16;
    return (values + page - 1 - apart) / page * page + apart;
}

/// Points that springs reach from a range of them, on either side.
template <class Real>
std::size_t halo_of(const Model<Real>& model) {
    return 2 * static_cast<std::size_t>(model.grid->columns);
}

/// As many ranges as there are threads, or as many as have no neighbours but the ranges beside them.
template <class Real>
Shares slab_shares(const Model<Real>& model, const Workspace<Real>& work) {
    Shares all = shares(model, work);
    const auto too_short = [&] {
        for (std::size_t i = 0; i < all.count; ++i)
            if (all.from(i + 1) < all.from(i) + sweep_least(static_cast<std::size_t>(model.grid->columns)))
                return true;
        return false;
    };
    while (all.count > 1 && too_short())
        --all.count;
    return all;
}

/// Waits until a thread beside this one has sent so many messages. Returns whether it had not yet.
bool await(const std::atomic<std::uint64_t>& sent, std::uint64_t number) {
    bool waited = false;
    for (Spin spin; sent.load(std::memory_order_acquire) < number; spin.again())
        waited = true;
    return waited;
}

/// What the threads have in common.
template <class Real>
struct SlabWork {
    const Model<Real>* model;
    State<Real>* state;
    Workspace<Real>* work;
    SweepKernel<Real> kernel;
    Shares shares;
    int steps;
};

/// What one thread does.
template <class Real>
class SlabThread {
public:
    SlabThread(SlabWork<Real>& all, std::size_t index)
        : all_(all), index_(index), begin_(all.shares.from(index)), end_(all.shares.from(index + 1)),
          halo_(halo_of(*all.model)), slabs_(all.work->slabs), slab_(slabs_.of[index]) {
        // Points have the numbers that they have in the whole cloth.
        const std::size_t axis = slab_.points.size() / 6, first = has_before() ? begin_ - halo_ : 0;
        for (std::size_t a = 0; a < 3; ++a) {
            now_[a] = slab_.points.data() + a * axis + margin - first;
            before_[a] = now_[a] + 3 * axis;
        }
        const std::vector<std::uint32_t>& pins = all.model->pins;
        pins_begin_ = std::lower_bound(pins.begin(), pins.end(), begin_);
        pins_end_ = std::lower_bound(pins_begin_, pins.end(), end_);
    }

    void run() {
        State<Real>& state = *all_.state;
        const std::size_t first = has_before() ? begin_ - halo_ : begin_, last = has_behind() ? end_ + halo_ : end_;
        for (std::size_t a = 0; a < 3; ++a) {
            std::copy_n(state.position.axes()[a] + first, last - first, now_[a] + first);
            std::copy_n(state.previous.axes()[a] + begin_, end_ - begin_, before_[a] + begin_);
        }
        slabs_.clocks[index_].waited = 0;
        for (int step = 0; step < all_.steps; ++step) {
            message_ = slabs_.sent + static_cast<std::uint64_t>(step);
            if (step > 0)
                send();
            if (step > 0 && has_before())
                receive_from_before();
            move(step > 0 && has_behind());
        }
        // The others have long copied what they need: a thread takes its last step after those beside it took one.
        for (std::size_t a = 0; a < 3; ++a) {
            std::copy_n(now_[a] + begin_, end_ - begin_, state.position.axes()[a] + begin_);
            std::copy_n(before_[a] + begin_, end_ - begin_, state.previous.axes()[a] + begin_);
        }
    }

private:
    bool has_before() const { return index_ > 0; }
    bool has_behind() const { return index_ + 1 < all_.shares.count; }

    /// One step of the points in the range. Those behind it are asked for when it comes to them.
    void move(bool receive) {
        SweepArguments<Real> arguments = all_.kernel.arguments;
        for (std::size_t a = 0; a < 3; ++a) {
            arguments.x[a] = now_[a];
            arguments.out[a] = before_[a];
        }
        arguments.begin = begin_;
        arguments.end = end_;
        arguments.scratch = all_.work->sweep[index_].data();
        if (receive) {
            arguments.before_end = [](void* thread) { static_cast<SlabThread*>(thread)->receive_from_behind(); };
            arguments.context = this;
        }
        all_.kernel.sweep(arguments);
        std::swap(now_, before_);
        for (auto pin = pins_begin_; pin != pins_end_; ++pin)
            for (std::size_t a = 0; a < 3; ++a) {
                now_[a][*pin] = all_.state->position.axes()[a][*pin];
                before_[a][*pin] = all_.state->previous.axes()[a][*pin];
            }
    }

    /// Where a thread's message to a side lies.
    enum Side : std::size_t { to_before, to_behind };
    Real* message(std::size_t thread, Side side, std::size_t axis) const {
        return slabs_.of[thread].messages.data() + (6 * side + 3 * (message_ % 2) + axis) * whole_lines(halo_);
    }

    void send() {
        for (std::size_t a = 0; a < 3; ++a) {
            if (has_before())
                std::copy_n(now_[a] + begin_, halo_, message(index_, to_before, a));
            if (has_behind())
                std::copy_n(now_[a] + end_ - halo_, halo_, message(index_, to_behind, a));
        }
        slabs_.clocks[index_].sent.store(message_, std::memory_order_release);
    }
    void receive_from_before() { receive(index_ - 1, to_behind, begin_ - halo_, true); }
    void receive_from_behind() { receive(index_ + 1, to_before, end_, index_ == 0); }
    void receive(std::size_t from, Side side, std::size_t first, bool counts) {
        const bool waited = await(slabs_.clocks[from].sent, message_);
        slabs_.clocks[index_].waited += waited && counts ? 1 : 0;
        for (std::size_t a = 0; a < 3; ++a)
            std::copy_n(message(from, side, a), halo_, now_[a] + first);
    }

    SlabWork<Real>& all_;
    std::size_t index_, begin_, end_, halo_;
    Slabs<Real>& slabs_;
    Slab<Real>& slab_;
    std::uint64_t message_ = 0;   ///< number of the last one sent and of those that are received now
    Axes<Real> now_{}, before_{}; ///< positions now and one step earlier
    std::vector<std::uint32_t>::const_iterator pins_begin_, pins_end_;
};

} // namespace

template <class Real>
std::size_t Slabs<Real>::bytes() const {
    std::size_t bytes = of.capacity() * sizeof(of[0]) + clocks.capacity() * sizeof(clocks[0]);
    for (const Slab<Real>& slab : of)
        bytes += (slab.points.capacity() + slab.messages.capacity()) * sizeof(Real);
    return bytes;
}

template <class Real>
void make_slabs(const Model<Real>& model, Workspace<Real>& work) {
    const std::size_t points = model.grid->points();
    const bool only_springs = model.integrator == IntegratorId::course_verlet && model.wind.kind == WindKind::none &&
                              model.rules.self_collision == SelfCollisionRule::none && model.colliders.empty() &&
                              model.rules.limit == LimitRule::off && can_sweep(model, work);
    Slabs<Real>& slabs = work.slabs;
    if (!only_springs || !work.pool || points > most_points) {
        slabs = {};
        return;
    }
    const auto threads = static_cast<std::size_t>(work.pool->threads());
    if (slabs.of.size() == threads) // with the model before; its threads have them in their caches
        return;
    slabs.of.resize(threads);
    slabs.clocks = std::vector<SlabClock>(threads);
    for (std::size_t i = 0; i < threads; ++i) {
        const std::size_t most = Pace::most(i, std::max<std::size_t>(i + 1, 2), points) + sweep_grain;
        slabs.of[i].points.resize(6 * axis_length<Real>(2 * margin + 2 * halo_of(model) + most));
        slabs.of[i].messages.resize(12 * whole_lines(halo_of(model)));
    }
}

template <class Real>
bool can_step_in_slabs(const Model<Real>& model, const Workspace<Real>& work) {
    return !work.slabs.of.empty() && slab_shares(model, work).count > 1;
}

template <class Real>
void step_in_slabs(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, int steps) {
    work.choice.begin_step();
    {
        const StageTimer timer(work, Stage::forces);
        SlabWork<Real> all{
            &model, &state, &work, sweep_kernel(model, work, verlet_sink(model)), slab_shares(model, work), steps};
        work.pool->run(static_cast<int>(all.shares.count),
                       [&all](int index) { SlabThread<Real>(all, static_cast<std::size_t>(index)).run(); });
        // Where both mostly wait, it is for the messages' way.
        const int first = work.slabs.clocks[0].waited, second = work.slabs.clocks[1].waited;
        if (std::abs(first - second) > steps / 4)
            work.pace.learn(first > second);
        work.slabs.sent += static_cast<std::uint64_t>(steps);
    }
    work.choice.end_step(steps);
    for (int i = 0; i < steps; ++i)
        state.time += model.dt;
    state.steps += static_cast<std::uint64_t>(steps);
}

#define CLOTHLAB_DEFINE(Real)                                                                                          \
    template struct Slabs<Real>;                                                                                       \
    template void make_slabs<Real>(const Model<Real>&, Workspace<Real>&);                                              \
    template bool can_step_in_slabs<Real>(const Model<Real>&, const Workspace<Real>&);                                 \
    template void step_in_slabs<Real>(const Model<Real>&, State<Real>&, Workspace<Real>&, int);
CLOTHLAB_DEFINE(float)
CLOTHLAB_DEFINE(double)
#undef CLOTHLAB_DEFINE

} // namespace clothlab::sim
