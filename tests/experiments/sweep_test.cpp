// Sweeps in this process: their cells, their rows, their chart.
#include <catch2/catch_test_macros.hpp>

#include "experiments/sweep/file.h"
#include "experiments/sweep/sweep.h"
#include "experiments/trial.h"
#include "scene/io.h"

using namespace clothlab;
using namespace clothlab::experiments;

namespace {

SweepConfig small_sweep(const std::vector<std::string>& vary) {
    SweepConfig config;
    config.name = "small";
    sim::Cloth& cloth = config.scene.simulation.cloth;
    cloth.num_width_points = 6;
    cloth.num_height_points = 5;
    cloth.pinned = {{0, 0}};
    config.scene.simulation.stepping.substeps = 4;
    config.length.frames = 6;
    for (const std::string& text : vary)
        config.axes.push_back(parse_axis(text));
    return config;
}

std::string error_of(const SweepConfig& config) {
    try {
        const Sweep sweep(config);
    } catch (const scene::SceneError& e) {
        return e.what();
    }
    return "";
}

/// Without a thread.
Findings findings_of(const SweepConfig& config) {
    const Sweep sweep(config);
    SweepRows rows;
    for (std::size_t cell = 0; cell < sweep.cells(); ++cell)
        rows[cell] = sweep.run(cell);
    return sweep.findings(rows);
}

std::string csv_of(const Findings& findings) {
    return to_csv(findings.table);
}

} // namespace

TEST_CASE("A sweep has a cell for every combination, the last parameter changing fastest") {
    const Sweep sweep(small_sweep({"cloth.ks=100,200", "simulation.substeps=2,3,4"}));
    REQUIRE(sweep.cells() == 6);
    REQUIRE(sweep.settings(0) == Settings{"cloth.ks=100", "simulation.substeps=2"});
    REQUIRE(sweep.settings(1) == Settings{"cloth.ks=100", "simulation.substeps=3"});
    REQUIRE(sweep.settings(5) == Settings{"cloth.ks=200", "simulation.substeps=4"});
    REQUIRE(cell_name(sweep, 5) == "cell 5 (cloth.ks=200, simulation.substeps=4)");
    REQUIRE(sweep.work(2) > 1.5 * sweep.work(0));
}

TEST_CASE("A row is what the library says of the same run") {
    SweepConfig config = small_sweep({"cloth.ks=100,5000"});
    config.scene.simulation.colliders = {sim::Plane{{0, 0.99, 0}, {0, 1, 0}, 0.5}};
    const Findings findings = findings_of(config);
    for (std::size_t row = 0; row < 2; ++row) {
        const auto simulation = sim::Simulation::create(with(config.scene, findings.settings[row]).simulation);
        double first_contact = -1;
        sim::StepCounts counts;
        while (simulation->frame() < 6) {
            counts = simulation->step();
            if (counts.contacts > 0 && first_contact < 0)
                first_contact = simulation->time();
        }
        const sim::Diagnostics d = simulation->diagnose();
        const Table& table = findings.table;
        REQUIRE(table.number(row, "cell") == static_cast<double>(row));
        REQUIRE(table.number(row, "cloth.ks") == (row == 0 ? 100 : 5000));
        REQUIRE(table.text(row, "status") == "ok");
        REQUIRE(table.number(row, "time_s") == simulation->time());
        REQUIRE(table.number(row, "steps") == 24);
        REQUIRE(table.number(row, "kinetic_J") == d.energy.kinetic);
        REQUIRE(table.number(row, "spring_J") == d.energy.spring);
        REQUIRE(table.number(row, "gravity_J") == d.energy.gravity);
        REQUIRE(table.number(row, "total_J") == d.energy.total());
        REQUIRE(table.number(row, "max_strain") == d.max_strain);
        REQUIRE(table.number(row, "rms_speed_m_s") == d.rms_speed);
        REQUIRE(table.number(row, "drape_height_m") == drape_height(shape_of(*simulation)));
        REQUIRE(table.number(row, "mean_height_m") == mean_height(shape_of(*simulation)));
        REQUIRE(first_contact > 0);
        REQUIRE(table.number(row, "first_contact_s") == first_contact);
        REQUIRE(table.number(row, "contacts") == static_cast<double>(counts.contacts));
        REQUIRE(table.number(row, "intersections") == 0);
        std::array<char, 20> digits{};
        std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(simulation->hash()));
        REQUIRE(table.text(row, "hash") == digits.data());
        REQUIRE(table.text(row, "cause").empty());
    }
}

TEST_CASE("A run that diverges ends there, with its cause, and has no point in the chart") {
    SweepConfig config = small_sweep({"cloth.ks=100,1e9"});
    config.scene.simulation.rules.limit = sim::LimitRule::off;
    config.length.frames = 30;
    const Findings findings = findings_of(config);
    REQUIRE(findings.table.text(1, "status") == "diverged");
    REQUIRE(findings.table.text(1, "cause").find("too stiff") != std::string::npos);
    REQUIRE(findings.table.number(1, "steps") < 30 * 4);
    REQUIRE(findings.table.text(1, "intersections").empty());
    REQUIRE(findings.charts.front().series.front().x == std::vector<double>{100});
    REQUIRE(findings.sentences.front() == "2 of 2 cells: 1 ok, 1 diverged.");
}

