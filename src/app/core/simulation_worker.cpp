#include "app/core/simulation_worker.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <thread>
#include <utility>

#include "timeline/comparison.h"

namespace clothlab::app {
namespace {

using Seconds = std::chrono::duration<double>;

double seconds(SimulationWorker::Clock::duration d) {
    return Seconds(d).count();
}

SimulationWorker::Clock::duration wall(double s) {
    return std::chrono::duration_cast<SimulationWorker::Clock::duration>(Seconds(s));
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
/// The stability margin and the overview are made no more often than this, and in no more than this share of the time.
constexpr double margin_interval = 0.2, margin_share = 0.1;
constexpr double overview_interval = 0.05, overview_share = 0.05;
/// Bytes of the timeline on disk, until somebody says otherwise.
constexpr std::size_t disk_at_first = std::size_t{1} << 30;

} // namespace

SimulationWorker::SimulationWorker() : player_({.disk = disk_at_first}, {.threads = most_threads()}) {
    restart_pace();
}

void SimulationWorker::fail(const std::exception& e) {
    error_ = e.what();
    error_shown_ = false;
}

void SimulationWorker::moved() {
    breakpoints_.reset();
    let_pass_.reset();
    restart_pace();
    dirty_ = true;
}

void SimulationWorker::begin_run() {
    ++run_;
    margin_.reset();
    ghost_ = 0;
    ghost_reader_ = timeline::Reader();
    wanted_.clear();
    seek_to_.reset();
    in_frame_ = false;
    hit_.reset();
}

void SimulationWorker::start(const sim::Description& description) {
    error_.clear();
    attempt([&] {
        timeline::Player next(player_.options(), {.threads = most_threads()});
        next.start(description);
        player_ = std::move(next);
        loop_.reset();
        begin_run();
    });
}

void SimulationWorker::restart(const sim::Description& description) {
    error_.clear();
    attempt([&] {
        player_.start(description);
        begin_run();
    });
}

void SimulationWorker::change(const sim::Description& description) {
    if (!player_.has_simulation())
        return start(description);
    settle_seek();
    if (!can_change_live(player_.simulation().description(), description))
        return restart(description);
    error_.clear();
    attempt([&] { player_.change(description); });
}

void SimulationWorker::adopt(timeline::Timeline timeline, const timeline::Moment& at) {
    error_.clear();
    attempt([&] {
        player_.adopt(std::move(timeline), at);
        loop_.reset();
        playing_ = false;
        begin_run();
    });
}

void SimulationWorker::pause() {
    playing_ = in_frame_ = false;
    wanted_.clear();
    dirty_ = true;
}

void SimulationWorker::play(bool on, bool backwards) {
    pause();
    playing_ = on;
    backwards_ = backwards;
    hit_.reset();
    restart_pace();
}

void SimulationWorker::step(bool frames, int count) {
    playing_ = in_frame_ = false;
    hit_.reset();
    if (count > 0)
        wanted_.push_back({frames, count});
    dirty_ = true;
}

void SimulationWorker::step_back(bool frame) {
    act([&](timeline::Player& player) {
        const sim::Simulation& now = player.simulation();
        if (now.steps() == 0)
            return;
        if (!frame)
            seek_back(now.steps() - 1);
        else
            seek_back(step_of_frame(now.substep() > 0 ? now.frame() : now.frame() - 1));
    });
    hit_.reset();
}

void SimulationWorker::jump(bool to_end) {
    act([&](timeline::Player& player) { player.seek(to_end ? player.timeline().find(player.line())->end : 0); });
    hit_.reset();
}

bool SimulationWorker::seek_back(std::uint64_t step) {
    const auto there = player_.timeline().previous_reachable({player_.line(), step});
    if (there)
        player_.seek(*there);
    return there.has_value();
}

void SimulationWorker::seek(std::uint64_t step) {
    pause();
    seek_to_ = step;
    hit_.reset();
}

void SimulationWorker::settle_seek() {
    const auto step = std::exchange(seek_to_, std::nullopt);
    if (step && player_.has_simulation())
        attempt([&] { player_.seek(*step); });
}

void SimulationWorker::set_speed(double speed) {
    speed_ = speed;
    restart_pace();
}

void SimulationWorker::set_breakpoints(std::vector<timeline::Breakpoint> breakpoints) {
    breakpoints_.set(std::move(breakpoints));
    hit_.reset();
    dirty_ = true;
}

void SimulationWorker::set_cache(const timeline::CacheOptions& options) {
    player_.set_options(options);
    dirty_ = true;
}

void SimulationWorker::watch_stability(bool on) {
    margin_wanted_ = on;
    dirty_ = true;
}

void SimulationWorker::watch_quantity(sim::PointQuantity quantity, sim::PointQuantity second) {
    extras_.quantity = quantity;
    extras_.second_quantity = second;
    dirty_ = true;
}

void SimulationWorker::watch_next_step(bool on) {
    trace_wanted_ = on;
    dirty_ = true;
}

void SimulationWorker::show_ghost(timeline::BranchId branch) {
    ghost_ = branch;
    dirty_ = true;
}

void SimulationWorker::pause_on_trouble(bool diverged, bool jitter) {
    pause_on_diverged_ = diverged;
    pause_on_jitter_ = jitter;
}

void SimulationWorker::restart_pace() {
    pace_wall_ = factor_wall_ = Clock::now();
    pace_time_ = factor_time_ = player_.has_simulation() ? player_.simulation().time() : 0;
    real_time_factor_ = 0;
}

SimulationWorker::Clock::time_point SimulationWorker::due() const {
    const double ahead = std::abs(player_.simulation().time() - pace_time_) / speed_;
    return pace_wall_ + wall(std::min(ahead, 1e6));
}

std::uint64_t SimulationWorker::step_of_frame(std::uint64_t frame) const {
    return player_.timeline().step_of_frame(player_.line(), frame);
}

bool SimulationWorker::work(std::optional<Clock::time_point>& wait_until) {
    if (!player_.has_simulation()) {
        wanted_.clear(); // there is nothing to step
        seek_to_.reset();
        return false;
    }
    if (seek_to_) {
        settle_seek();
        return true;
    }
    if (!wanted_.empty()) {
        const std::uint64_t frame = player_.simulation().frame();
        take_step();
        if (wanted_.empty()) // trouble has ended them all
            return true;
        Wanted& next = wanted_.front();
        if (!next.frames || player_.simulation().frame() != frame)
            --next.count;
        if (next.count == 0)
            wanted_.pop_front();
        return true;
    }
    if (!playing_)
        return false;
    if (!in_frame_) {
        const Clock::time_point now = Clock::now(), when = due();
        if (now < when) {
            wait_until = when;
            return false;
        }
        if (seconds(now - when) > forgiven) {
            pace_wall_ = now;
            pace_time_ = player_.simulation().time();
        }
    }
    backwards_ ? play_back() : play_step();
    measure_factor();
    return true;
}

void SimulationWorker::play_step() {
    const std::uint64_t frame = player_.simulation().frame();
    if (loop_ && !in_frame_ && frame >= loop_->last && player_.simulation().substep() == 0) {
        attempt([&] { player_.seek(step_of_frame(loop_->first)); });
        return;
    }
    take_step();
    in_frame_ = playing_ && player_.simulation().frame() == frame;
}

void SimulationWorker::play_back() {
    const sim::Simulation& now = player_.simulation();
    const std::uint64_t frame = now.substep() > 0 ? now.frame() + 1 : now.frame(); // that began before here
    dirty_ = true;
    try {
        if (loop_ && frame <= loop_->first) {
            player_.seek(step_of_frame(loop_->last));
            restart_pace();
        } else if (frame == 0 || !seek_back(step_of_frame(frame - 1))) {
            playing_ = false; // there is nothing further back
        }
    } catch (const std::exception& e) {
        fail(e);
        playing_ = false;
    }
    breakpoints_.reset();
}

void SimulationWorker::take_step() {
    const timeline::Moment before = player_.moment();
    const sim::Trouble* trouble = player_.trouble();
    const bool had_trouble = trouble != nullptr;
    const bool watched = breakpoints_.any();
    dirty_ = true;
    if (watched)
        breakpoints_.before_step(player_.simulation());
    sim::StepCounts counts;
    try {
        step_times_.before_step(player_.simulation());
        counts = player_.step();
        step_times_.after_step(player_.simulation());
    } catch (const std::exception& e) { // a stored state that cannot be read
        fail(e);
        pause();
        return;
    }
    const bool passes = std::exchange(let_pass_, std::nullopt) == before;
    if (watched)
        if (const auto hit = breakpoints_.after_step(player_.simulation(), counts); hit && !passes)
            stop_at(*hit, before.step);
    trouble = player_.trouble();
    if (!trouble)
        return;
    const bool diverged = trouble->status == sim::Status::diverged;
    if (diverged ? pause_on_diverged_ : pause_on_jitter_ && !had_trouble)
        pause();
}

void SimulationWorker::stop_at(std::size_t breakpoint, std::uint64_t before) {
    pause();
    hit_ = breakpoint;
    if (breakpoints_.breakpoints()[breakpoint].before) {
        attempt([&] { player_.seek(before); });
        let_pass_ = player_.moment();
    }
}

void SimulationWorker::renew_margin() {
    const timeline::Moment here = player_.moment();
    if (margin_of_ != player_.description())
        margin_.reset();
    const bool of_this_state = margin_ && margin_moment_ == here;
    if (of_this_state || (margin_ && !idle() && Clock::now() < margin_due_))
        return;
    const Clock::time_point begin = Clock::now();
    margin_ = player_.simulation().stability();
    margin_of_ = player_.description();
    margin_moment_ = here;
    const Clock::time_point end = Clock::now();
    margin_due_ = end + wall(std::max(margin_interval, seconds(end - begin) / margin_share));
}

void SimulationWorker::renew_trace() {
    if (!trace_wanted_ || !idle()) {
        trace_.reset();
        return;
    }
    if (trace_ && trace_moment_ == player_.moment() && trace_of_ == player_.description())
        return;
    trace_moment_ = player_.moment();
    trace_of_ = player_.description();
    trace_ = std::make_shared<const sim::StepTrace>(player_.simulation().trace_step());
}

void SimulationWorker::renew_ghost() {
    ghost_snapshot_.reset();
    if (ghost_ == 0 || !player_.timeline().find(ghost_))
        return;
    const auto moment = timeline::same_time(player_.timeline(), player_.moment(), ghost_);
    if (!moment)
        return;
    try {
        ghost_reader_.seek(player_.timeline(), *moment);
    } catch (const std::exception& e) {
        fail(e);
        ghost_ = 0;
        return;
    }
    auto snapshot = std::make_shared<sim::Snapshot>();
    ghost_reader_.simulation().capture(*snapshot);
    ghost_snapshot_ = std::move(snapshot);
}

void SimulationWorker::renew_overview() {
    const bool same = overview_ && overview_->version == player_.version() && overview_line_ == player_.line();
    if (same || (overview_ && overview_line_ == player_.line() && !idle() && Clock::now() < overview_due_))
        return;
    const Clock::time_point begin = Clock::now();
    overview_ = std::make_shared<const timeline::Overview>(timeline::overview(player_));
    overview_line_ = player_.line();
    const Clock::time_point end = Clock::now();
    overview_due_ = end + wall(std::max(overview_interval, seconds(end - begin) / overview_share));
}

void SimulationWorker::measure_factor() {
    const double passed = seconds(Clock::now() - factor_wall_);
    if (passed < factor_window)
        return;
    real_time_factor_ = std::abs(player_.simulation().time() - factor_time_) / passed;
    factor_wall_ = Clock::now();
    factor_time_ = player_.simulation().time();
}

SimulationWorker::Clock::time_point SimulationWorker::next_publication() const {
    return published_at_ + wall(publish_interval);
}

std::shared_ptr<sim::Snapshot> SimulationWorker::snapshot() {
    const sim::Simulation& simulation = player_.simulation();
    auto s = std::make_shared<sim::Snapshot>();
    simulation.capture(*s, extras_);
    if (const sim::Trouble* trouble =
            player_.trouble()) { // also where the run has been rewound since, and watched anew
        s->trouble = *trouble;
        s->diagnostics.status = trouble->status;
        s->diagnostics.cause = trouble->cause;
    }
    if (margin_wanted_) {
        renew_margin();
        s->stability = margin_;
    }
    s->seconds_per_step = step_times_.take();
    return s;
}

Published SimulationWorker::publish() {
    Published p;
    if (player_.has_simulation()) {
        p.snapshot = snapshot();
        renew_trace();
        renew_ghost();
        renew_overview();
        p.description = player_.description();
        p.playhead = timeline::playhead(player_);
        p.overview = overview_;
        p.ghost = ghost_snapshot_;
        p.trace = trace_;
    }
    p.run = run_;
    p.playing = playing_;
    p.backwards = backwards_;
    p.real_time_factor = real_time_factor_;
    p.error = error_;
    error_shown_ = true;
    p.hit = hit_;
    published_at_ = Clock::now();
    dirty_ = false;
    return p;
}

} // namespace clothlab::app
