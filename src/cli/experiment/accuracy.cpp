// `clothlab experiment accuracy`.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <memory>

#include "cli/experiment/experiment.h"
#include "cli/finite.h"
#include "experiments/accuracy/accuracy.h"
#include "scene/error.h"

namespace clothlab::cli {
namespace {

using experiments::AccuracyConfig;

struct AccuracyArguments {
    SceneArguments scene;
    FindingsOutput output;
    AccuracyConfig config;
    std::vector<std::string> methods, precisions;
    std::string substeps, quantity = "rms";
};

std::vector<int> whole_numbers(const std::string& text, char separator) {
    std::vector<int> numbers;
    std::size_t begin = 0;
    for (;;) {
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        int number = 0;
        const auto [stopped, error] = std::from_chars(text.data() + begin, text.data() + end, number);
        if (error != std::errc() || stopped != text.data() + end || number < 1 || number > 100000)
            throw scene::SceneError(
                "--substeps " + text +
                ": write whole numbers from 1 to 100000 as 1,2,4, or FROM:TO:COUNT, spread evenly in "
                "the logarithm");
        numbers.push_back(number);
        if (end == text.size())
            return numbers;
        begin = end + 1;
    }
}

/// "1,2,4" or "1:1024:11".
std::vector<int> read_substeps(const std::string& text) {
    if (text.empty())
        return {};
    if (text.find(':') == std::string::npos)
        return whole_numbers(text, ',');
    const std::vector<int> range = whole_numbers(text, ':');
    if (range.size() != 3 || range[2] < 2 || range[0] >= range[1])
        throw scene::SceneError("--substeps " + text +
                                ": write FROM:TO:COUNT, with FROM below TO and COUNT at least 2");
    return experiments::spread_substeps(range[0], range[1], range[2]);
}

int run(AccuracyArguments& a, const GuiCommands& gui) {
    AccuracyConfig& config = a.config;
    config.scene = a.scene.load();
    config.scene_name = config.scene.name.empty() ? a.scene.scene : config.scene.name;
    config.substeps = read_substeps(a.substeps);
    for (const sim::IntegratorInfo& method : sim::integrators())
        if (std::find(a.methods.begin(), a.methods.end(), method.name) != a.methods.end())
            config.integrators.push_back(method.id);
    if (!a.precisions.empty()) {
        config.precisions.clear();
        for (const std::string& name : a.precisions)
            config.precisions.push_back(name == "single" ? sim::Precision::single_precision
                                                         : sim::Precision::double_precision);
    }
    for (const experiments::ErrorQuantityInfo& quantity : experiments::error_quantities())
        if (a.quantity == quantity.name)
            config.quantity = quantity.id;
    return conduct([&](const experiments::Progress& progress) { return run_accuracy(config, progress); }, config.scene,
                   a.output, gui);
}

} // namespace

void add_accuracy(CLI::App& experiment, const GuiCommands& gui, int& status) {
    const auto arguments = std::make_shared<AccuracyArguments>();
    AccuracyArguments& a = *arguments;
    auto* accuracy = experiment.add_subcommand(
        "accuracy", "Measure how far every method is off at many steps, against what a simulated second costs");
    add_scene(*accuracy, a.scene, true);
    accuracy
        ->add_option("--seconds", a.config.seconds, "Simulated seconds after which shapes are compared (default: 0.5)")
        ->check(finite_positive);
    std::vector<std::string> methods, names;
    for (const sim::IntegratorInfo& method : sim::integrators())
        methods.emplace_back(method.name);
    accuracy->add_option("--methods", a.methods, "Integrators, separated by commas (default: all)")
        ->delimiter(',')
        ->check(CLI::IsMember(methods));
    accuracy->add_option("--substeps", a.substeps,
                         "Steps per frame: 1,2,4, or FROM:TO:COUNT, spread evenly in the logarithm (default: 1,2,4 ... "
                         "1024)");
    accuracy->add_option("--precisions", a.precisions, "single, double or both, separated by a comma (default: both)")
        ->delimiter(',')
        ->check(CLI::IsMember({"single", "double"}));
    accuracy->add_option("--threads", a.config.threads, "Threads that are timed, separated by commas (default: 1,2)")
        ->delimiter(',')
        ->check(CLI::Range(1, 1024));
    accuracy->add_flag("--rules", a.config.rules,
                       "Also the scene's own method with the course's version of one rule at a time");
    std::string help = "The error that the chart, the slopes and the front are of (default: rms). ";
    for (const experiments::ErrorQuantityInfo& quantity : experiments::error_quantities()) {
        names.emplace_back(quantity.name);
        help += std::string(names.size() > 1 ? "; " : "") + quantity.name + ": " + quantity.help;
    }
    accuracy->add_option("--quantity", a.quantity, help)->check(CLI::IsMember(names));
    accuracy
        ->add_option("--tolerance", a.config.tolerances,
                     "Errors within which the cheapest run is named, in the quantity's unit, separated by commas "
                     "(default: 10,1,0.1,0.01)")
        ->delimiter(',')
        ->check(finite_positive);
    accuracy
        ->add_option("--rounds", a.config.rounds,
                     "Rounds in which all runs are timed by turns (default: 3); 0: no times")
        ->check(CLI::Range(0, 1000));
    accuracy
        ->add_option("--budget", a.config.budget,
                     "Seconds of processor time that one run to the end may take; what would take longer is left out "
                     "(default: 2)")
        ->check(finite_positive);
    add_output(*accuracy, a.output);
    accuracy->final_callback([arguments, &gui, &status] { status = run(*arguments, gui); });
}

} // namespace clothlab::cli
