// `clothlab experiment needs`.
#include "experiments/needs/needs.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "cli/experiment/experiment.h"
#include "cli/finite.h"
#include "scene/frames.h"
#include "scene/io.h"
#include "scene/whole_file.h"

namespace clothlab::cli {
namespace {

struct Arguments {
    SceneArguments scene;
    double seconds = 1, tolerance = 1;
    std::string quantity = "rms";
    bool at_end = false;
    int threads = 1;
    std::vector<std::string> kept;
    std::string save;
    FindingsOutput output;
};

experiments::needs::Config config_of(const Arguments& a) {
    experiments::needs::Config config;
    config.scene = a.scene.load();
    config.source = a.scene.scene;
    config.frames = scene::frames_of(a.seconds, config.scene.simulation);
    for (const experiments::needs::QuantityInfo& quantity : experiments::needs::quantities())
        if (quantity.name == a.quantity)
            config.quantity = quantity.id;
    config.tolerance = a.tolerance;
    config.at_end = a.at_end;
    config.threads = a.threads;
    config.kept = a.kept;
    return config;
}

int needs(const Arguments& a, const GuiCommands& gui) {
    const experiments::needs::Config config = config_of(a);
    if (!a.save.empty())
        scene::WholeFile{a.save};
    const auto experiment = [&](const experiments::Progress& progress) {
        experiments::needs::Result result = run_needs(config, progress);
        if (!a.save.empty()) {
            scene::save_scene(result.recommended, a.save);
            result.findings.notes.push_back("The recommended model is saved as " + a.save + ".");
        }
        return std::move(result.findings);
    };
    return conduct(experiment, config.scene, a.output, gui);
}

} // namespace

void add_needs(CLI::App& experiment, const GuiCommands& gui, int& status) {
    const auto a = std::make_shared<Arguments>();
    auto* app = experiment.add_subcommand("needs", "Find the cheapest model that is good enough for a scene");
    add_scene(*app, a->scene, true);
    app->add_option("--seconds", a->seconds, "Simulated seconds, rounded up to a whole frame (default: 1)")
        ->check(finite_positive);
    std::vector<std::string> names;
    for (const experiments::needs::QuantityInfo& quantity : experiments::needs::quantities())
        names.emplace_back(quantity.name);
    app->add_option(
           "--quantity", a->quantity,
           "What may change by no more than the tolerance: rms or largest distance of the points (mm; default: "
           "rms), drape height (mm), sag of the mean height (mm), first-contact with a collider (ms), energy (J)")
        ->check(CLI::IsMember(names));
    app->add_option("--tolerance", a->tolerance, "By how much, in the quantity's unit: mm, ms or J (default: 1)")
        ->check(finite_positive);
    app->add_flag("--at-end", a->at_end, "Compare at the end only, not over time");
    app->add_option("--threads", a->threads, "Threads that each run may use (default: 1)")->check(CLI::Range(1, 1024));
    app->add_option("--keep", a->kept,
                    "KEY: never change this parameter or section, such as simulation.precision, cloth.enable_bending, "
                    "wind or colliders; repeat for more")
        ->take_all()
        ->allow_extra_args(false);
    app->add_option("--save", a->save, "Write the recommended model to this scene file (.json)");
    add_output(*app, a->output);
    app->final_callback([a, &gui, &status] { status = needs(*a, gui); });
}

} // namespace clothlab::cli
