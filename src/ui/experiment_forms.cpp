// The form of each experiment: what it lets be chosen, and the request and the command that this makes.
#include <algorithm>
#include <imgui.h>
#include <imgui_stdlib.h>
#include <thread>

#include "experiments/accuracy/accuracy.h"
#include "experiments/needs/needs.h"
#include "experiments/stability/bisection.h"
#include "experiments/stability/map.h"
#include "experiments/sweep/sweep.h"
#include "scene/frames.h"
#include "scene/number_text.h"
#include "sim/integrators/integrator.h"
#include "ui/experiment_rows.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

using experiments::Progress;
using Options = std::vector<std::string>;

int cores() {
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Above the settings, where it is seen however low the panel is.
bool run_button(bool enabled) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(ICON_FA_PLAY "  Run the experiment###run", {-ImGui::GetFontSize() * 0.5f, 0});
    ImGui::EndDisabled();
    tooltip(
        "With the scene as it is now, from its start. The lab goes on meanwhile; pause it where times are measured.");
    return pressed;
}

template <class Infos>
std::vector<std::string> titles_of(const Infos& infos) {
    std::vector<std::string> titles;
    for (const auto& info : infos)
        titles.emplace_back(info.title);
    return titles;
}

// --- accuracy --------------------------------------------------------------------------------------------------------

void method_choice(std::vector<bool>& chosen) {
    const auto methods = sim::integrators();
    const auto count = static_cast<std::size_t>(std::count(chosen.begin(), chosen.end(), true));
    form_label("Methods", "The integrators that are compared");
    if (!ImGui::BeginCombo("##methods", chosen.empty() ? "all" : (std::to_string(count) + " methods").c_str()))
        return;
    if (ImGui::Selectable("all", chosen.empty()))
        chosen.clear();
    for (std::size_t i = 0; i < methods.size(); ++i) {
        bool on = !chosen.empty() && chosen[i];
        if (ImGui::Checkbox(std::string(methods[i].title).c_str(), &on)) {
            chosen.resize(methods.size());
            chosen[i] = on;
        }
        tooltip(std::string(methods[i].help));
    }
    if (std::find(chosen.begin(), chosen.end(), true) == chosen.end())
        chosen.clear();
    ImGui::EndCombo();
}

std::vector<int> substeps_of(const AccuracyForm& f) {
    return experiments::spread_substeps(f.first_substeps, std::max(f.first_substeps + 1, f.last_substeps), f.steps);
}

RunExperiment accuracy_request(const Lab& lab) {
    const AccuracyForm& f = lab.experiments.forms.accuracy;
    experiments::AccuracyConfig config;
    config.scene = lab.scene;
    config.scene_name = lab.scene.name;
    config.seconds = f.seconds;
    config.quantity = experiments::error_quantities()[static_cast<std::size_t>(f.quantity)].id;
    config.substeps = substeps_of(f);
    config.budget = f.budget;
    config.rules = f.rules;
    Options options{"--seconds", scene::shortest_text(f.seconds), "--quantity",
                    experiments::error_quantities()[static_cast<std::size_t>(f.quantity)].name};
    std::string methods, substeps;
    for (std::size_t i = 0; i < f.methods.size(); ++i)
        if (f.methods[i]) {
            config.integrators.push_back(sim::integrators()[i].id);
            methods += (methods.empty() ? "" : ",") + std::string(sim::integrators()[i].name);
        }
    if (!methods.empty())
        options.insert(options.end(), {"--methods", methods});
    for (const int n : config.substeps)
        substeps += (substeps.empty() ? "" : ",") + std::to_string(n);
    options.insert(options.end(), {"--substeps", substeps, "--budget", scene::shortest_text(f.budget)});
    if (f.precisions == 1)
        config.precisions = {sim::Precision::single_precision};
    if (f.precisions == 2)
        config.precisions = {sim::Precision::double_precision};
    if (f.precisions != 0)
        options.insert(options.end(), {"--precisions", f.precisions == 1 ? "single" : "double"});
    config.threads = f.second_thread && cores() > 1 ? std::vector<int>{1, 2} : std::vector<int>{1};
    options.insert(options.end(), {"--threads", config.threads.size() > 1 ? "1,2" : "1"});
    if (f.rules)
        options.emplace_back("--rules");
    return experiment_request(ExperimentKind::accuracy, options,
                              [config](const Progress& progress) { return run_accuracy(config, progress); });
}

