#include "app/experiment_desk.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "app/gui/chart_picture.h"
#include "app/session_report.h"
#include "app/textures.h"
#include "experiments/report.h"
#include "experiments/trial.h"
#include "render/image.h"
#include "scene/io.h"
#include "timeline/player.h"

namespace clothlab::app {
namespace {

namespace fs = std::filesystem;

/// The values of settings, as a branch's name: "rk4, 10".
std::string name_of(const experiments::Settings& settings) {
    std::string name;
    for (const std::string& setting : settings)
        name += (name.empty() ? "" : ", ") + setting.substr(setting.rfind('.', setting.find('=')) + 1);
    constexpr std::size_t most = 60;
    return name.empty() ? "the scene itself" : name.size() > most ? name.substr(0, most) + " ..." : name;
}

/// Names a run that has just been begun; one that was there before keeps its name.
void name_new_run(timeline::Player& player, const std::string& name) {
    if (player.timeline().find(player.line())->end == 0)
        player.rename_branch(player.line(), name);
}

bool is_there(const fs::path& file) {
    std::error_code error;
    return fs::exists(file, error);
}

} // namespace

ExperimentDesk::ExperimentDesk(SimulationThread& simulation, render::Renderer& renderer, ui::Lab& lab)
    : simulation_(simulation), renderer_(renderer), lab_(lab) {}

void ExperimentDesk::carry_out(const ui::ExperimentRequest& request) {
    std::visit([this](const auto& r) { carry_out(r); }, request);
}

void ExperimentDesk::carry_out(const ui::RunExperiment& r) {
    if (!job_.start(r.work))
        return say(true, "Only one experiment at a time: the one under way has to end or be cancelled first.");
    kind_ = r.kind;
    lab_.experiments.refused[static_cast<std::size_t>(kind_)].clear();
    of_.scene = lab_.scene;
    of_.command = r.command;
}

void ExperimentDesk::update(const Published& now) {
    take_results();
    follow_trial(now);
    if (report_ && report_->complete)
        write_report();
}

void ExperimentDesk::ask_for_hash() {
    report_->complete = false;
    simulation_.look_at([report = report_](const timeline::Player& player) {
        report->hash = player.simulation().hash();
        report->steps = player.simulation().steps();
        report->complete = true;
    });
}

void ExperimentDesk::write_report() {
    if (lab_.playing || lab_.snapshot->steps != report_->steps)
        return ask_for_hash(); // a frame that playing had begun was completed meanwhile
    const auto report = std::exchange(report_, nullptr);
    try {
        write_session_report(lab_, renderer_, report->hash, report->folder);
        lab_.ask(ui::TimelineRequest(ui::SaveRecording{report->folder / session_file, true}));
        say(false, "The report was written as " + (report->folder / "report.html").string() + " and report.md.");
    } catch (const std::exception& e) {
        say(true, e.what());
    }
}

void ExperimentDesk::take_results() {
    const auto status = job_.status();
    lab_.experiments.job =
        status ? std::optional(ui::ExperimentWork::Job{kind_, status->share, status->what, status->elapsed_s})
               : std::nullopt;
    auto result = job_.take_result();
    if (!result)
        return;
    if (result->findings) {
        const auto kind = static_cast<std::size_t>(kind_);
        lab_.experiments.found[kind] = std::make_shared<const ui::FoundOut>(
            ui::FoundOut{std::move(*result->findings), std::move(of_.scene), std::move(of_.command)});
        lab_.experiments.marked[kind].reset();
        lab_.experiments.chart[kind] = 0;
    }
    lab_.experiments.refused[static_cast<std::size_t>(kind_)] = result->error;
}

void ExperimentDesk::carry_out(const ui::ShowTrial& r) {
    const auto found = lab_.experiments.found[static_cast<std::size_t>(r.kind)];
    if (!found || r.row >= found->findings.settings.size())
        return;
    const experiments::Findings& findings = found->findings;
    trial_.reset();
    try {
        const sim::Description run = experiments::with(found->scene, findings.settings[r.row]).simulation;
        const std::string name = name_of(findings.settings[r.row]);
        const sim::Description reference = experiments::with(found->scene, findings.reference).simulation;
        if (r.kind == ui::ExperimentKind::stability || run == reference)
            return show_run(run, name);
        trial_ = Trial{.run = run, .name = name};
        show_reference(reference, findings.seconds);
    } catch (const std::exception& e) {
        say(true, e.what());
    }
}

void ExperimentDesk::show_reference(const sim::Description& reference, double seconds) {
    const double fps = reference.stepping.frames_per_second;
    trial_->frames = static_cast<std::uint64_t>(std::ceil((seconds > 0 ? seconds : 1) * fps * (1 - 1e-12)));
    simulation_.play(false);
    simulation_.restart(reference);
    simulation_.note([id = trial_->reference](timeline::Player& player) {
        name_new_run(player, "reference");
        *id = player.line();
    });
    // From its first frame on: the same run may be there already, with its playhead somewhere.
    simulation_.jump_to_start();
    trial_->reference_done = simulation_.step_frames(static_cast<int>(trial_->frames));
}

void ExperimentDesk::show_run(const sim::Description& run, const std::string& name) {
    simulation_.restart(run);
    simulation_.note([name](timeline::Player& player) { name_new_run(player, name); });
    simulation_.jump_to_start();
    simulation_.play(true);
}

void ExperimentDesk::follow_trial(const Published& now) {
    lab_.experiments.showing.clear();
    if (!trial_)
        return;
    if (now.done < trial_->reference_done) {
        lab_.experiments.showing = "Computing the reference: frame " + std::to_string(now.playhead.frame) + " of " +
                                   std::to_string(trial_->frames);
        return;
    }
    const Trial trial = *std::exchange(trial_, std::nullopt);
    if (now.playhead.moment.branch != *trial.reference || now.playing)
        return; // the user has gone elsewhere
    show_run(trial.run, trial.name);
    lab_.ask(ui::TimelineRequest(ui::ShowGhost{*trial.reference}));
    // As long as there is a reference to compare with, again and again.
    lab_.ask(ui::TimelineRequest(ui::SetLoop{timeline::FrameRange{0, trial.frames}}));
}

void ExperimentDesk::carry_out(const ui::SaveFindings& r) {
    const auto found = lab_.experiments.found[static_cast<std::size_t>(r.kind)];
    if (!found)
        return;
    if (!r.replace && is_there(r.file))
        return say(true, r.file.string() + ": this exists already; choose another name, or save and replace.");
    try {
        if (r.file.extension() == ".json") {
            if (!r.row || *r.row >= found->findings.settings.size())
                return say(true, "Click on the run whose parameters are to be saved as a scene first.");
            scene::Scene saved = experiments::with(found->scene, found->findings.settings[*r.row]);
            saved.name += " (" + name_of(found->findings.settings[*r.row]) + ")";
            relate_textures(saved.look, lab_.shaders, r.file.parent_path());
            scene::save_scene(saved, r.file);
        } else if (r.file.extension() == ".png") {
            const auto& charts = found->findings.charts;
            for (std::size_t i = 0; i < charts.size(); ++i)
                render::write_png(chart_picture(charts[i], 1200, 800), experiments::chart_file(r.file.string(), i));
        } else {
            scene::write_text_file(to_csv(found->findings.table), r.file);
        }
        say(false, "Saved as " + r.file.string());
    } catch (const std::exception& e) {
        say(true, e.what());
    }
}

void ExperimentDesk::carry_out(const ui::WriteReport& r) {
    if (!lab_.snapshot || !lab_.timeline.overview)
        return say(true, "There is no run to be written up yet.");
    if (!r.replace && is_there(r.folder / "report.html"))
        return say(true, (r.folder / "report.html").string() +
                             ": this exists already; choose another folder, or write and replace.");
    simulation_.play(false); // so that the picture, the numbers and the hash are of one state
    report_ = std::make_shared<Report>();
    report_->folder = r.folder;
    ask_for_hash();
}

} // namespace clothlab::app
