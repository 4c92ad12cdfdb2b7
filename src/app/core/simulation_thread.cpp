#include "app/core/simulation_thread.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>
#include <utility>

#include "sim/simulation.h"

namespace clothlab::app {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

double seconds(Clock::duration d) {
    return Seconds(d).count();
}

/// Threads for the steps: a run measures how many are worth it, with whatever else the window asks of the machine.
int most_threads() {
    return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 8u));
}

/// A slow frame shows its progress this often; a fast one is not shown more often than this.
constexpr double publish_interval = 1.0 / 120;
/// Lateness that playing does not try to make up for.
constexpr double forgiven = 0.1;
/// Over which the real-time factor is measured.
constexpr double factor_window = 0.5;
/// The stability margin is computed no more often than this, and in no more than this share of the time.
constexpr double margin_interval = 0.2, margin_share = 0.1;

} // namespace

/// What only the thread itself touches.
struct SimulationThread::Worker {
    std::unique_ptr<sim::Simulation> simulation;
    std::uint64_t run = 0;
    std::string error;
    bool playing = false;
    double speed = 1;
    /// Steps, or ends of frames, that were asked for.
    struct Wanted {
        bool frames;
        int count;
    };
    std::deque<Wanted> wanted; ///< in the order in which they were asked for
    bool in_frame = false;     ///< playing has begun a frame that it is to complete
    bool dirty = true;         ///< something changed since the last publication
    double real_time_factor = 0;
    bool pause_on_diverged = true, pause_on_jitter = false;

    sim::SnapshotExtras extras; ///< that snapshots have

    bool margin_wanted = false;
    std::optional<sim::StabilityMargin> margin; ///< the newest, of the run as it is described now
    std::uint64_t margin_steps = 0;             ///< of the state that it is of
    Clock::time_point margin_due;

    // Pace: where simulated and wall time were when playing, speed or run last changed.
    Clock::time_point pace_wall, factor_wall;
    double pace_time = 0, factor_time = 0;

    Clock::time_point published_at;
    sim::StageSeconds published_seconds{};
    std::uint64_t published_steps = 0;

    void start(const sim::Description& description) {
        try {
            auto next = sim::Simulation::create(description, {.threads = most_threads()});
            next->time_stages(true);
            next->watch(true);
            simulation = std::move(next);
            margin.reset();
            ++run;
            error.clear();
            published_seconds = {};
            published_steps = 0;
            wanted.clear();
            in_frame = false;
        } catch (const std::exception& e) {
            error = e.what();
        }
        restart_pace();
        dirty = true;
    }

    void change(const sim::Description& description) {
        if (!simulation || !can_change_live(simulation->description(), description))
            return start(description);
        try {
            simulation->change(description);
            margin.reset();
            error.clear();
        } catch (const std::exception& e) {
            error = e.what();
        }
        restart_pace();
        dirty = true;
    }

    void restart_pace() {
        pace_wall = factor_wall = Clock::now();
        pace_time = factor_time = simulation ? simulation->time() : 0;
        real_time_factor = 0;
    }

    /// When the next frame is due.
    Clock::time_point due() const {
        const double ahead = (simulation->time() - pace_time) / speed;
        return pace_wall + std::chrono::duration_cast<Clock::duration>(Seconds(std::min(ahead, 1e6)));
    }

    /// Takes one step if there is anything to do now; otherwise says until when there is not.
    bool work(std::optional<Clock::time_point>& wait_until) {
        if (!simulation) {
            wanted.clear(); // there is nothing to step
            return false;
        }
        if (!wanted.empty()) {
            const std::uint64_t frame = simulation->frame();
            take_step();
            if (wanted.empty()) // trouble has ended them all
                return true;
            Wanted& next = wanted.front();
            if (!next.frames || simulation->frame() != frame)
                --next.count;
            if (next.count == 0)
                wanted.pop_front();
            return true;
        }
        if (!playing)
            return false;
        if (!in_frame) {
            const Clock::time_point now = Clock::now(), when = due();
            if (now < when) {
                wait_until = when;
                return false;
            }
            if (seconds(now - when) > forgiven) {
                pace_wall = now;
                pace_time = simulation->time();
            }
        }
        const std::uint64_t frame = simulation->frame();
        take_step();
        in_frame = simulation->frame() == frame;
        measure_factor();
        return true;
    }

    void take_step() {
        const bool had_trouble = simulation->trouble().has_value();
        simulation->step();
        dirty = true;
        const std::optional<sim::Trouble>& trouble = simulation->trouble();
        if (!trouble)
            return;
        const bool diverged = trouble->status == sim::Status::diverged;
        if (diverged ? pause_on_diverged : pause_on_jitter && !had_trouble) {
            playing = in_frame = false;
            wanted.clear();
        }
    }

    /// The margin is of the state itself once that is at rest, and renewed now and then while it moves.
    void renew_margin() {
        const bool of_this_state = margin && margin_steps == simulation->steps();
        if (of_this_state || (margin && !idle() && Clock::now() < margin_due))
            return;
        const Clock::time_point begin = Clock::now();
        margin = simulation->stability();
        margin_steps = simulation->steps();
        const Clock::time_point end = Clock::now();
        const double pause = std::max(margin_interval, seconds(end - begin) / margin_share);
        margin_due = end + std::chrono::duration_cast<Clock::duration>(Seconds(pause));
    }

