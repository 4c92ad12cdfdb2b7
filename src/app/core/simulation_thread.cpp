#include "app/core/simulation_thread.h"

#include <algorithm>
#include <utility>

#include "app/core/simulation_worker.h"

namespace clothlab::app {

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

std::uint64_t SimulationThread::start(const sim::Description& description) {
    return send([description](SimulationWorker& w) { w.start(description); });
}

std::uint64_t SimulationThread::restart(const sim::Description& description) {
    return send([description](SimulationWorker& w) { w.restart(description); });
}

std::uint64_t SimulationThread::change(const sim::Description& description) {
    return send([description](SimulationWorker& w) { w.change(description); });
}

std::uint64_t SimulationThread::adopt(timeline::Timeline timeline, const timeline::Moment& at) {
    return send([timeline = std::move(timeline), at](SimulationWorker& w) { w.adopt(timeline, at); });
}

void SimulationThread::play(bool on, bool backwards) {
    const std::uint64_t ticket = send([on, backwards](SimulationWorker& w) { w.play(on, backwards); });
    const std::lock_guard lock(mutex_);
    asked_to_play_ = {ticket, on, backwards};
}

void SimulationThread::step(int substeps) {
    send([substeps](SimulationWorker& w) { w.step(false, substeps); });
}

std::uint64_t SimulationThread::step_frames(int frames) {
    return send([frames](SimulationWorker& w) { w.step(true, frames); });
}

void SimulationThread::step_back(bool frame) {
    send([frame](SimulationWorker& w) { w.step_back(frame); });
}

void SimulationThread::jump_to_start() {
    send([](SimulationWorker& w) { w.jump(false); });
}

void SimulationThread::jump_to_end() {
    send([](SimulationWorker& w) { w.jump(true); });
}

void SimulationThread::seek(std::uint64_t step) {
    send([step](SimulationWorker& w) { w.seek(step); });
}

void SimulationThread::with_player(std::function<void(timeline::Player&)> act) {
    send([act = std::move(act)](SimulationWorker& w) { w.act(act); });
}

void SimulationThread::note(std::function<void(timeline::Player&)> act) {
    send([act = std::move(act)](SimulationWorker& w) { w.note(act); });
}

void SimulationThread::look_at(std::function<void(const timeline::Player&)> look) {
    send([look = std::move(look)](SimulationWorker& w) { look(w.player()); });
}

void SimulationThread::set_loop(std::optional<timeline::FrameRange> loop) {
    send([loop](SimulationWorker& w) { w.set_loop(loop); });
}

void SimulationThread::set_breakpoints(std::vector<timeline::Breakpoint> breakpoints) {
    send([breakpoints = std::move(breakpoints)](SimulationWorker& w) { w.set_breakpoints(breakpoints); });
}

void SimulationThread::set_cache(const timeline::CacheOptions& options) {
    send([options](SimulationWorker& w) { w.set_cache(options); });
}

void SimulationThread::watch_next_step(bool on) {
    send([on](SimulationWorker& w) { w.watch_next_step(on); });
}

void SimulationThread::show_ghost(timeline::BranchId branch) {
    send([branch](SimulationWorker& w) { w.show_ghost(branch); });
}

void SimulationThread::set_speed(double speed) {
    send([speed](SimulationWorker& w) { w.set_speed(speed); });
}

void SimulationThread::watch_stability(bool on) {
    send([on](SimulationWorker& w) { w.watch_stability(on); });
}

void SimulationThread::watch_quantity(sim::PointQuantity quantity, sim::PointQuantity second) {
    send([quantity, second](SimulationWorker& w) { w.watch_quantity(quantity, second); });
}

void SimulationThread::pause_on_trouble(bool diverged, bool jitter) {
    send([diverged, jitter](SimulationWorker& w) { w.pause_on_trouble(diverged, jitter); });
}

Published SimulationThread::latest() const {
    const std::lock_guard lock(mutex_);
    Published latest = published_;
    if (latest.taken < asked_to_play_.ticket) {
        latest.playing = asked_to_play_.on;
        latest.backwards = asked_to_play_.backwards;
    }
    return latest;
}

void SimulationThread::finish() {
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [this] { return commands_.empty() && !busy_; });
}

void SimulationThread::run() {
    SimulationWorker worker;
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

        std::optional<SimulationWorker::Clock::time_point> wait_until;
        const bool worked = worker.work(wait_until);
        if (worker.worth_publishing()) {
            Published published = worker.publish();
            published.taken = taken;
            const std::lock_guard lock(mutex_);
            published.done = published_.done;
            published_ = std::move(published);
        }
        if (worker.has_more_to_do())
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
        if (wait_until && worker.dirty())
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
