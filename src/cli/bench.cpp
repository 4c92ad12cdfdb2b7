// `clothlab bench`: what a step costs, against the textbook's algorithm and against what the machine can do.
#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/core/data_folder.h"
#include "cli/command_line.h"
#include "experiments/bench/bench.h"
#include "scene/io.h"

namespace clothlab::cli {
namespace {

using Json = nlohmann::ordered_json;
using experiments::BenchGroup;
using experiments::BenchRow;
using experiments::BenchTable;
using experiments::Measured;

const char* name_of(sim::Precision precision) {
    return precision == sim::Precision::single_precision ? "single" : "double";
}

// --- JSON ------------------------------------------------------------------------------------------------------------

Json json_of(const std::optional<double>& value) {
    return value ? Json(*value) : Json();
}

Json json_of(const Measured& seconds) {
    return {{"median", seconds.median * 1e6}, {"min", seconds.min * 1e6}, {"max", seconds.max * 1e6}};
}

Json json_of(const experiments::MachinePeak& machine) {
    Json levels = Json::array(), peaks = Json::array();
    for (const experiments::MemoryLevel& level : machine.levels)
        levels.push_back({{"name", level.name},
                          {"bytes", level.capacity > 0 ? Json(level.capacity) : Json()},
                          {"per_core", level.per_core}});
    for (const experiments::ThreadPeak& peak : machine.by_threads) {
        Json bandwidth;
        for (std::size_t i = 0; i < peak.bandwidth.size(); ++i)
            bandwidth[machine.levels[i].name] = peak.bandwidth[i];
        peaks.push_back({{"threads", peak.threads},
                         {"fma_gflops_single", peak.single_gflops},
                         {"fma_gflops_double", peak.double_gflops},
                         {"bandwidth_gb_per_s", bandwidth}});
    }
    return {{"processor", machine.processor},
            {"hardware_threads", machine.hardware_threads},
            {"steadiness", machine.steadiness},
            {"clock_ghz", machine.clock_ghz > 0 ? Json(machine.clock_ghz) : Json()},
            {"vectors", machine.vectors},
            {"memory", levels},
            {"peaks", peaks}};
}

Json json_of(const BenchGroup& group, const BenchRow& row) {
    Json stages;
    for (std::size_t i = 0; i < row.stages.size(); ++i)
        stages[sim::stage_names[i]] = json_of(row.stages[i]);
    return {{"case", group.name},
            {"n", group.n},
            {"points", group.points},
            {"springs", group.springs},
            {"frames_before", group.frames},
            {"points_per_cell", group.points_per_cell},
            {"precision", name_of(row.precision)},
            {"kernel", row.kernel},
            {"threads", row.threads},
            {"rounds", row.rounds},
            {"rounds_alone", row.alone},
            {"disturbed", row.disturbed},
            {"steps_per_round", row.steps},
            {"step_us", json_of(row.step)},
            {"spread_percent", row.step.spread() * 100},
            {"steps_per_s", row.steps_per_s()},
            {"ns_per_point", row.ns_per_point},
            {"speedup", row.speedup},
            {"handout_speedup", json_of(row.handout_speedup)},
            {"forces_and_verlet_us", json_of(row.forces_and_verlet)},
            {"forces_and_verlet_speedup", row.forces_speedup},
            {"forces_and_verlet_to_pinned_textbook_step", json_of(row.forces_to_full_step)},
            {"forces_and_verlet_to_pinned_handout_step", json_of(row.forces_to_handout)},
            {"springs_per_s", row.springs_per_s},
            {"cycles_per_spring", json_of(row.cycles_per_spring)},
            {"fma_peak_percent", row.fma_share * 100},
            {"bandwidth_percent", row.bandwidth_share * 100},
            {"bandwidth_level", row.bandwidth_level},
            {"stage_us", stages},
            {"self_contacts_per_point", row.self_contacts},
            {"contacts_per_point", row.contacts},
            {"shortened_springs_per_point", row.shortened_springs},
            {"bytes_per_point", row.bytes_per_point}};
}

Json json_of(const BenchTable& table) {
    Json rows = Json::array(), summary = Json::array();
    for (const BenchGroup& group : table.groups)
        for (const BenchRow& row : group.rows)
            rows.push_back(json_of(group, row));
    for (const experiments::BenchFigure& figure : table.summary)
        summary.push_back({{"name", figure.name},
                           {"value", figure.value},
                           {"fastest_rounds", figure.fastest},
                           {"unit", figure.unit},
                           {"disturbed", figure.disturbed},
                           {"at_least", json_of(figure.at_least)},
                           {"at_most", json_of(figure.at_most)},
                           {"aim", json_of(figure.aim)}});
    return {
        {"machine", json_of(table.machine)}, {"best_kernel", table.best_kernel}, {"rows", rows}, {"summary", summary}};
}

// --- text, no wider than 120 columns ---------------------------------------------------------------------------------

std::string text(const char* format, auto... values) {
    char line[256];
    std::snprintf(line, sizeof line, format, values...);
    return line;
}

std::string bytes_text(std::size_t bytes) {
    const double kib = static_cast<double>(bytes) / 1024;
    return kib < 1024 ? text("%.0f KiB", kib) : text("%.3g MiB", kib / 1024);
}

void print(const experiments::MachinePeak& machine) {
    std::cout << (machine.processor.empty() ? "unknown processor" : machine.processor) << ", "
              << text("%d hardware threads, %.2f GHz, vectors %s\n\n", machine.hardware_threads, machine.clock_ghz,
                      machine.vectors.c_str());
    std::string header = "measured peaks   FMA GFLOP/s: single   double   y = s y + x, GB/s in:";
    for (const experiments::MemoryLevel& level : machine.levels)
        header += text(" %11s", (level.name + (level.capacity > 0 ? " " + bytes_text(level.capacity) : "")).c_str());
    std::cout << header << "\n";
    for (const experiments::ThreadPeak& peak : machine.by_threads) {
        std::string line = text("%4d thread%-6s %19.0f %8.0f %23s", peak.threads, peak.threads == 1 ? "" : "s",
                                peak.single_gflops, peak.double_gflops, "");
        for (const double bandwidth : peak.bandwidth)
            line += text(" %11.0f", bandwidth);
        std::cout << line << "\n";
    }
}

/// A line of the table of runs.
std::string cells(const std::array<std::string, 16>& c) {
    static constexpr std::array widths{-9, -7, 2, 10, 5, 6, 10, 6, 9, 8, 9, 8, 6, 5, 6, 7};
    std::string line;
    for (std::size_t i = 0; i < c.size(); ++i)
        line += text("%*s", widths[i], c[i].c_str());
    return line;
}

void print(const BenchGroup& group) {
    std::cout << text("\n%s, %d x %d points, %zu springs, from frame %d on, %.1f points per cell\n", group.name.c_str(),
                      group.n, group.n, group.springs, group.frames, group.points_per_cell)
              << cells({"", "", "", "step", "", "", "forces,", "", "self-", "colli-", "stretch", "cycles/", "ns/", "B/",
                        "% of", "% of"})
              << "\n"
              << cells({"kernel", "prec.", "th", "us", "+-%", "ratio", "Verlet us", "ratio", "coll. us", "ders us",
                        "limit us", "spring", "point", "pt", "FMA", "bandw."})
              << "\n";
    for (const BenchRow& row : group.rows) {
        const auto us = [](const Measured& seconds) { return text("%.1f", seconds.median * 1e6); };
        const auto stage = [&](sim::Stage s) { return us(row.stages[static_cast<std::size_t>(s)]); };
        std::cout << cells({row.kernel, name_of(row.precision), std::to_string(row.threads), us(row.step),
                            text("%.0f%s", row.step.spread() * 50, row.disturbed ? "*" : ""), text("%.1f", row.speedup),
                            us(row.forces_and_verlet), text("%.1f", row.forces_speedup),
                            stage(sim::Stage::self_collision), stage(sim::Stage::colliders), stage(sim::Stage::limit),
                            row.cycles_per_spring ? text("%.2f", *row.cycles_per_spring) : "-",
                            text("%.1f", row.ns_per_point), text("%.0f", row.bytes_per_point),
                            text("%.1f", row.fma_share * 100), text("%.1f", row.bandwidth_share * 100)})
                  << " " << row.bandwidth_level << "\n";
    }
}

/// How the cost of a point grows with the size, for the textbook and for what a user gets.
void print_growth(const BenchTable& table) {
    std::vector<int> sizes;
    std::vector<std::string> names; // CASE KERNEL PRECISION THREADS
    std::vector<std::vector<std::string>> cells;
    for (const BenchGroup& group : table.groups) {
        if (std::find(sizes.begin(), sizes.end(), group.n) == sizes.end())
            sizes.push_back(group.n);
        const auto column = static_cast<std::size_t>(std::find(sizes.begin(), sizes.end(), group.n) - sizes.begin());
        for (const BenchRow& row : group.rows) {
            if (row.kernel != table.best_kernel && row.kernel != experiments::textbook_name &&
                row.kernel != experiments::handout_name)
                continue;
            const std::string name =
                text("%-14s %-9s %-7s %d", group.name.c_str(), row.kernel.c_str(), name_of(row.precision), row.threads);
            const auto found = std::find(names.begin(), names.end(), name);
            const auto line = static_cast<std::size_t>(found - names.begin());
            if (found == names.end()) {
                names.push_back(name);
                cells.emplace_back();
            }
            cells[line].resize(std::max(cells[line].size(), column + 1));
            cells[line][column] = text("%.1f", row.ns_per_point);
        }
    }
    std::cout << "\nns per point of a full step\n" << text("%-34s", "case           kernel    prec.   thr.");
    for (const int n : sizes)
        std::cout << text(" %9s", (std::to_string(n) + "^2").c_str());
    for (std::size_t i = 0; i < names.size(); ++i) {
        std::cout << text("\n%-36s", names[i].c_str());
        for (const std::string& cell : cells[i])
            std::cout << text(" %9s", cell.c_str());
    }
    std::cout << "\n";
}

void print_summary(const BenchTable& table) {
    if (table.summary.empty())
        return;
    std::cout << "\nsummary of the kernel " << table.best_kernel
              << ": by the median rounds, and by the fastest, which other work on the machine disturbs least\n";
    const auto number = [](double value) { return text("%7.*f", value < 100 ? 1 : 0, value); };
    for (const experiments::BenchFigure& figure : table.summary) {
        std::string wanted;
        if (figure.at_least)
            wanted = text(", at least %g", *figure.at_least);
        if (figure.at_most)
            wanted = text(", at most %g", *figure.at_most);
        if (figure.aim)
            wanted += text(", aim %g", *figure.aim);
        std::cout << text("%-83s", figure.name.c_str()) << number(figure.value) << number(figure.fastest)
                  << text(" %s%s%s\n", figure.unit.c_str(), figure.disturbed ? "*" : "", wanted.c_str());
    }
}

/// How many of the rounds count.
void print_rounds(const BenchTable& table) {
    int rounds = 0, alone = 0;
    bool disturbed = false;
    for (const BenchGroup& group : table.groups) {
        for (const BenchRow& row : group.rows) {
            rounds += row.rounds;
            alone += row.alone;
            disturbed |= row.disturbed;
        }
    }
    std::cout << text("\nIn %d of %d rounds other work shared the cores, as an integer loop before and after noticed: "
                      "they do not count%s.\n",
                      rounds - alone, rounds,
                      disturbed ? ",\nbut, marked *, where too few are left, the best of them" : "");
}

/// Says so when times mean little, since other work took cores away from them.
void warn_of_load(const experiments::MachinePeak& machine) {
    const auto say = [](const std::string& what) {
        std::cerr << "clothlab bench: " << what << ": something else ran on this machine, or threads share its cores\n";
    };
    if (machine.steadiness < 0.85)
        say(text("from pass to pass, the peaks differ by %.0f %%", 100 * (1 - machine.steadiness)));
    for (const experiments::ThreadPeak& peak : machine.by_threads)
        if (const double times = peak.single_gflops / machine.with(1).single_gflops; times < 0.75 * peak.threads)
            say(text("%d threads reached only %.1f times the peak of one", peak.threads, times));
}

} // namespace

int bench(const BenchArguments& arguments) {
    const auto ascending = [](std::vector<int> values) {
        std::sort(values.begin(), values.end());
        values.erase(std::unique(values.begin(), values.end()), values.end());
        return values;
    };
    experiments::BenchConfig config;
    config.pinned = scene::load_scene(app::scene_path("two-pins")).simulation;
    config.falling = scene::load_scene(app::scene_path("self-collision")).simulation;
    config.sizes = ascending(arguments.sizes);
    if (config.sizes.empty())
        config.sizes = arguments.quick ? std::vector{50, 100} : std::vector{25, 50, 100, 256, 512, 1024};
    config.threads = ascending(arguments.threads);
    if (config.threads.empty())
        config.threads = std::thread::hardware_concurrency() > 1 ? std::vector{1, 2} : std::vector{1};
    config.filter = arguments.filter;
    config.quick = arguments.quick;
    config.progress = [](const std::string& what) { std::cerr << "clothlab bench: " << what << std::endl; };

    BenchTable table;
    try {
        table = experiments::run_bench(config);
    } catch (const experiments::BenchFilterError& e) {
        throw scene::SceneError(std::string("--filter: ") + e.what());
    }
    warn_of_load(table.machine);
    if (arguments.json) {
        std::cout << json_of(table).dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
        return 0;
    }
    print(table.machine);
    for (const BenchGroup& group : table.groups)
        print(group);
    print_rounds(table);
    print_growth(table);
    print_summary(table);
    return 0;
}

} // namespace clothlab::cli
