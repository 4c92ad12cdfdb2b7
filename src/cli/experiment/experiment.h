// `clothlab experiment ...`: what its subcommands share. Each has a file of its own beside this one.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "experiments/findings.h"
#include "experiments/report.h"

namespace CLI {
class App;
}

namespace clothlab::cli {

/// Where findings go besides standard output.
struct FindingsOutput {
    std::string csv;               ///< the table; empty: nowhere
    std::string png;               ///< the chart; further ones get -2, -3 ... before the ending
    std::string size = "1200x800"; ///< of the pictures, in px
    std::string report;            ///< folder for a write-up; empty: none
    /// Draws pictures for the write-up into its folder; none where it is empty.
    std::function<std::vector<experiments::ReportPicture>(const std::filesystem::path& folder)> draw_for_report = {};
    bool json = false; ///< one object on standard output instead of text
};

void add_output(CLI::App& app, FindingsOutput& output);
/// The scene and --set, as every subcommand has them.
void add_scene(CLI::App& app, SceneArguments& arguments, bool required);

/// Runs an experiment on a scene with a progress bar on standard error, prints and writes what it found, and returns
/// the exit status. That an output cannot be written, or that there is no GUI to draw with, is said before the work.
/// Throws scene::SceneError; a Refusal becomes one.
int conduct(const std::function<experiments::Findings(const experiments::Progress&)>& experiment,
            const scene::Scene& scene, const FindingsOutput& output, const GuiCommands& gui);

/// Adds `experiment` with all its subcommands, each of which sets `status` when it has run.
void add_experiments(CLI::App& app, const GuiCommands& gui, int& status);

// One each, called by add_experiments. `gui` and `status` outlive the parsing.
void add_accuracy(CLI::App& experiment, const GuiCommands& gui, int& status);
void add_stability(CLI::App& experiment, const GuiCommands& gui, int& status);
void add_needs(CLI::App& experiment, const GuiCommands& gui, int& status);
void add_sweep(CLI::App& experiment, const GuiCommands& gui, int& status);

} // namespace clothlab::cli
