// `clothlab experiment stability`: a map over two parameters, or the limit along one.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "cli/experiment/experiment.h"
#include "cli/finite.h"
#include "experiments/run_parallel.h"
#include "experiments/stability/bisection.h"
#include "experiments/stability/map.h"
#include "scene/io.h"

namespace clothlab::cli {
namespace {

using experiments::Progress;

struct StabilityArguments {
    SceneArguments scene{"two-pins", {}};
    std::string x, y, bisect;
    std::optional<double> from, to;
    double precision = 0.1; ///< percent
    std::optional<int> frames;
    std::optional<double> seconds;
    int resolution = 64;
    int threads = 0; ///< 0: one for each core
    FindingsOutput output;
};

int stability(const StabilityArguments& a, const GuiCommands& gui) {
    experiments::JudgeConfig judge;
    if (a.frames)
        judge.frames = static_cast<std::uint64_t>(*a.frames);
    judge.seconds = a.seconds;
    const int threads = a.threads > 0 ? a.threads : experiments::all_cores();
    if (a.bisect.empty()) {
        if (a.from || a.to)
            throw scene::SceneError("--from and --to are the range of --bisect");
        experiments::StabilityMapConfig config;
        config.scene = a.scene.load();
        config.resolution = static_cast<std::size_t>(a.resolution);
        config.judge = judge;
        config.threads = threads;
        if (!a.x.empty())
            config.x = a.x;
        if (!a.y.empty())
            config.y = a.y;
        return conduct([&](const Progress& progress) { return map_stability(config, progress); }, config.scene,
                       a.output, gui);
    }
    experiments::BisectionConfig config;
    config.scene = a.scene.load();
    config.key = a.bisect;
    config.from = a.from;
    config.to = a.to;
    config.precision = 0.01 * a.precision;
    config.judge = judge;
    config.threads = threads;
    return conduct([&](const Progress& progress) { return bisect_stability(config, progress); }, config.scene, a.output,
                   gui);
}

} // namespace

void add_stability(CLI::App& experiment, const GuiCommands& gui, int& status) {
    auto arguments = std::make_shared<StabilityArguments>();
    StabilityArguments& a = *arguments;
    auto* app = experiment.add_subcommand("stability", "Find where methods fail, and compare with the predicted limit");
    add_scene(*app, a.scene, false);
    const std::string axis =
        "KEY=FROM:TO[:COUNT][log], KEY=VALUE,VALUE,... or, of choices, KEY: a key of `clothlab list parameters` (ks "
        "for cloth.ks), or "
        "springs (all, structural, structural+shear, ...), grid (points a side), damping (by the scene's rule), "
        "limiter, "
        "method";
    auto* x = app->add_option(
        "-x,--x", a.x, "What the map varies from left to right: " + axis + " (default: simulation.substeps=8:64)");
    auto* y = app->add_option(
        "-y,--y", a.y, "What it varies from bottom to top, written likewise (default: cloth.ks=1e4:1e6log, N/m)");
    app->add_option("--resolution", a.resolution, "Values of an axis of numbers that has no COUNT (default: 64)")
        ->check(CLI::Range(2, 1025));
    app->add_option("--bisect", a.bisect,
                    "Instead of a map, find the limit along this key, in the key's unit; damping and grid too")
        ->excludes(x)
        ->excludes(y);
    app->add_option("--from", a.from, "Where --bisect begins (default: as predicted)")->check(finite);
    app->add_option("--to", a.to, "Where --bisect ends (default: as predicted)")->check(finite);
    app->add_option("--precision", a.precision,
                    "How exact --bisect is, in percent of the value (default: 0.1); whole numbers are found to 1")
        ->check(CLI::Range(1e-6, 50.0))
        ->check(finite);
    auto* frames = app->add_option("--frames", a.frames,
                                   "Frames after which a run without trouble is stable (default: those of 1 s, and of "
                                   "3000 steps)")
                       ->check(CLI::PositiveNumber);
    app->add_option("--seconds", a.seconds, "Simulated seconds instead, rounded up to a whole frame")
        ->check(finite_positive)
        ->excludes(frames);
    app->add_option("--threads", a.threads,
                    "Runs at the same time (default: one for each core). The result is the same for any number")
        ->check(CLI::Range(1, 1024));
    add_output(*app, a.output);
    app->final_callback([arguments, &gui, &status] { status = stability(*arguments, gui); });
}

} // namespace clothlab::cli
