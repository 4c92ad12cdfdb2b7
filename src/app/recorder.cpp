#include "app/recorder.h"

#include "app/ghost_view.h"

namespace clothlab::app {

Recorder::Recorder(const RecordingPlan& plan, SimulationThread& simulation, PictureMaker maker,
                   std::unique_ptr<PictureSink> sink)
    : plan_(plan), simulation_(simulation), maker_(std::move(maker)), sink_(std::move(sink)),
      ticket_(simulation.step_frames(0)) {}

bool Recorder::advance(const scene::Scene& scene, const std::vector<scene::ShaderDeclaration>& shaders) {
    const Published now = simulation_.latest();
    if (now.done < ticket_ || paused_)
        return true;
    if (!now.snapshot) {
        why_ = "there is no cloth";
        return false;
    }
    if (pictures_ == 0) {
        run_ = now.run;
        frame_ = now.snapshot->frame;
    }
    if (now.run != run_) {
        why_ = "the run was started anew";
        return false;
    }
    const std::uint64_t at = now.snapshot->frame;
    const auto& trouble = now.snapshot->trouble;
    if (at < frame_ && trouble && trouble->status == sim::Status::jitter) {
        // The lab may be set to pause there once, for who plays; a recording goes on.
        ticket_ = simulation_.step_frames(static_cast<int>(frame_ - at));
        return true;
    }
    if (at != frame_) {
        why_ = trouble ? trouble->cause : "the run was stepped by hand";
        return false;
    }
    const sim::Snapshot* ghost = now.ghost.get();
    sink_->add(maker_.draw(scene, shaders, compare_with_ghost(now.snapshot, ghost).snapshot.get(), ghost));
    ++pictures_;
    if (pictures_ == plan_.pictures)
        return false;
    frame_ += static_cast<std::uint64_t>(plan_.every);
    ticket_ = simulation_.step_frames(plan_.every);
    return true;
}

} // namespace clothlab::app