TEST_CASE("The table is the same for any number of threads", "[threads]") {
    SweepConfig config = small_sweep({"cloth.ks=100:10000:4log", "simulation.integrator=course-verlet,rk4"});
    config.jobs = 1;
    const Findings one = run_sweep(config);
    REQUIRE(one.table.rows.size() == 8);
    REQUIRE(csv_of(findings_of(config)) == csv_of(one));
    for (const int jobs : {2, 5, 0}) {
        config.jobs = jobs;
        REQUIRE(csv_of(run_sweep(config)) == csv_of(one));
    }
    REQUIRE(one.settings.size() == 8);
    REQUIRE(one.settings[3] == Settings{"cloth.ks=464.158883361", "simulation.integrator=rk4"});
}

TEST_CASE("A sweep that is not wanted any more ends soon", "[threads]") {
    SweepConfig config = small_sweep({"cloth.ks=100:10000:4log"});
    config.length.frames = 1'000'000'000;
    int told = 0;
    REQUIRE_THROWS_AS(run_sweep(config, {[&](double, const std::string&) { return ++told < 2; }}), Cancelled);
    REQUIRE(told == 2);
}

TEST_CASE("Seconds are whole frames of each cell's own frame rate") {
    SweepConfig config = small_sweep({"simulation.frames_per_second=10,90"});
    config.length.seconds = 0.11;
    const Sweep sweep(config);
    REQUIRE(sweep.frames(0) == 2);
    REQUIRE(sweep.frames(1) == 10);
}

TEST_CASE("The chart has the first parameter along x and a series for each value of the others") {
    SweepConfig config = small_sweep({"cloth.ks=1000,100", "simulation.substeps=4,5"});
    config.plot = "drape_height_m";
    const Findings findings = findings_of(config);
    const Chart& chart = findings.charts.front();
    REQUIRE(chart.x.label == "Stiffness ks (N/m)");
    REQUIRE(chart.y.label == "Drape height (m)");
    REQUIRE(chart.series.size() == 2);
    REQUIRE(chart.series[0].name == "simulation.substeps=4");
    REQUIRE(chart.series[0].x == std::vector<double>{100, 1000});
    REQUIRE(chart.series[0].rows == std::vector<std::size_t>{2, 0});
    REQUIRE(chart.series[0].y[1] == findings.table.number(0, "drape_height_m"));

    const Findings named = findings_of(small_sweep({"simulation.integrator=rk4,course-verlet"}));
    REQUIRE(named.charts.front().x.names == std::vector<std::string>{"rk4", "course-verlet"});
    REQUIRE(named.charts.front().series.front().x == std::vector<double>{0, 1});
}

TEST_CASE("What makes no scene is said before any run, with its place") {
    REQUIRE(error_of(small_sweep({})).find("--vary: name a parameter to vary") == 0);
    REQUIRE(error_of(small_sweep({"cloth.ks=1,2", "cloth.ks=3,4"})) == "--vary: cloth.ks is varied twice");
    REQUIRE(error_of(small_sweep({"cloth.kss=1,2"}))
                .find("--vary cloth.kss=1: unknown parameter; did you mean cloth.ks?") == 0);
    REQUIRE(error_of(small_sweep({"cloth.ks=10,-1"})).find("--vary cloth.ks=-1: ") == 0);
    REQUIRE(error_of(small_sweep({"cloth.pinned=[[0,0]],[[5,4]]", "cloth.num_width_points=6,5"}))
                .find("--vary: cell 3 (cloth.pinned=[[5,4]], cloth.num_width_points=5) makes no scene: ") == 0);
    SweepConfig config = small_sweep({"cloth.ks=1,2"});
    config.plot = "wall_s";
    REQUIRE(error_of(config).find("--plot wall_s: there is no such number; there are time_s, ") == 0);
    config.times = true;
    REQUIRE(error_of(config).empty());
    REQUIRE(error_of(small_sweep({"cloth.ks=1:1000:1000", "cloth.density=1:1000:1000"})) ==
            "--vary: a sweep has at most 100000 cells");
}

TEST_CASE("Sweeps with another scene, axis, length or column have another identity") {
    const SweepConfig config = small_sweep({"cloth.ks=100,200"});
    const std::string identity = Sweep(config).identity();
    REQUIRE(identity.find("2-") == 0);
    REQUIRE(Sweep(config).identity() == identity);
    std::set<std::string> others{identity};
    const auto differs = [&](const SweepConfig& other) { return others.insert(Sweep(other).identity()).second; };
    SweepConfig other = config;
    other.scene.simulation.cloth.density = 1;
    REQUIRE(differs(other));
    REQUIRE(differs(small_sweep({"cloth.ks=100,201"})));
    REQUIRE(differs(small_sweep({"cloth.density=100,200"})));
    other = config;
    other.length.frames = 7;
    REQUIRE(differs(other));
    other.length.seconds = 7;
    REQUIRE(differs(other));
    other = config;
    other.times = true;
    REQUIRE(differs(other));
    other = config;
    other.plot = "total_J"; // the table is the same
    other.jobs = 3;
    REQUIRE_FALSE(differs(other));
}

TEST_CASE("With times, each row has them") {
    SweepConfig config = small_sweep({"cloth.ks=100,200"});
    config.times = true;
    const Findings findings = findings_of(config);
    REQUIRE(findings.table.number(1, "wall_s") > 0);
    REQUIRE(findings.table.number(1, "steps_per_s") ==
            findings.table.number(1, "steps") / findings.table.number(1, "wall_s"));
}
