#include "app/session_report.h"

#include <cmath>
#include <cstdio>
#include <glad/gl.h>

#include "app/gui/chart_picture.h"
#include "app/picture_maker.h"
#include "app/scene_view.h"
#include "app/textures.h"
#include "scene/io.h"
#include "scene/number_text.h"
#include "sim/integrators/integrator.h"
#include "ui/change_text.h"

namespace clothlab::app {
namespace {

namespace fs = std::filesystem;
using experiments::ReportSection;
using experiments::Table;

constexpr int picture_width = 1280, picture_height = 800;
constexpr const char* viewport_file = "viewport.png";
constexpr const char* curves_name = "curves";

ReportSection state(const ui::Lab& lab) {
    const sim::Snapshot& s = *lab.snapshot;
    const sim::Diagnostics& d = s.diagnostics;
    ReportSection section{.title = "The cloth at frame " + std::to_string(s.frame) +
                                   (s.substep > 0 ? ", substep " + std::to_string(s.substep) : "")};
    char text[400];
    std::snprintf(
        text, sizeof text,
        "At %.6g s, after %llu steps of %.4g µs with %s: kinetic energy %.4g J, energy of the springs %.4g J, "
        "of gravity %.4g J, in all %.4g J; largest strain %.3g %%; root mean square speed %.3g m/s.",
        s.time, static_cast<unsigned long long>(s.steps), s.dt * 1e6,
        sim::traits(lab.scene.simulation.stepping.integrator).title.data(), d.energy.kinetic, d.energy.spring,
        d.energy.gravity, d.energy.total(), d.max_strain * 100, d.rms_speed);
    section.paragraphs.push_back(text);
    if (d.status != sim::Status::ok)
        section.paragraphs.push_back("The run is in trouble: " + d.cause + ".");
    section.pictures.push_back({viewport_file, "The viewport, drawn with the shader " + lab.scene.look.shader});
    return section;
}

/// The samples of the line shown, as the curves under the timeline have them.
Table samples(const timeline::Overview& overview) {
    Table table;
    table.columns = {{"frame", "Frame"},
                     {"time_s", "Time (s)"},
                     {"kinetic_J", "Kinetic energy (J)"},
                     {"spring_J", "Energy of the springs (J)"},
                     {"gravity_J", "Energy of gravity (J)"},
                     {"total_J", "Energy in all (J)"},
                     {"max_strain", "Largest strain"},
                     {"contacts", "Contacts with colliders"},
                     {"self_contacts", "Self-contacts"},
                     {"shortened_springs", "Springs shortened by the limit"}};
    for (const timeline::Sample& s : overview.samples)
        table.rows.push_back({static_cast<double>(s.frame), s.time, double{s.kinetic}, double{s.spring},
                              double{s.gravity}, double{s.total()}, double{s.max_strain}, double(s.contacts),
                              double(s.self_contacts), double(s.shortened_springs)});
    return table;
}

experiments::Series series(const Table& table, const char* column, const char* name, double factor = 1) {
    experiments::Series series{.name = name, .mark = experiments::Mark::line};
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        series.x.push_back(table.number(i, "time_s"));
        series.y.push_back(factor * table.number(i, column));
    }
    return series;
}

std::vector<experiments::Chart> curve_charts(const timeline::Overview& overview) {
    const Table table = samples(overview);
    const experiments::Axis time{"Time (s)"};
    return {{.title = "Energy",
             .x = time,
             .y = {"Energy (J)"},
             .series = {series(table, "kinetic_J", "kinetic"), series(table, "spring_J", "springs"),
                        series(table, "gravity_J", "gravity"), series(table, "total_J", "in all")}},
            {.title = "Largest strain",
             .x = time,
             .y = {"Strain (%)"},
             .series = {series(table, "max_strain", "largest strain", 100)}},
            {.title = "Contacts",
             .x = time,
             .y = {"Contacts, the most in a step of each frame"},
             .series = {series(table, "contacts", "with colliders"), series(table, "self_contacts", "with itself")}}};
}

ReportSection curves(const timeline::Overview& overview) {
    ReportSection section{.title = "Curves of the line shown"};
    std::size_t index = 0;
    for (const experiments::Chart& chart : curve_charts(overview))
        section.pictures.push_back({experiments::chart_file(std::string(curves_name) + ".png", index++), chart.title});
    section.notes = {std::string("The numbers, frame by frame, are in ") + curves_name + ".csv."};
    return section;
}

ReportSection moments(const timeline::Overview& overview) {
    ReportSection section{.title = "What happened"};
    Table table;
    table.columns = {{"frame", "Frame"}, {"kind", "What"}, {"text", "More"}};
    for (const timeline::ChangeInfo& c : overview.changes)
        table.rows.push_back({static_cast<double>(c.frame), "change", ui::describe_change(*c.before, *c.after, 8)});
    for (const timeline::MarkInfo& m : overview.marks)
        table.rows.push_back(
            {static_cast<double>(m.frame), timeline::mark_names[static_cast<std::size_t>(m.kind)], m.text});
    for (const timeline::Bookmark& b : overview.bookmarks)
        table.rows.push_back({static_cast<double>(b.frame), "bookmark", b.name});
    std::stable_sort(table.rows.begin(), table.rows.end(),
                     [](const auto& a, const auto& b) { return std::get<double>(a[0]) < std::get<double>(b[0]); });
    if (table.rows.empty())
        section.paragraphs.push_back("No parameter was changed, nothing was marked.");
    else
        section.table = std::move(table);
    if (overview.branches.size() > 1) {
        std::string names;
        for (const timeline::BranchInfo& b : overview.branches)
            names += (names.empty() ? "" : ", ") + b.name + " (to frame " + std::to_string(b.end_frame) + ")";
        section.paragraphs.push_back("The session's branches: " + names + ".");
    }
    return section;
}

ReportSection again(const ui::Lab& lab, std::uint64_t hash) {
    ReportSection section{.title = "How to get it again"};
    const sim::Snapshot& s = *lab.snapshot;
    const auto* driver = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    section.paragraphs = {
        "Made by " + experiments::program_version() + "; simulated with " +
            std::string(sim::instruction_sets()[static_cast<std::size_t>(s.instructions)].name) + " instructions on " +
            std::to_string(s.threads) + (s.threads == 1 ? " thread" : " threads") +
            " (the result is the same with any), drawn by " + (driver ? driver : "an unknown driver") + ".",
        "The hash of the state shown is " + scene::hash_text(hash) +
            ". The recording has the whole session with its branches, and goes on from any of its moments to the very "
            "same bits. The first command prints the hash; the second goes on for a second; the third opens the scene "
            "with the "
            "parameters above."};
    const int frames = static_cast<int>(std::lround(lab.scene.simulation.stepping.frames_per_second));
    section.commands = {std::string("clothlab run --resume ") + session_file + " --frames 0 --hash",
                        std::string("clothlab run --resume ") + session_file + " --frames " + std::to_string(frames),
                        "clothlab scene.json"};
    const timeline::Overview& o = *lab.timeline.overview;
    if (o.changes.empty() && s.substep == 0)
        section.commands.push_back("clothlab run scene.json --frames " + std::to_string(s.frame) + " --hash");
    return section;
}

void write_chart(const experiments::Chart& chart, const fs::path& file) {
    render::write_png(chart_picture(chart, picture_width, picture_height), file);
}

} // namespace

