// Maps of stability: their boundary is that of the full grid, whoever computes it, and near the predicted one.
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <map>
#include <set>

#include "experiments/stability/map.h"
#include "experiments/trial.h"

using namespace clothlab;
using namespace clothlab::experiments;

namespace {

/// A cloth of 3 x 3 points that hangs from two of them, and runs of 25 frames.
StabilityMapConfig tiny_map() {
    StabilityMapConfig config;
    config.scene = with(scene::Scene{}, {"name=Tiny", "cloth.num_width_points=3", "cloth.num_height_points=3",
                                         "cloth.pinned=[[0,0],[2,0]]", "rules.self_collision=none"});
    config.x = "simulation.substeps=2:14";
    config.y = "cloth.ks=1e5:1e8:24log";
    config.judge.frames = 25;
    return config;
}

/// Verdicts by the settings of runs.
std::map<Settings, std::string> verdicts(const Findings& findings) {
    std::map<Settings, std::string> result;
    for (std::size_t row = 0; row < findings.table.rows.size(); ++row)
        result[findings.settings[row]] = findings.table.text(row, "verdict");
    return result;
}

/// The kind of the cell that a place of the chart lies in.
std::string kind_at(const Chart& chart, double x, double y) {
    for (const Cell& cell : chart.cells)
        if (x > cell.x0 && x < cell.x1 && y > cell.y0 && y < cell.y1)
            return chart.cell_kinds[cell.kind].name;
    return "nothing";
}

} // namespace

TEST_CASE("The map's boundary of stable runs is that of the full grid, cell by cell") {
    StabilityMapConfig config = tiny_map();
    const Findings refined = map_stability(config, {});
    config.blocks = 1000;
    const Findings full = map_stability(config, {});
    REQUIRE(full.table.rows.size() == 13 * 24);
    REQUIRE(refined.table.rows.size() < full.table.rows.size());
    const auto all = verdicts(full);
    std::set<std::string> kinds;
    for (const auto& [settings, verdict] : all)
        kinds.insert(verdict);
    REQUIRE(kinds.size() >= 2);
    for (const auto& [settings, verdict] : verdicts(refined))
        REQUIRE(all.at(settings) == verdict);
    for (std::size_t row = 0; row < full.table.rows.size(); ++row) {
        const double x = full.table.number(row, "substeps_per_frame"), y = full.table.number(row, "ks_n_m");
        INFO(x << " substeps, ks " << y);
        REQUIRE((kind_at(refined.charts[0], x, y) == "stable") == (full.table.text(row, "verdict") == "stable"));
        REQUIRE(kind_at(full.charts[0], x, y) == full.table.text(row, "verdict"));
    }
}

TEST_CASE("At 64 x 64 the boundary takes a fifth of the full grid's runs or less, and is the predicted one to a cell") {
    StabilityMapConfig config = tiny_map();
    config.x = "cloth.density=20:400:64log";
    config.y = "cloth.ks=1e5:2e7:64log";
    config.scene = with(config.scene, {"simulation.substeps=5"});
    config.judge.frames = 20;
    const Findings findings = map_stability(config, {});
    REQUIRE(5 * findings.table.rows.size() <= 64 * 64);
    std::size_t points = 0;
    for (std::size_t row = 0; row < findings.table.rows.size(); ++row) {
        const double distance = findings.table.number(row, "distance_percent");
        if (!std::isfinite(distance))
            continue;
        ++points;
        INFO(findings.table.number(row, "density_kg_m2"));
        REQUIRE(std::abs(distance) < 1.5 * 2 * findings.table.number(row, "half_cell_percent"));
        REQUIRE(findings.table.text(row, "verdict") == "stable");
    }
    REQUIRE(points >= 60);
}

TEST_CASE("A map does not depend on the number of threads", "[threads]") {
    StabilityMapConfig config = tiny_map();
    config.x = "simulation.substeps=2:14:5";
    config.y = "cloth.ks=1e5:1e8:9log";
    const Findings one = map_stability(config, {});
    config.threads = 3;
    const Findings three = map_stability(config, {});
    REQUIRE(one.settings == three.settings);
    REQUIRE(to_csv(one.table) == to_csv(three.table));
    REQUIRE(one.sentences == three.sentences);
}

TEST_CASE("Settings of a row make its run, and cells can be clicked") {
    StabilityMapConfig config = tiny_map();
    config.x = "method=course-verlet,rk4,backward-euler";
    config.y = "cloth.ks=1e7:1e9:12log";
    const Findings findings = map_stability(config, {});
    REQUIRE(findings.settings.size() == findings.table.rows.size());
    for (const std::size_t row : {std::size_t{0}, findings.table.rows.size() - 1}) {
        const sim::Description description = with(config.scene, findings.settings[row]).simulation;
        const Judged again = judge(description, config.judge, [] {});
        REQUIRE(verdict_names[static_cast<std::size_t>(again.verdict)] == findings.table.text(row, "verdict"));
    }
    const Chart& chart = findings.charts[0];
    REQUIRE(chart.x.names == std::vector<std::string>{"course-verlet", "rk4", "backward-euler"});
    for (const Cell& cell : chart.cells) {
        REQUIRE(cell.row < findings.table.rows.size());
        REQUIRE(chart.cell_kinds[cell.kind].name == findings.table.text(cell.row, "verdict"));
    }
    // RK4 holds twice as stiff springs as Verlet, backward Euler any.
    std::map<std::string, double> stiffest;
    for (std::size_t row = 0; row < findings.table.rows.size(); ++row)
        if (findings.table.text(row, "verdict") == "stable") {
            double& ks = stiffest[findings.table.text(row, "integrator")];
            ks = std::max(ks, findings.table.number(row, "ks_n_m"));
        }
    REQUIRE(stiffest["course-verlet"] < stiffest["rk4"]);
    REQUIRE(stiffest["rk4"] < 5e8);
    REQUIRE(stiffest["backward-euler"] > 9.9e8);
    std::size_t dashed = 0;
    for (const Series& series : chart.series)
        dashed += series.mark == Mark::dashed ? 1 : 0;
    REQUIRE(dashed == 2);
}

TEST_CASE("A map of one parameter twice is refused, and a map can be cancelled") {
    StabilityMapConfig config = tiny_map();
    config.x = config.y;
    REQUIRE_THROWS_AS(map_stability(config, {}), Refusal);
    const Progress cancelled{[](double, const std::string&) { return false; }};
    REQUIRE_THROWS_AS(map_stability(tiny_map(), cancelled), Cancelled);
}
