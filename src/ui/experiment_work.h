// What the Experiments panel shows, and what it asks the app for.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "experiments/findings.h"
#include "scene/scene.h"
#include "ui/experiment_forms.h"

namespace clothlab::ui {

enum class ExperimentKind : std::uint8_t { accuracy, stability, needs, sweep };
inline constexpr std::size_t experiment_kinds = 4;
inline constexpr std::array<const char*, experiment_kinds> experiment_names{"accuracy", "stability", "needs", "sweep"};

/// An experiment with the present scene, in the background. Another one that is under way has to end first.
struct RunExperiment {
    ExperimentKind kind = ExperimentKind::accuracy;
    std::function<experiments::Findings(const experiments::Progress&)> work;
    std::string command; ///< that makes the same of a scene file called scene.json
};
struct CancelExperiment {};
/// Runs the setting of a row in the viewport, beside the run that it was compared with, which is drawn as a ghost.
struct ShowTrial {
    ExperimentKind kind = ExperimentKind::accuracy;
    std::size_t row = 0;
};
/// The table of an experiment as .csv, its charts as .png, or, as .json, the scene of a row.
struct SaveFindings {
    ExperimentKind kind = ExperimentKind::accuracy;
    std::filesystem::path file;
    bool replace = false;           ///< a file that is there already
    std::optional<std::size_t> row; ///< for .json
};
/// The session and its experiments: a folder with report.html, report.md and what they show.
struct WriteReport {
    std::filesystem::path folder;
    bool replace = false; ///< a report that is there already
};

using ExperimentRequest = std::variant<RunExperiment, CancelExperiment, ShowTrial, SaveFindings, WriteReport>;

/// What an experiment has found, and of what.
struct FoundOut {
    experiments::Findings findings;
    scene::Scene scene;
    std::string command;
};

/// Filled in by the app, but for what is said to be the panel's own.
struct ExperimentWork {
    std::array<std::shared_ptr<const FoundOut>, experiment_kinds> found; ///< null: not made yet
    std::array<std::string, experiment_kinds> refused; ///< why the last one could not be made; empty: it could
    struct Job {
        ExperimentKind kind = ExperimentKind::accuracy;
        double share = 0; ///< done, 0 to 1
        std::string what; ///< is done now
        double elapsed_s = 0;
    };
    std::optional<Job> job; ///< the experiment under way
    std::string showing;    ///< how far a ShowTrial is; empty: none is under way

    // The panel's own.
    ExperimentForms forms;
    std::optional<ExperimentKind> wanted;                              ///< its tab is to be selected
    std::array<std::optional<std::size_t>, experiment_kinds> marked{}; ///< the row that was clicked last
    std::array<int, experiment_kinds> chart{};                         ///< of several
    struct {
        bool report = false, save = false; ///< windows to be opened
        std::string folder, path;
        ExperimentKind kind = ExperimentKind::accuracy;
    } files;
};

} // namespace clothlab::ui
