// What the simulation's thread does, in its own thread alone: the run and its timeline, what it was asked for and has
// not done yet, the pace of playing, and what there is to show.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "app/core/published.h"
#include "app/core/step_times.h"
#include "timeline/breakpoints.h"
#include "timeline/player.h"

namespace clothlab::app {

class SimulationWorker {
public:
    using Clock = std::chrono::steady_clock;

    SimulationWorker();

    // What the thread is asked for; see SimulationThread.
    void start(const sim::Description& description);
    void restart(const sim::Description& description);
    void change(const sim::Description& description);
    void adopt(timeline::Timeline timeline, const timeline::Moment& at);
    void play(bool on, bool backwards);
    void step(bool frames, int count);
    void step_back(bool frame);
    void jump(bool to_end);
    void seek(std::uint64_t step);
    /// Does something with the player, which then stands still; what cannot be done becomes the error shown.
    template <class Act>
    void act(Act act) {
        pause();
        settle_seek();
        if (player_.has_simulation())
            attempt([&] { act(player_); });
    }
    /// The same without standing still.
    template <class Act>
    void note(Act act) {
        settle_seek();
        if (player_.has_simulation())
            attempt([&] { act(player_); });
    }
    void set_speed(double speed);
    void set_loop(std::optional<timeline::FrameRange> loop) { loop_ = loop; }
    void set_breakpoints(std::vector<timeline::Breakpoint> breakpoints);
    void set_cache(const timeline::CacheOptions& options);
    void watch_stability(bool on);
    void watch_quantity(sim::PointQuantity quantity, sim::PointQuantity second);
    void watch_next_step(bool on);
    void show_ghost(timeline::BranchId branch);
    void pause_on_trouble(bool diverged, bool jitter);

    /// Takes one step, or goes where it was last asked to, if there is anything to do now; otherwise says until when
    /// there is not.
    bool work(std::optional<Clock::time_point>& wait_until);
    bool has_more_to_do() const { return !wanted_.empty() || seek_to_; }
    /// Whether the state as it is now is worth showing.
    bool worth_publishing() const { return dirty_ && (idle() || Clock::now() >= next_publication()); }
    bool dirty() const { return dirty_; }
    Clock::time_point next_publication() const;
    /// All that there is to show, except for the tickets.
    Published publish();
    const timeline::Player& player() const { return player_; }

private:
    // Steps, or ends of frames, that were asked for.
    struct Wanted {
        bool frames;
        int count;
    };

    /// What it throws becomes the error shown.
    template <class Task>
    void attempt(Task task) {
        try {
            task();
            if (error_shown_)
                error_.clear();
        } catch (const std::exception& e) {
            fail(e);
        }
        moved();
    }
    void moved();
    void fail(const std::exception& e);
    void begin_run();
    void pause();
    void settle_seek();
    void restart_pace();
    Clock::time_point due() const;
    bool idle() const { return !playing_ && !has_more_to_do(); }
    bool seek_back(std::uint64_t step); ///< to it or before it
    void play_step();
    void play_back();
    void take_step();
    void stop_at(std::size_t breakpoint, std::uint64_t before);
    std::uint64_t step_of_frame(std::uint64_t frame) const;
    void measure_factor();
    void renew_margin();
    void renew_trace();
    void renew_ghost();
    void renew_overview();
    std::shared_ptr<sim::Snapshot> snapshot();

    timeline::Player player_;
    std::uint64_t run_ = 0;
    std::string error_;
    bool error_shown_ = true; ///< it has been published, and may be cleared by the next success
    bool playing_ = false, backwards_ = false;
    double speed_ = 1;
    std::deque<Wanted> wanted_;            ///< in the order in which they were asked for
    std::optional<std::uint64_t> seek_to_; ///< of the line shown; the newest wish replaces older ones
    bool in_frame_ = false;                ///< playing has begun a frame that it is to complete
    bool dirty_ = true;                    ///< something changed since the last publication
    double real_time_factor_ = 0;
    bool pause_on_diverged_ = true, pause_on_jitter_ = false;
    std::optional<timeline::FrameRange> loop_;

    timeline::BreakpointWatch breakpoints_;
    std::optional<std::size_t> hit_; ///< that paused the run
    // The step that a breakpoint has paused before: it is not stopped at again.
    std::optional<timeline::Moment> let_pass_;

    sim::SnapshotExtras extras_; ///< that snapshots have

    bool margin_wanted_ = false;
    std::optional<sim::StabilityMargin> margin_; ///< the newest, of the run as it is described now
    timeline::DescriptionPtr margin_of_;
    timeline::Moment margin_moment_; ///< of the state that it is of
    Clock::time_point margin_due_;

    bool trace_wanted_ = false;
    std::shared_ptr<const sim::StepTrace> trace_;
    timeline::Moment trace_moment_;
    timeline::DescriptionPtr trace_of_;

    timeline::BranchId ghost_ = 0;
    timeline::Reader ghost_reader_;
    std::shared_ptr<const sim::Snapshot> ghost_snapshot_;

    std::shared_ptr<const timeline::Overview> overview_;
    timeline::BranchId overview_line_ = 0;
    Clock::time_point overview_due_;

    // Pace: where simulated and wall time were when playing, speed or run last changed.
    Clock::time_point pace_wall_, factor_wall_;
    double pace_time_ = 0, factor_time_ = 0;

    Clock::time_point published_at_;
    StepTimes step_times_;
};

} // namespace clothlab::app
