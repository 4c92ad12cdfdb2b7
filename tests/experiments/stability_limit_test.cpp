// Runs fail where they are predicted to: observed limits against omega dt and the methods' formulas.
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

#include "experiments/stability/bisection.h"
#include "experiments/stability/fastest_mode.h"
#include "experiments/stability/prediction.h"
#include "experiments/stability/start_displacement.h"
#include "experiments/trial.h"
#include "scene/io.h"
#include "sim/integrators/integrator.h"
#include "support/files.h"

using namespace clothlab;
using namespace clothlab::experiments;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

const double pi = std::acos(-1.0);

scene::Scene shipped(const std::string& name, const Settings& settings = {}) {
    return with(scene::load_scene(std::filesystem::path(CLOTHLAB_SOURCE_DIR) / "scenes" / (name + ".json")), settings);
}

Findings bisected(const scene::Scene& scene, double precision = 5e-4, const std::string& key = "cloth.ks",
                  std::uint64_t frames = 15) {
    BisectionConfig config;
    config.scene = scene;
    config.key = key;
    config.precision = precision;
    config.judge.frames = frames; // a chain's growth is found in the first 400 steps
    return bisect_stability(config, {});
}

/// The row that has the limit.
std::size_t limit_row(const Findings& findings) {
    for (std::size_t row = 0; row < findings.table.rows.size(); ++row)
        if (!findings.table.text(row, "distance_percent").empty())
            return row;
    throw std::runtime_error("no limit was found");
}

double distance_percent(const Findings& findings) {
    return findings.table.number(limit_row(findings), "distance_percent");
}

Verdict verdict(const sim::Description& description, std::optional<std::uint64_t> frames = 40) {
    JudgeConfig config;
    config.frames = frames;
    return judge(description, config, [] {}).verdict;
}

} // namespace

TEST_CASE("On the chain every explicit method with a limit holds below it and grows above, within 0.1 % of ks") {
    int methods = 0;
    for (const sim::IntegratorInfo& method : sim::integrators()) {
        const bool with_limit = method.limit(0) > 0 && method.limit(0) < sim::no_limit;
        if (method.family != sim::Family::explicit_method)
            continue;
        INFO(method.name);
        // Methods without a limit have one with damping.
        const Findings findings = bisected(shipped("chain", {"simulation.integrator=" + std::string(method.name),
                                                             with_limit ? "cloth.damping=0" : "cloth.damping=0.2"}));
        REQUIRE_THAT(distance_percent(findings), WithinAbs(0, 0.1));
        ++methods;
    }
    REQUIRE(methods == 7);
}

TEST_CASE("The chain's predicted limit is that of its fastest mode, omega = 2 sqrt(ks/m) cos(pi / (2N + 1))") {
    const scene::Scene chain = shipped("chain");
    const Findings findings = bisected(chain);
    const sim::Description& d = chain.simulation;
    const int masses = d.cloth.num_height_points - 1;
    const double c = std::cos(pi / (2 * masses + 1)), dt = sim::step_length(d);
    REQUIRE_THAT(findings.table.number(limit_row(findings), "predicted_ks_n_m"),
                 WithinRel(sim::point_mass(d.cloth) / (dt * dt * c * c), 2e-4));
}

TEST_CASE("A chain of any length is judged right 0.05 % of ks on both sides of the exact limit of Verlet") {
    for (const int points : {2, 3, 8, 30}) {
        scene::Scene chain = shipped("chain", {"cloth.num_height_points=" + std::to_string(points)});
        sim::Description& d = chain.simulation;
        const double c = std::cos(pi / (2 * points - 1)), dt = sim::step_length(d);
        const double across =
            0.5; // omega² m / (4 ks) of a pair of points on one cross spring, half of the chain's at most
        const double limit = sim::point_mass(d.cloth) / (dt * dt * std::max(c * c, across));
        INFO(points);
        d.cloth.ks = 0.9995 * limit;
        REQUIRE(verdict(d) == Verdict::stable);
        d.cloth.ks = 1.0005 * limit;
        REQUIRE(verdict(d) != Verdict::stable);
    }
}

