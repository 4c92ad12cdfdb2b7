#include "cli/experiment/experiment.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "cli/progress_bar.h"
#include "scene/io.h"
#include "scene/whole_file.h"

namespace clothlab::cli {
namespace {

using Json = nlohmann::ordered_json;
using experiments::Findings;

Json json_of(const experiments::Value& value) {
    if (const auto* number = std::get_if<double>(&value))
        return std::isfinite(*number) ? Json(*number) : Json();
    const auto* text = std::get_if<std::string>(&value);
    return text ? Json(*text) : Json();
}

Json json_of(const Findings& findings) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < findings.table.rows.size(); ++i) {
        Json row;
        for (std::size_t j = 0; j < findings.table.columns.size(); ++j)
            row[findings.table.columns[j].name] = json_of(findings.table.rows[i][j]);
        row["settings"] = findings.settings[i];
        rows.push_back(std::move(row));
    }
    return {{"title", findings.title},
            {"sentences", findings.sentences},
            {"notes", findings.notes},
            {"reference", findings.reference},
            {"rows", rows}};
}

void print(const Findings& findings) {
    std::cout << findings.title << "\n\n" << to_text(findings.table) << "\n";
    for (const std::string& sentence : findings.sentences)
        std::cout << sentence << "\n";
    for (const std::string& note : findings.notes)
        std::cout << "- " << note << "\n";
}

/// report.html, report.md and what they show.
void write_report(const Findings& findings, const scene::Scene& scene, const FindingsOutput& output,
                  const GuiCommands& gui, int width, int height) {
    const std::filesystem::path path(output.report);
    const std::string name = "findings";
    experiments::ReportSection section = section_of(findings, name, gui.command);
    if (gui.draw_chart)
        for (std::size_t i = 0; i < findings.charts.size(); ++i)
            gui.draw_chart(findings.charts[i], (path / section.pictures[i].file).string(), width, height);
    else
        section.pictures.clear();
    if (output.draw_for_report)
        for (experiments::ReportPicture& picture : output.draw_for_report(path))
            section.pictures.push_back(std::move(picture));
    scene::write_text_file(to_csv(findings.table), path / section.table_file);
    scene::save_scene(scene, path / "scene.json");
    section.notes.push_back("Made by " + experiments::program_version() + ".");
    const experiments::Report report{findings.title, {section, experiments::parameter_section(scene, scene)}};
    scene::write_text_file(to_markdown(report), path / "report.md");
    scene::write_text_file(to_html(report), path / "report.html");
}

} // namespace

void add_output(CLI::App& app, FindingsOutput& output) {
    app.add_option("--csv", output.csv, "Write the table to this file; - is standard output, and then nothing else is");
    app.add_option("--png", output.png, "Draw the chart into this file; further charts get -2, -3 ... in their names");
    app.add_option("--size", output.size, "WIDTHxHEIGHT of the pictures in pixels (default: 1200x800)");
    app.add_option("--report", output.report,
                   "Write it all up in this folder, made where it is missing: report.html and report.md, the charts, "
                   "the table, the scene and its parameters, the command");
    app.add_flag("--json", output.json, "Print everything as one JSON object");
}

int conduct(const std::function<Findings(const experiments::Progress&)>& experiment, const scene::Scene& scene,
            const FindingsOutput& output, const GuiCommands& gui) {
    if (output.csv == "-" && output.json)
        throw scene::SceneError("--csv -: standard output can hold the table or --json, not both");
    int width = 0, height = 0;
    read_size(output.size, width, height);
    if (!output.png.empty() && !gui.draw_chart)
        throw scene::SceneError("--png: this clothlab was built without its GUI and cannot draw");
    for (const std::string& file : {output.csv, output.png})
        if (!file.empty() && file != "-")
            scene::WholeFile{file};
    if (!output.report.empty()) {
        std::error_code error;
        std::filesystem::create_directories(output.report, error);
        scene::WholeFile{(std::filesystem::path(output.report) / "report.html").string()};
    }
    Findings findings;
    {
        ProgressBar bar(std::cerr, 1, isatty(STDERR_FILENO) != 0);
        const experiments::Progress progress{[&bar](double share, const std::string& what) {
            bar.show(share, what);
            return true;
        }};
        try {
            findings = experiment(progress);
        } catch (const experiments::Refusal& refusal) {
            throw scene::SceneError(refusal.what());
        }
    }
    if (output.csv == "-")
        std::cout << to_csv(findings.table);
    else if (output.json)
        std::cout << json_of(findings).dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
    else
        print(findings);
    if (!output.csv.empty() && output.csv != "-")
        scene::write_text_file(to_csv(findings.table), output.csv);
    if (!output.png.empty())
        for (std::size_t i = 0; i < findings.charts.size(); ++i)
            gui.draw_chart(findings.charts[i], experiments::chart_file(output.png, i), width, height);
    if (!output.report.empty())
        write_report(findings, scene, output, gui, width, height);
    return 0;
}

void add_experiments(CLI::App& app, const GuiCommands& gui, int& status) {
    auto* experiment = app.add_subcommand("experiment", "Measure what a scene's parameters and methods are worth");
    experiment->require_subcommand(1);
    add_accuracy(*experiment, gui, status);
    add_stability(*experiment, gui, status);
    add_needs(*experiment, gui, status);
    add_sweep(*experiment, gui, status);
}

} // namespace clothlab::cli
