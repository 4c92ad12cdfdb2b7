// The simulation in a thread of its own. The window hands over what the user wants and takes the newest snapshot;
// neither call ever waits for a step.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/core/published.h"
#include "sim/description.h"
#include "timeline/breakpoints.h"
#include "timeline/timeline.h"

namespace clothlab::timeline {
class Player;
}

namespace clothlab::app {

class SimulationWorker;

class SimulationThread {
public:
    SimulationThread();
    /// Ends after the step under way.
    ~SimulationThread();
    SimulationThread(const SimulationThread&) = delete;
    SimulationThread& operator=(const SimulationThread&) = delete;

    /// Forgets all runs and starts one of a description at time 0, paused or playing as before. A description without
    /// meaning is refused (Published::error) and the run under way goes on.
    std::uint64_t start(const sim::Description& description);
    /// Starts another run beside those there are.
    std::uint64_t restart(const sim::Description& description);
    /// Changes the parameters of the run between two steps, before steps that were asked for earlier and are still to
    /// be taken (timeline::Player::change); where can_change_live says no, restarts. As of the others that give one,
    /// its ticket tells when it has been taken up (Published::taken).
    std::uint64_t change(const sim::Description& description);
    /// Another timeline in place of the present one, paused at a moment of it.
    std::uint64_t adopt(timeline::Timeline timeline, const timeline::Moment& at);

    /// latest() says so at once, though the run may still be in the middle of a step: what a key does next depends on
    /// it.
    void play(bool on, bool backwards = false);
    /// Pauses and takes this many steps, or goes to the end of this many frames.
    void step(int substeps);
    /// The ticket is for who must not miss the frame: once it is done, what is published is the end of these frames.
    std::uint64_t step_frames(int frames);
    // All that goes elsewhere in time pauses.
    /// To the end of the frame before, or one step back.
    void step_back(bool frame);
    void jump_to_start();
    void jump_to_end();
    /// To a step of the line shown. Of several that are asked for before the first can be gone to, the last one counts.
    void seek(std::uint64_t step);
    /// Does something with the runs, in their own thread, which pauses first; what it throws becomes Published::error.
    void with_player(std::function<void(timeline::Player&)> act);
    /// The same for what changes neither the state nor where the runs go: without a pause.
    void note(std::function<void(timeline::Player&)> act);
    /// Reads from the runs, in their own thread, which goes on afterwards as before.
    void look_at(std::function<void(const timeline::Player&)> look);
    /// Playing goes round in this range of frames of the line shown; none: to its end and on.
    void set_loop(std::optional<timeline::FrameRange> loop);
    void set_breakpoints(std::vector<timeline::Breakpoint> breakpoints);
    void set_cache(const timeline::CacheOptions& options);
    /// Whether what is published has the inside of the next step (Published::trace) when paused.
    void watch_next_step(bool on);
    /// The branch of which Published::ghost is; 0: none.
    void show_ghost(timeline::BranchId branch);

    /// Simulated seconds per second that playing aims at; above 0.
    void set_speed(double speed);
    /// Whether snapshots have the stability margin (Snapshot::stability): while stepping the newest one, renewed a few
    /// times a second, when paused that of the state shown. Off at the start, for its cost.
    void watch_stability(bool on);
    /// Which point quantities snapshots have (Snapshot::quantity, second_quantity), from the next one on; none at the
    /// start, for their cost.
    void watch_quantity(sim::PointQuantity quantity, sim::PointQuantity second = sim::PointQuantity::none);
    /// Whether playing stops at the first trouble of a run. At the start it does for a divergence, after which there is
    /// nothing to see, and not for jitter.
    void pause_on_trouble(bool diverged, bool jitter);

    Published latest() const;
    /// Waits until all that was asked for so far has been done (steps taken, scenes built, playing begun): for tests
    /// and for pictures without a display, not for the window.
    void finish();

private:
    using Command = std::function<void(SimulationWorker&)>;
    std::uint64_t send(Command command); ///< the command's ticket
    void run();

    mutable std::mutex mutex_; ///< held for moments only, never during a step
    std::condition_variable wake_, idle_;
    std::deque<Command> commands_;
    std::uint64_t sent_ = 0; ///< commands
    Published published_;
    struct {
        std::uint64_t ticket = 0;
        bool on = false, backwards = false;
    } asked_to_play_; ///< last
    bool quit_ = false;
    bool busy_ = false; ///< with commands taken from the queue, and the steps that they ask for
    std::thread thread_;
};

} // namespace clothlab::app