TEST_CASE("Density and substeps have their limits where ks has them") {
    const scene::Scene chain = shipped("chain");
    REQUIRE_THAT(distance_percent(bisected(chain, 5e-4, "cloth.density")), WithinAbs(0, 0.1));
    const Findings substeps = bisected(chain, 1, "substeps");
    REQUIRE(distance_percent(substeps) == 0);
    REQUIRE(substeps.table.number(limit_row(substeps), "substeps_per_frame") == 7); // 30 sqrt(5000 / 92846) = 6.96
}

TEST_CASE("A swinging cloth blows up within 1 % of the predicted ks, held by the stretch limit or not") {
    for (const Settings& rules : {Settings{"rules.limit=cs184"}, Settings{"rules.limit=off"}}) {
        scene::Scene cloth = with(shipped("two-pins", {"cloth.num_width_points=12", "cloth.num_height_points=12",
                                                       "cloth.pinned=[[0,0],[11,0]]"}),
                                  rules);
        const Findings findings = bisected(cloth, 2e-3, "cloth.ks", 40);
        const std::size_t row = limit_row(findings);
        REQUIRE_THAT(distance_percent(findings), WithinAbs(0, 1));
        REQUIRE(findings.table.text(row, "verdict") == "stable");
        REQUIRE(findings.table.text(row + 1, "verdict") != "stable");
    }
}

TEST_CASE("What Runge-Kutta 4 lets grow under a smooth motion is found within 1 % too, though it stays small") {
    const scene::Scene cloth = shipped("two-pins", {"cloth.num_width_points=16", "cloth.num_height_points=16",
                                                    "cloth.pinned=[[0,0],[15,0]]", "simulation.integrator=rk4"});
    REQUIRE_THAT(distance_percent(bisected(cloth, 8e-3, "cloth.ks", 40)), WithinAbs(0, 1));
}

TEST_CASE("Cloth that falls onto a plane and itself is stable, however restless its contacts are") {
    for (const char* ks : {"cloth.ks=5000", "cloth.ks=40000"}) { // up to 0.75 of the limit
        const scene::Scene cloth =
            shipped("self-collision", {"cloth.num_width_points=25", "cloth.num_height_points=25", ks});
        REQUIRE(limit_ratio(cloth.simulation) < 0.8);
        REQUIRE(verdict(cloth.simulation, 60) == Verdict::stable);
    }
}

TEST_CASE("Default cloth blows up within 1 % of the predicted ks with Verlet, in both precisions", "[.][stability]") {
    for (const char* method : {"course-verlet", "velocity-verlet", "symplectic-euler"})
        for (const char* precision : {"single", "double"}) {
            BisectionConfig config;
            config.scene = shipped("two-pins", {std::string("simulation.integrator=") + method,
                                                std::string("simulation.precision=") + precision});
            INFO(method << ", " << precision);
            REQUIRE_THAT(distance_percent(bisect_stability(config, {})), WithinAbs(0, 1));
        }
}

/// Every explicit method on a cloth that rests in its start pose: no gravity.
void fails_where_predicted(const Settings& cloth, double percent) {
    for (const sim::IntegratorInfo& method : sim::integrators()) {
        if (method.family != sim::Family::explicit_method)
            continue;
        INFO(method.name);
        Settings settings = cloth;
        settings.insert(settings.end(),
                        {"simulation.gravity=[0,0,0]", "simulation.precision=double", "simulation.tolerance=0",
                         "simulation.integrator=" + std::string(method.name)});
        REQUIRE_THAT(distance_percent(bisected(shipped("two-pins", settings))), WithinAbs(0, percent));
    }
}

TEST_CASE("A sheet at rest fails within 0.1 % of the predicted ks with every explicit method") {
    fails_where_predicted({"cloth.num_width_points=9", "cloth.num_height_points=9", "cloth.pinned=[[0,0],[8,0]]"}, 0.1);
}

TEST_CASE("So does default cloth", "[.][stability]") {
    fails_where_predicted({}, 0.1);
}