experiments::Report session_report(const ui::Lab& lab, std::uint64_t hash) {
    experiments::Report report;
    report.title = (lab.scene.name.empty() ? "A session" : lab.scene.name) + ": a session with clothlab";
    report.sections = {state(lab), curves(*lab.timeline.overview), moments(*lab.timeline.overview)};
    for (std::size_t i = 0; i < ui::experiment_kinds; ++i)
        if (const auto& found = lab.experiments.found[i])
            report.sections.push_back(section_of(found->findings, ui::experiment_names[i], found->command));
    report.sections.push_back(experiments::parameter_section(lab.scene, lab.loaded));
    report.sections.push_back(again(lab, hash));
    return report;
}

void write_session_report(const ui::Lab& lab, render::Renderer& renderer, std::uint64_t hash, const fs::path& folder) {
    fs::create_directories(folder);
    scene::Scene saved = lab.scene;
    relate_textures(saved.look, lab.shaders, folder);
    scene::save_scene(saved, folder / "scene.json");
    PictureMaker maker(renderer, picture_width, picture_height, samples_of(lab.scene.look.multisampling, 4), false);
    render::write_png(
        maker.draw(lab.scene, lab.shaders, lab.snapshot.get(), lab.timeline.ghost_snapshot.get(), trace_choice(lab)),
        folder / viewport_file);
    std::size_t index = 0;
    for (const experiments::Chart& chart : curve_charts(*lab.timeline.overview))
        write_chart(chart, folder / experiments::chart_file(std::string(curves_name) + ".png", index++));
    scene::write_text_file(to_csv(samples(*lab.timeline.overview)), folder / (std::string(curves_name) + ".csv"));
    for (std::size_t i = 0; i < ui::experiment_kinds; ++i) {
        const auto& found = lab.experiments.found[i];
        if (!found)
            continue;
        const std::string name = ui::experiment_names[i];
        scene::write_text_file(to_csv(found->findings.table), folder / (name + ".csv"));
        scene::save_scene(found->scene, folder / (name + "-scene.json"));
        for (std::size_t c = 0; c < found->findings.charts.size(); ++c)
            write_chart(found->findings.charts[c], folder / experiments::chart_file(name + ".png", c));
    }
    const experiments::Report report = session_report(lab, hash);
    scene::write_text_file(to_markdown(report), folder / "report.md");
    scene::write_text_file(to_html(report), folder / "report.html");
}

} // namespace clothlab::app
