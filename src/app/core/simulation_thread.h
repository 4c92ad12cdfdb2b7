// The simulation in a thread of its own. The window hands over what the user wants and takes the newest snapshot;
// neither call ever waits for a step.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "sim/description.h"
#include "sim/snapshot.h"

namespace clothlab::app {

/// What the thread has to show.
struct Published {
    std::shared_ptr<const sim::Snapshot> snapshot; ///< none before the first scene has been built
    std::uint64_t run = 0;                         ///< counts the starts: which start() the snapshot belongs to
    bool playing = false;
    double real_time_factor = 0; ///< simulated seconds per second, over the last half second of playing; 0 when unknown
    std::string error;           ///< why the last start or change was refused; empty when it was not
    std::uint64_t done = 0;      ///< tickets up to this one have been done, or ended by trouble or a newer command
};

class SimulationThread {
public:
    SimulationThread();
    /// Ends after the step under way.
    ~SimulationThread();
    SimulationThread(const SimulationThread&) = delete;
    SimulationThread& operator=(const SimulationThread&) = delete;

    /// Starts a run of a description at time 0, paused or playing as before. A description without meaning is refused
    /// (Published::error) and the run under way goes on.
    void start(const sim::Description& description);
    /// Changes the parameters of the run between two steps, before steps that were asked for earlier and are still to
    /// be taken; where can_change_live says no, starts anew.
    void change(const sim::Description& description);

    void play(bool on);
    /// Pauses and takes this many steps, or goes to the end of this many frames.
    void step(int substeps);
    /// The ticket is for who must not miss the frame: once it is done, what is published is the end of these frames.
    std::uint64_t step_frames(int frames);
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
    struct Worker;
    using Command = std::function<void(Worker&)>;
    std::uint64_t send(Command command); ///< the command's ticket
    void run();

    mutable std::mutex mutex_; ///< held for moments only, never during a step
    std::condition_variable wake_, idle_;
    std::deque<Command> commands_;
    std::uint64_t sent_ = 0; ///< commands
    Published published_;
    bool quit_ = false;
    bool busy_ = false; ///< with commands taken from the queue, and the steps that they ask for
    std::thread thread_;
};

} // namespace clothlab::app