TEST_CASE("Far beyond the limit the course's stretch limit makes a jitter of what diverges without it") {
    const scene::Scene cloth = shipped("two-pins", {"cloth.num_width_points=16", "cloth.num_height_points=16",
                                                    "cloth.pinned=[[0,0],[15,0]]", "cloth.ks=2.7e6"});
    REQUIRE(limit_ratio(cloth.simulation) > 1.05);
    REQUIRE(verdict(with(cloth, {"rules.limit=cs184"}).simulation) == Verdict::jittering);
    REQUIRE(verdict(with(cloth, {"rules.limit=off"}).simulation) == Verdict::diverged);
}

TEST_CASE("Methods without a limit are stable at any stiffness, and have no boundary") {
    const scene::Scene chain = shipped("chain", {"simulation.integrator=backward-euler", "simulation.tolerance=1e-6"});
    REQUIRE(verdict(with(chain, {"cloth.ks=1e8"}).simulation, 10) == Verdict::stable);
    REQUIRE(limit_ratio(chain.simulation) == 0);
    REQUIRE_THROWS_AS(bisected(chain), Refusal);
}

TEST_CASE("A bisection says what it cannot find") {
    BisectionConfig config;
    config.scene = shipped("chain");
    config.judge.frames = 5;
    config.from = 100;
    config.to = 200;
    REQUIRE_THROWS_AS(bisect_stability(config, {}), Refusal);
    config.key = "rules.limit";
    REQUIRE_THROWS_AS(bisect_stability(config, {}), Refusal);
    const Progress cancelled{[](double, const std::string&) { return false; }};
    config.key = "cloth.ks";
    REQUIRE_THROWS_AS(bisect_stability(config, cancelled), Cancelled);
}

TEST_CASE("The fastest mode of a chain is sin(pi j (2N - 1) / (2N + 1)) along it") {
    const auto shape = fastest_mode(shipped("chain").simulation);
    REQUIRE(shape);
    const int masses = 11;
    const auto exact = [&](int j) { return std::sin(pi * j * (2 * masses - 1) / (2 * masses + 1)); };
    for (int row = 0; row <= masses; ++row)
        for (int column = 0; column < 2; ++column) {
            const sim::Vec3 s = (*shape)[static_cast<std::size_t>(2 * row + column)];
            const sim::Vec3 first = (*shape)[static_cast<std::size_t>(2 + column)];
            REQUIRE_THAT(s.z / first.z, WithinAbs(exact(row) / exact(1), 1e-4));
            REQUIRE_THAT(s.x, WithinAbs(0, 1e-5));
            REQUIRE_THAT(s.y, WithinAbs(0, 1e-5));
        }
}

TEST_CASE("The growth of an oscillation is read off its series to 1e-12, above 1 and below") {
    for (const double factor : {0.9, 1 - 1e-7, 1.0, 1 + 1e-7, 1.05}) {
        std::vector<double> series;
        for (int n = 0; n < 300; ++n)
            series.push_back(std::pow(factor, n) * std::cos(1.9 * n));
        REQUIRE_THAT(growth_per_step(series), WithinRel(factor, 1e-12));
    }
    REQUIRE(growth_per_step({}) == 1);
    REQUIRE(growth_per_step(std::vector<double>(10, 0.0)) == 1);
}

TEST_CASE("A run's points are moved by what was asked for, pins and velocities not at all") {
    for (const char* precision : {"single", "double"}) {
        const scene::Scene scene = shipped("chain", {std::string("simulation.precision=") + precision});
        const auto moved = sim::Simulation::create(scene.simulation), still = sim::Simulation::create(scene.simulation);
        const std::vector<sim::Vec3> shape = noise(scene.simulation);
        displace(*moved, 1e-3, shape);
        for (std::size_t i = 0; i < shape.size(); ++i) {
            REQUIRE_THAT(moved->position(i).x - still->position(i).x, WithinAbs(1e-3 * shape[i].x, 1e-7));
            REQUIRE_THAT(moved->position(i).z - still->position(i).z, WithinAbs(1e-3 * shape[i].z, 1e-7));
        }
        REQUIRE(shape[0] == sim::Vec3{});
        REQUIRE(moved->diagnose().rms_speed == 0);
    }
}
