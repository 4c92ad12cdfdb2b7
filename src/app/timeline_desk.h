// The timeline's side of the lab: carries out what its panels ask for and tells them what there is.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/core/comparison_job.h"
#include "app/core/recording_job.h"
#include "app/core/simulation_thread.h"
#include "ui/lab.h"

namespace clothlab::app {

class TimelineDesk {
public:
    /// Both must outlive this.
    TimelineDesk(SimulationThread& simulation, ui::Lab& lab);

    /// Before panels are drawn: tells them what has been published, and what has become of files.
    void update(const Published& now);
    void carry_out(const ui::TimelineRequest& request);
    /// Another scene is begun: ghosts and loops were of the last one.
    void restart();

    /// Opens a recording in the background; take_opened() has it once it is read.
    void open(const std::filesystem::path& file);
    struct Opened {
        timeline::Recording recording;
        std::filesystem::path file;
    };
    std::optional<Opened> take_opened();

    /// Whether a file is being written or read.
    bool busy() const { return lab_.timeline.job.has_value(); }
    /// Whether the lab may close: not while a file is being written, unless it is asked for twice.
    bool may_quit();
    /// Whether panels will have something new to show soon without the user's doing.
    bool expects_news() const { return busy() || (lab_.timeline.ghost != 0 && lab_.timeline.ghost_progress < 1); }

private:
    void carry_out(const ui::PlayBackwards&) { simulation_.play(true, true); }
    void carry_out(const ui::StepBack& r) { simulation_.step_back(r.frame); }
    void carry_out(const ui::JumpToStart&) { simulation_.jump_to_start(); }
    void carry_out(const ui::JumpToEnd&) { simulation_.jump_to_end(); }
    void carry_out(const ui::SeekStep& r) { simulation_.seek(r.step); }
    void carry_out(const ui::GoToMoment& r);
    void carry_out(const ui::SetLoop& r);
    void carry_out(const ui::SwitchBranch& r);
    void carry_out(const ui::RenameBranch& r);
    void carry_out(const ui::RemoveBranch& r);
    void carry_out(const ui::ShowGhost& r);
    void carry_out(const ui::AddBookmark& r);
    void carry_out(const ui::RenameBookmark& r);
    void carry_out(const ui::RemoveBookmark& r);
    void carry_out(const ui::SetBreakpoints& r);
    void carry_out(const ui::SetCacheBudget& r);
    void carry_out(const ui::InspectStep& r) { simulation_.watch_next_step(r.on); }
    void carry_out(const ui::SaveRecording& r);
    void carry_out(const ui::CancelSaving&) { files_->cancel(); }
    void carry_out(const ui::ExportMeshes& r);
    void compare();
    void take_results();
    void say(bool error, std::string text) { lab_.messages.push_back({error, std::move(text)}); }

    SimulationThread& simulation_;
    ui::Lab& lab_;
    // Shared with commands that the simulation's thread has still to carry out.
    std::shared_ptr<RecordingJob> files_ = std::make_shared<RecordingJob>();
    std::shared_ptr<ComparisonJob> comparison_ = std::make_shared<ComparisonJob>();
    std::filesystem::path opening_;
    std::optional<Opened> opened_;
    std::shared_ptr<const sim::Snapshot> published_; ///< that lab_.snapshot was made from
    bool warned_ = false;                            ///< of the file that would not be written
    // What the curve is of.
    std::uint64_t compared_version_ = 0;
    timeline::BranchId compared_line_ = 0, compared_ghost_ = 0;
    std::chrono::steady_clock::time_point compare_due_{};
};

} // namespace clothlab::app