bool accuracy_form(Lab& lab, bool enabled) {
    AccuracyForm& f = lab.experiments.forms.accuracy;
    const bool run = run_button(enabled);
    form_number("Compare at (s)", "The simulated time at which the shapes are compared", f.seconds, 1e-3, "%.4g");
    form_choice("Error of", "What the chart is of; the table has all", f.quantity,
                titles_of(experiments::error_quantities()));
    method_choice(f.methods);
    form_whole("Substeps from", "The fewest steps per frame", f.first_substeps, 1, 100000);
    form_whole("Substeps to", "The most steps per frame", f.last_substeps, 2, 100000);
    form_whole("Step sizes", "How many, spread evenly in the logarithm", f.steps, 2, 100);
    form_choice("Precision", "In which the runs are computed", f.precisions, {"both", "single", "double"});
    form_number("At most (s)", "Wall seconds that one run may take; what would take longer is left out", f.budget, 0.01,
                "%.3g");
    ImGui::Checkbox("two threads as well", &f.second_thread);
    ImGui::SameLine();
    ImGui::Checkbox("rules", &f.rules);
    tooltip("Also the scene's own method with the course's version of one rule at a time");
    return run;
}

// --- stability -------------------------------------------------------------------------------------------------------

RunExperiment stability_request(const Lab& lab) {
    const StabilityForm& f = lab.experiments.forms.stability;
    if (f.bisect) {
        experiments::BisectionConfig config;
        config.scene = lab.scene;
        config.key = f.key;
        config.threads = cores();
        return experiment_request(ExperimentKind::stability, {"--bisect", f.key},
                                  [config](const Progress& progress) { return bisect_stability(config, progress); });
    }
    experiments::StabilityMapConfig config;
    config.scene = lab.scene;
    config.x = axis_text(f.x, false);
    config.y = axis_text(f.y, false);
    config.resolution = static_cast<std::size_t>(f.resolution);
    config.threads = cores();
    return experiment_request(ExperimentKind::stability,
                              {"-x", config.x, "-y", config.y, "--resolution", std::to_string(f.resolution)},
                              [config](const Progress& progress) { return map_stability(config, progress); });
}

bool stability_form(Lab& lab, bool enabled) {
    StabilityForm& f = lab.experiments.forms.stability;
    const bool run = run_button(enabled);
    int kind = f.bisect ? 1 : 0;
    form_choice("Find", "A map over two parameters, or the limit along one to 0.1 %", kind, {"a map", "the limit"});
    f.bisect = kind == 1;
    if (f.bisect) {
        AxisChoice axis;
        axis.key = f.key;
        form_axis_key(lab, "Along", axis, false);
        f.key = axis.key;
    } else {
        form_axis(lab, "Across", f.x, true, false);
        form_axis(lab, "Upwards", f.y, true, false);
        int resolution = f.resolution <= 16 ? 0 : f.resolution <= 32 ? 1 : 2;
        form_choice("Resolution", "Cells along an axis of numbers; only those along the border are run", resolution,
                    {"16 x 16", "32 x 32", "64 x 64"});
        f.resolution = 16 << resolution;
    }
    return run;
}

// --- needs -----------------------------------------------------------------------------------------------------------

RunExperiment needs_request(const Lab& lab) {
    const NeedsForm& f = lab.experiments.forms.needs;
    const auto& quantity = experiments::needs::quantities()[static_cast<std::size_t>(f.quantity)];
    experiments::needs::Config config;
    config.scene = lab.scene;
    config.source = lab.scene.name;
    config.quantity = quantity.id;
    config.tolerance = f.tolerance;
    config.at_end = f.at_end;
    config.threads = f.second_thread ? std::min(2, cores()) : 1;
    Options options{"--seconds",   scene::shortest_text(f.seconds),   "--quantity", std::string(quantity.name),
                    "--tolerance", scene::shortest_text(f.tolerance), "--threads",  std::to_string(config.threads)};
    if (f.at_end)
        options.emplace_back("--at-end");
    return experiment_request(ExperimentKind::needs, options,
                              [config, seconds = f.seconds](const Progress& progress) mutable {
                                  // Here, where what is wrong with it is told like everything else that is.
                                  config.frames = scene::frames_of(seconds, config.scene.simulation);
                                  return run_needs(config, progress).findings;
                              });
}

