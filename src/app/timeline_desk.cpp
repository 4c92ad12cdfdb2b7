#include "app/timeline_desk.h"

#include <algorithm>
#include <system_error>
#include <type_traits>
#include <utility>

#include "app/ghost_view.h"
#include "ui/camera.h"

namespace clothlab::app {
namespace {

/// The curve of a line that grows is continued this often.
constexpr std::chrono::milliseconds compare_interval{500};

} // namespace

TimelineDesk::TimelineDesk(SimulationThread& simulation, ui::Lab& lab) : simulation_(simulation), lab_(lab) {}

void TimelineDesk::restart() {
    comparison_->stop();
    compared_line_ = compared_ghost_ = 0;
    ui::TimelineWork& t = lab_.timeline;
    t.ghost = 0;
    t.ghost_curve.reset();
    t.ghost_progress = 0;
    t.loop.reset();
}

void TimelineDesk::update(const Published& now) {
    ui::TimelineWork& t = lab_.timeline;
    if (now.overview)
        t.overview = now.overview;
    t.playhead = now.playhead;
    t.backwards = now.playing && now.backwards;
    t.trace = now.trace;
    if (now.hit && !t.hit && *now.hit < t.breakpoints.size())
        say(false, "Paused: " + timeline::describe(t.breakpoints[*now.hit]) + ".");
    t.hit = now.hit;
    if (t.ghost_snapshot != now.ghost || published_ != now.snapshot) {
        published_ = now.snapshot;
        t.ghost_snapshot = now.ghost;
        const GhostView view = compare_with_ghost(now.snapshot, now.ghost.get());
        lab_.snapshot = view.snapshot;
        t.ghost_distance = view.distance;
    }
    compare();
    take_results();
}

void TimelineDesk::compare() {
    ui::TimelineWork& t = lab_.timeline;
    if (!t.overview || t.ghost == 0)
        return;
    const auto known = [&](const timeline::BranchInfo& branch) { return branch.id == t.ghost; };
    if (std::none_of(t.overview->branches.begin(), t.overview->branches.end(), known) || t.ghost == t.overview->line) {
        if (compared_ghost_ != 0 || t.ghost == t.overview->line)
            carry_out(ui::ShowGhost{});
        return;
    }
    const bool same_pair = compared_line_ == t.overview->line && compared_ghost_ == t.ghost;
    const auto clock = std::chrono::steady_clock::now();
    if (!same_pair || (compared_version_ != t.overview->version && clock >= compare_due_)) {
        compared_line_ = t.overview->line;
        compared_ghost_ = t.ghost;
        compared_version_ = t.overview->version;
        compare_due_ = clock + compare_interval;
        simulation_.look_at([job = comparison_, ghost = t.ghost](const timeline::Player& player) {
            job->compare(player.timeline(), player.line(), ghost);
        });
    }
    const ComparisonJob::Result result = comparison_->latest();
    const bool of_this = result.a == compared_line_ && result.b == compared_ghost_;
    t.ghost_curve = of_this ? result.samples : nullptr;
    t.ghost_progress = of_this ? result.progress : 0;
}

void TimelineDesk::take_results() {
    const auto status = files_->status();
    lab_.timeline.job = status ? std::optional(ui::TimelineWork::Job{status->what, status->share}) : std::nullopt;
    std::optional<RecordingJob::Result> result = files_->take_result();
    if (!result)
        return;
    warned_ = false;
    const bool damaged = result->loaded && !result->loaded->damage.empty();
    say((!result->succeeded && !result->cancelled) || damaged, result->text);
    if (result->loaded)
        opened_ = Opened{std::move(*result->loaded), opening_};
}

void TimelineDesk::open(const std::filesystem::path& file) {
    if (files_->load(file))
        opening_ = file;
    else
        say(true, file.string() + ": cannot be opened before the file under way is done or cancelled.");
}

std::optional<TimelineDesk::Opened> TimelineDesk::take_opened() {
    return std::exchange(opened_, std::nullopt);
}

bool TimelineDesk::may_quit() {
    if (!busy() || std::exchange(warned_, true))
        return true;
    say(true, lab_.timeline.job->what + " is still under way. Quit again to give it up; the old file stays as it is.");
    return false;
}

void TimelineDesk::carry_out(const ui::TimelineRequest& request) {
    std::visit([this](const auto& r) { carry_out(r); }, request);
}

void TimelineDesk::carry_out(const ui::GoToMoment& r) {
    simulation_.with_player([moment = r.moment](timeline::Player& player) { player.go_to(moment); });
    if (r.camera)
        ui::fly(lab_, *r.camera);
}

void TimelineDesk::carry_out(const ui::SetLoop& r) {
    lab_.timeline.loop = r.range;
    simulation_.set_loop(r.range);
}

void TimelineDesk::carry_out(const ui::SwitchBranch& r) {
    simulation_.with_player([id = r.branch](timeline::Player& player) { player.switch_to(id); });
}

void TimelineDesk::carry_out(const ui::RenameBranch& r) {
    simulation_.note([r](timeline::Player& player) { player.rename_branch(r.branch, r.name); });
}

void TimelineDesk::carry_out(const ui::RemoveBranch& r) {
    if (r.branch == lab_.timeline.ghost)
        carry_out(ui::ShowGhost{});
    simulation_.with_player([id = r.branch](timeline::Player& player) { player.remove_branch(id); });
}

void TimelineDesk::carry_out(const ui::ShowGhost& r) {
    ui::TimelineWork& t = lab_.timeline;
    t.ghost = r.branch;
    t.ghost_curve.reset();
    t.ghost_progress = 0;
    compared_line_ = compared_ghost_ = 0;
    if (r.branch == 0)
        comparison_->stop();
    simulation_.show_ghost(r.branch);
}

void TimelineDesk::carry_out(const ui::AddBookmark& r) {
    simulation_.note([name = r.name, camera = scene::camera_of(lab_.scene)](timeline::Player& player) {
        player.bookmark(name, camera);
    });
}

void TimelineDesk::carry_out(const ui::RenameBookmark& r) {
    simulation_.note([r](timeline::Player& player) { player.rename_bookmark(r.bookmark, r.name); });
}

void TimelineDesk::carry_out(const ui::RemoveBookmark& r) {
    simulation_.note([id = r.bookmark](timeline::Player& player) { player.remove_bookmark(id); });
}

void TimelineDesk::carry_out(const ui::SetBreakpoints& r) {
    lab_.timeline.breakpoints = r.breakpoints;
    simulation_.set_breakpoints(r.breakpoints);
}

void TimelineDesk::carry_out(const ui::SetCacheBudget& r) {
    timeline::CacheOptions options;
    options.budget = r.bytes;
    options.least_reach_s = r.least_reach_s;
    options.disk = r.disk;
    simulation_.set_cache(options);
}

void TimelineDesk::carry_out(const ui::SaveRecording& r) {
    std::filesystem::path file = r.file;
    if (file.extension() != timeline::recording_suffix)
        file += timeline::recording_suffix;
    std::error_code error;
    if (!r.replace && std::filesystem::exists(file, error))
        return say(true, file.string() + ": this exists already; choose another name, or save and replace.");
    if (busy())
        return say(true, "Only one file at a time: the one under way has to be done or cancelled first.");
    simulation_.look_at([files = files_, scene = lab_.scene, file](const timeline::Player& player) {
        files->save({scene, player.timeline(), player.moment(), {}}, file);
    });
}

void TimelineDesk::carry_out(const ui::ExportMeshes& r) {
    if (busy())
        return say(true, "Only one file at a time: the one under way has to be done or cancelled first.");
    timeline::MeshSequence sequence;
    sequence.folder = r.folder;
    sequence.format = r.format;
    sequence.frames = r.frames;
    sequence.every = r.every;
    sequence.title = lab_.scene.name;
    simulation_.look_at([files = files_, sequence](const timeline::Player& player) {
        timeline::MeshSequence of_line = sequence;
        of_line.line = player.line();
        files->write_meshes(player.timeline(), of_line);
    });
}

} // namespace clothlab::app