    void measure_factor() {
        const double wall = seconds(Clock::now() - factor_wall);
        if (wall < factor_window)
            return;
        real_time_factor = (simulation->time() - factor_time) / wall;
        factor_wall = Clock::now();
        factor_time = simulation->time();
    }

    bool has_steps_to_take() const { return !wanted.empty(); }
    bool idle() const { return !playing && !has_steps_to_take(); }

    Clock::time_point next_publication() const {
        return published_at + std::chrono::duration_cast<Clock::duration>(Seconds(publish_interval));
    }

    /// Whether the state as it is now is worth showing.
    bool worth_publishing() const { return dirty && (idle() || Clock::now() >= next_publication()); }

    std::shared_ptr<const sim::Snapshot> snapshot() {
        if (!simulation)
            return nullptr;
        auto s = std::make_shared<sim::Snapshot>();
        simulation->capture(*s, extras);
        if (margin_wanted) {
            renew_margin();
            s->stability = margin;
        }
        const auto steps = static_cast<double>(simulation->steps() - published_steps);
        for (std::size_t i = 0; i < s->seconds_per_step.size(); ++i)
            s->seconds_per_step[i] = steps > 0 ? (simulation->stage_seconds()[i] - published_seconds[i]) / steps : 0;
        published_seconds = simulation->stage_seconds();
        published_steps = simulation->steps();
        published_at = Clock::now();
        dirty = false;
        return s;
    }
};

SimulationThread::SimulationThread() : thread_([this] { run(); }) {}

SimulationThread::~SimulationThread() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

std::uint64_t SimulationThread::send(Command command) {
    std::uint64_t ticket = 0;
    {
        const std::lock_guard lock(mutex_);
        commands_.push_back(std::move(command));
        ticket = ++sent_;
    }
    wake_.notify_one();
    return ticket;
}

void SimulationThread::start(const sim::Description& description) {
    send([description](Worker& w) { w.start(description); });
}

void SimulationThread::change(const sim::Description& description) {
    send([description](Worker& w) { w.change(description); });
}

void SimulationThread::play(bool on) {
    send([on](Worker& w) {
        w.playing = on;
        w.in_frame = false;
        w.wanted.clear();
        w.restart_pace();
        w.dirty = true;
    });
}

void SimulationThread::step(int substeps) {
    send([substeps](Worker& w) {
        w.playing = w.in_frame = false;
        if (substeps > 0)
            w.wanted.push_back({false, substeps});
        w.dirty = true;
    });
}

std::uint64_t SimulationThread::step_frames(int frames) {
    return send([frames](Worker& w) {
        w.playing = w.in_frame = false;
        if (frames > 0)
            w.wanted.push_back({true, frames});
        w.dirty = true;
    });
}

void SimulationThread::set_speed(double speed) {
    send([speed](Worker& w) {
        w.speed = speed;
        w.restart_pace();
    });
}

void SimulationThread::watch_stability(bool on) {
    send([on](Worker& w) {
        w.margin_wanted = on;
        w.dirty = true;
    });
}

void SimulationThread::watch_quantity(sim::PointQuantity quantity, sim::PointQuantity second) {
    send([quantity, second](Worker& w) {
        w.extras.quantity = quantity;
        w.extras.second_quantity = second;
        w.dirty = true;
    });
}

void SimulationThread::pause_on_trouble(bool diverged, bool jitter) {
    send([diverged, jitter](Worker& w) {
        w.pause_on_diverged = diverged;
        w.pause_on_jitter = jitter;
    });
}

Published SimulationThread::latest() const {
    const std::lock_guard lock(mutex_);
    return published_;
}

void SimulationThread::finish() {
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [this] { return commands_.empty() && !busy_; });
}

void SimulationThread::run() {
    Worker worker;
    worker.restart_pace();
    std::deque<Command> commands;
    std::uint64_t taken = 0; // the newest ticket of which the command has been carried out
    for (;;) {
        {
            const std::lock_guard lock(mutex_);
            if (quit_)
                return;
            commands.swap(commands_);
            taken = sent_;
            if (!commands.empty())
                busy_ = true;
        }
        for (const Command& command : commands)
            command(worker);
        commands.clear();

        std::optional<Clock::time_point> wait_until;
        const bool worked = worker.work(wait_until);
        if (worker.worth_publishing()) {
            auto snapshot = worker.snapshot();
            const std::lock_guard lock(mutex_);
            published_ = {std::move(snapshot),     worker.run,   worker.playing,
                          worker.real_time_factor, worker.error, published_.done};
        }
        if (worker.has_steps_to_take())
            continue;
        {
            // Playing is never done; what was asked for is.
            const std::lock_guard lock(mutex_);
            busy_ = false;
            published_.done = taken;
            idle_.notify_all();
        }
        if (worked)
            continue;
        // In slow motion the next frame may be far off; what has been done is shown before.
        if (wait_until && worker.dirty)
            wait_until = std::min(*wait_until, worker.next_publication());

        std::unique_lock lock(mutex_);
        const auto called = [this] { return quit_ || !commands_.empty(); };
        if (wait_until)
            wake_.wait_until(lock, *wait_until, called);
        else
            wake_.wait(lock, called);
    }
}

} // namespace clothlab::app