bool needs_form(Lab& lab, bool enabled) {
    NeedsForm& f = lab.experiments.forms.needs;
    const bool run = run_button(enabled);
    form_number("Simulate (s)", "The simulated time that counts", f.seconds, 1e-3, "%.4g");
    form_choice("What counts",
                "What may change by no more than the tolerance: shape (rms, largest), drape height, sag, "
                "time of the first contact, or energy",
                f.quantity, titles_of(experiments::needs::quantities()));
    const std::string unit(experiments::needs::quantities()[static_cast<std::size_t>(f.quantity)].unit);
    form_number(("Tolerance (" + unit + ")").c_str(), "By how much it may change", f.tolerance, 1e-9, "%.4g");
    ImGui::Checkbox("compare at the end only", &f.at_end);
    ImGui::Checkbox("two threads", &f.second_thread);
    return run;
}

// --- sweep -----------------------------------------------------------------------------------------------------------

RunExperiment sweep_request(const Lab& lab) {
    const SweepForm& f = lab.experiments.forms.sweep;
    experiments::SweepConfig config;
    config.name = lab.scene.name;
    config.scene = lab.scene;
    config.length.frames = static_cast<std::uint64_t>(f.frames);
    config.plot = f.plot;
    config.jobs = cores();
    Options options{"--vary", axis_text(f.first, true)};
    if (f.two)
        options.insert(options.end(), {"--vary", axis_text(f.second, true)});
    const Options axes(options);
    options.insert(options.end(), {"--frames", std::to_string(f.frames), "--plot", f.plot});
    return experiment_request(ExperimentKind::sweep, options, [config, axes](const Progress& progress) mutable {
        // Here, where what is wrong with an axis is told like everything else that is.
        for (std::size_t i = 1; i < axes.size(); i += 2)
            config.axes.push_back(experiments::parse_axis(axes[i]));
        return run_sweep(config, progress);
    });
}

bool sweep_form(Lab& lab, bool enabled) {
    SweepForm& f = lab.experiments.forms.sweep;
    const bool run = run_button(enabled);
    form_axis(lab, "Vary", f.first, false, true);
    ImGui::Checkbox("and", &f.two);
    tooltip("Vary a second parameter as well: every combination is run");
    if (f.two)
        form_axis(lab, "Vary also", f.second, false, true);
    form_whole("Frames", "Simulated frames of each run", f.frames, 1, 1'000'000);
    static const std::vector<experiments::Column> columns = experiments::cell_columns(false);
    form_label("Chart", "What is charted against the first parameter");
    if (ImGui::BeginCombo("##plot", f.plot.c_str())) {
        for (const experiments::Column& column : columns) {
            if (ImGui::Selectable(column.name.c_str(), column.name == f.plot))
                f.plot = column.name;
            tooltip(column.title);
        }
        ImGui::EndCombo();
    }
    return run;
}

} // namespace

std::optional<RunExperiment> experiment_form(Lab& lab, ExperimentKind kind, bool enabled) {
    switch (kind) {
    case ExperimentKind::accuracy:
        return accuracy_form(lab, enabled) ? std::optional(accuracy_request(lab)) : std::nullopt;
    case ExperimentKind::stability:
        return stability_form(lab, enabled) ? std::optional(stability_request(lab)) : std::nullopt;
    case ExperimentKind::needs:
        return needs_form(lab, enabled) ? std::optional(needs_request(lab)) : std::nullopt;
    case ExperimentKind::sweep:
        return sweep_form(lab, enabled) ? std::optional(sweep_request(lab)) : std::nullopt;
    }
    return {};
}

} // namespace clothlab::ui
