#include "timeline/run_recorder.h"

#include "timeline/recording.h"

namespace clothlab::timeline {
namespace {

/// The file has the states; the player needs but the newest one.
const CacheOptions little{.budget = std::size_t{4} << 20, .seek_s = 1, .least_reach_s = 0};

template <class Write>
auto recording_errors(Write write) {
    try {
        return write();
    } catch (const scene::FileError& e) {
        throw RecordingError(e.what());
    }
}

/// A line that begins with a state.
Timeline resumed(const sim::Description& description, const std::vector<std::byte>& state) {
    const auto simulation = sim::Simulation::create(description);
    simulation->load_state(state);
    const auto start = std::make_shared<const sim::Description>(description);
    const std::uint64_t step = simulation->steps();
    Timeline timeline(little);
    const BranchId id =
        timeline.add_root(start, {step, simulation->frame(), simulation->substep(), description.stepping.substeps,
                                  simulation->time(), sim::step_length(description)});
    timeline.store(id, {step, step, start, keep_in_memory(compress_state(simulation->save_state())), false});
    return timeline;
}

} // namespace

RunRecorder::RunRecorder(const std::filesystem::path& file, const scene::Scene& scene, const sim::Execution& execution,
                         const std::vector<std::byte>* state)
    : player_(little, execution), writer_(recording_errors([&] { return RecordingWriter(file); })) {
    if (state) {
        Timeline timeline = resumed(scene.simulation, *state);
        const Moment at{timeline.branches().front().id, timeline.branches().front().end};
        player_.adopt(std::move(timeline), at);
    } else {
        player_.start(scene.simulation);
    }
    recording_errors([&] {
        const Keyframe& begin = branch().keyframes.front();
        writer_.write(scene);
        writer_.begin(branch());
        writer_.write(branch().clocks.front());
        writer_.write({begin.step,
                       false,
                       begin.description,
                       {},
                       begin.state ? begin.state->compressed() : std::vector<std::byte>()});
    });
}

void RunRecorder::step_frame() {
    const std::uint64_t frame = simulation().frame();
    while (simulation().frame() == frame)
        player_.step();
    recording_errors([&] {
        writer_.write({simulation().steps(), true, branch().start, std::span(&branch().samples.back(), 1),
                       compress_state(simulation().save_state())});
    });
}

void RunRecorder::finish() {
    recording_errors([&] {
        for (const Mark& mark : branch().marks)
            writer_.write(mark);
        if (branch().trouble)
            writer_.write(*branch().trouble, branch().trouble_step);
        writer_.finish();
    });
}

} // namespace clothlab::timeline
