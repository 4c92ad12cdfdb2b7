// A recording of the simulation's own frames: each is drawn once, in order, however fast or slow the screen is.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "app/core/simulation_thread.h"
#include "app/gui/picture_sink.h"
#include "app/picture_maker.h"

namespace clothlab::app {

/// What a recording takes of a run.
struct RecordingPlan {
    int every = 1;    ///< simulated frames from one picture to the next
    int pictures = 0; ///< that the recording ends with; 0: it goes on until it is ended
};

class Recorder {
public:
    /// Begins with the state that the simulation is in when it has done all that it was asked for so far; from then on
    /// the recorder makes the steps. The thread must outlive this.
    Recorder(const RecordingPlan& plan, SimulationThread& simulation, PictureMaker maker,
             std::unique_ptr<PictureSink> sink);

    /// Draws the next picture if its frame has been simulated, and asks for the one after it. Never waits for the
    /// simulation. False when the recording has come to its end, see why(). Throws std::runtime_error when a picture
    /// cannot be drawn or kept.
    bool advance(const scene::Scene& scene, const std::vector<scene::ShaderDeclaration>& shaders);

    /// Lets the simulation rest, or go on, between two pictures.
    void pause(bool on) { paused_ = on; }
    bool paused() const { return paused_; }
    /// Completes what was recorded. Throws std::runtime_error when that cannot be done.
    void finish() { sink_->finish(); }
    /// Removes what was recorded.
    void discard() { sink_->discard(); }

    int pictures() const { return pictures_; }
    const RecordingPlan& plan() const { return plan_; }
    /// Why the recording ended before it had all pictures; empty when it has them.
    const std::string& why() const { return why_; }

private:
    RecordingPlan plan_;
    SimulationThread& simulation_;
    PictureMaker maker_;
    std::unique_ptr<PictureSink> sink_;
    std::uint64_t ticket_ = 0;          ///< of the frame that is waited for
    std::uint64_t run_ = 0, frame_ = 0; ///< that it belongs to
    int pictures_ = 0;
    bool paused_ = false;
    std::string why_;
};

} // namespace clothlab::app
