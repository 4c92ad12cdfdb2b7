// Records a run while it goes on: every frame's end goes into the file at once, so that memory does not grow with the
// run.
#pragma once

#include "timeline/player.h"
#include "timeline/recording_writer.h"

namespace clothlab::timeline {

class RunRecorder {
public:
    /// A run of the scene from its start; with a state, from that (Simulation::load_state). Throws RecordingError,
    /// std::invalid_argument.
    RunRecorder(const std::filesystem::path& file, const scene::Scene& scene, const sim::Execution& execution,
                const std::vector<std::byte>* state = nullptr);

    /// With stages timed and trouble watched for.
    const sim::Simulation& simulation() const { return player_.simulation(); }
    /// To the end of the frame under way. Throws RecordingError.
    void step_frame();
    /// The last call: puts the file in its place. Throws RecordingError.
    void finish();

private:
    const Branch& branch() const { return *player_.timeline().find(player_.line()); }

    Player player_;
    RecordingWriter writer_;
};

} // namespace clothlab::timeline
