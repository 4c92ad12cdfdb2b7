// The experiments' side of the lab: carries out what their panel asks for, and tells it what there is.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/core/experiment_job.h"
#include "app/core/simulation_thread.h"
#include "render/renderer.h"
#include "ui/lab.h"

namespace clothlab::app {

class ExperimentDesk {
public:
    /// All must outlive this.
    ExperimentDesk(SimulationThread& simulation, render::Renderer& renderer, ui::Lab& lab);

    /// Before panels are drawn.
    void update(const Published& now);
    void carry_out(const ui::ExperimentRequest& request);
    /// Another scene is begun: a trial that was to be shown is not any more.
    void restart() { trial_.reset(); }
    /// Whether panels will have something new to show soon without the user's doing.
    bool expects_news() const { return lab_.experiments.job.has_value() || trial_.has_value() || report_ != nullptr; }

private:
    // A trial on its way into the viewport: its reference is computed first, so that there is a ghost to be drawn.
    struct Trial {
        sim::Description run;
        std::string name;
        std::uint64_t reference_done = 0; ///< ticket
        std::uint64_t frames = 0;         ///< of the reference
        std::shared_ptr<timeline::BranchId> reference = std::make_shared<timeline::BranchId>(0);
    };
    void carry_out(const ui::RunExperiment& r);
    void carry_out(const ui::CancelExperiment&) { job_.cancel(); }
    void carry_out(const ui::ShowTrial& r);
    void carry_out(const ui::SaveFindings& r);
    void carry_out(const ui::WriteReport& r);
    void show_reference(const sim::Description& reference, double seconds);
    void show_run(const sim::Description& run, const std::string& name);
    void take_results();
    void follow_trial(const Published& now);
    void say(bool error, std::string text) { lab_.messages.push_back({error, std::move(text)}); }

    SimulationThread& simulation_;
    render::Renderer& renderer_;
    ui::Lab& lab_;
    ExperimentJob job_;
    ui::ExperimentKind kind_ = ui::ExperimentKind::accuracy; ///< of the job
    ui::FoundOut of_;                                        ///< what the job's findings will be of
    std::optional<Trial> trial_;
    // A report that waits for what only the simulation's thread knows.
    struct Report {
        std::filesystem::path folder;
        std::uint64_t hash = 0, steps = 0; ///< of the state when the simulation's thread was asked
        std::atomic<bool> complete = false;
    };
    void ask_for_hash();
    void write_report();
    std::shared_ptr<Report> report_;
};

} // namespace clothlab::app
