#include "experiments/accuracy/accuracy.h"

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_exception.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "experiments/accuracy/convergence.h"
#include "experiments/accuracy/reference.h"
#include "experiments/accuracy/run.h"
#include "experiments/trial.h"
#include "scene/io.h"
#include "support/effort.h"
#include "support/files.h"

using namespace clothlab;
using namespace clothlab::experiments;
using namespace clothlab::test;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

const Tick no_tick = [](double) {};

/// The shipped scene with fewer points, its rail as long as it is wide.
scene::Scene smooth(int points) {
    scene::Scene scene = scene::load_scene(checkout() / "scenes/smooth.json");
    sim::Cloth& cloth = scene.simulation.cloth;
    cloth.num_width_points = cloth.num_height_points = points;
    cloth.pinned.clear();
    for (int column = 0; column < points; ++column)
        cloth.pinned.push_back({column, points - 1});
    return scene;
}

/// Errors only, in one thread.
AccuracyConfig small_config() {
    AccuracyConfig config;
    config.scene = smooth(5);
    config.scene_name = "Smooth";
    config.seconds = 0.2;
    config.integrators = {sim::IntegratorId::velocity_verlet, sim::IntegratorId::rk4};
    config.substeps = {1, 2, 4, 8};
    config.precisions = {sim::Precision::double_precision};
    config.threads = {1};
    config.rounds = 0;
    config.budget = 1000;
    config.jobs = 1;
    return config;
}

/// A cloth that hangs by one corner, turned up: it tumbles like a pendulum of many links.
scene::Scene tumbling() {
    scene::Scene scene;
    sim::Description& d = scene.simulation;
    d.cloth.num_width_points = d.cloth.num_height_points = 4;
    d.cloth.orientation = sim::Orientation::vertical;
    d.cloth.pinned = {{0, 0}};
    d.cloth.damping = 0;
    d.cloth.ks = 20000;
    d.rules.self_collision = sim::SelfCollisionRule::none;
    return scene;
}

std::set<std::string> texts(const Table& table, const std::string& column) {
    std::set<std::string> found;
    for (std::size_t row = 0; row < table.rows.size(); ++row)
        found.insert(table.text(row, column));
    return found;
}

/// The slopes of the methods over at least a decade of steps are their orders.
void require_orders(AccuracyConfig config) {
    const Findings findings = run_accuracy(config, {});
    std::map<std::string, std::pair<double, double>> slopes; // by method: order and slope
    const Table& table = findings.table;
    for (std::size_t row = 0; row < table.rows.size(); ++row)
        slopes[table.text(row, "method")] = {table.number(row, "order"), table.number(row, "slope")};
    REQUIRE(slopes.size() == (config.integrators.empty() ? sim::integrators().size() : config.integrators.size()));
    for (const auto& [method, numbers] : slopes) {
        INFO(method << ": order " << numbers.first << ", slope " << numbers.second);
        if (numbers.first > 0)
            CHECK_THAT(numbers.second, WithinAbs(numbers.first, 0.1));
        else
            CHECK(std::isnan(numbers.second)); // it is told in words
    }
    for (const std::string& sentence : findings.sentences) {
        INFO(sentence);
        const std::size_t over = sentence.find(" over ");
        if (over != std::string::npos)
            CHECK(std::stod(sentence.substr(over + 6)) >= 1);
        else
            CHECK(sentence.find("does not converge") != std::string::npos);
    }
}

} // namespace

TEST_CASE("On a smooth scene the slopes of explicit, implicit and position-based methods are their orders") {
    if (sanitized) // many steps of what other tests run as well
        return;
    AccuracyConfig config = small_config();
    config.seconds = 0.3;
    config.integrators = {
        sim::IntegratorId::velocity_verlet,  sim::IntegratorId::rk4,  sim::IntegratorId::symplectic_euler,
        sim::IntegratorId::linearised_euler, sim::IntegratorId::xpbd, sim::IntegratorId::pbd};
    config.substeps = {4, 8, 16, 32, 64};
    require_orders(config);
}

TEST_CASE("On the shipped smooth scene every method's slope is its order", "[.][accuracy-slopes]") {
    AccuracyConfig config = small_config();
    config.scene = smooth(10);
    config.seconds = 0.7;
    config.integrators = {};
    config.substeps = {};
    config.budget = 20;
    require_orders(config);
}

TEST_CASE("The reference is zero away from itself, and its settings make it again to the last bit") {
    const scene::Scene scene = smooth(5);
    const Reference reference = find_reference(scene, 18, 8, ErrorQuantity::rms, 1000, no_tick);
    const Ending again = run_to_end(with(scene, reference.settings).simulation, 18, 1000, no_tick);
    CHECK(errors_between(again, reference.ending) == Errors{});
    CHECK(again.energy == reference.ending.energy);
    CHECK(reference.error[0] < 1e-9); // mm
    CHECK(reference.growth.factor < 100);
    CHECK(reference.substeps[2] == 4 * reference.substeps[0]);
}

TEST_CASE("The reference's estimate of its own error is what a much finer run finds it to be") {
    // Contacts make it of first order, so that there is an error to be found.
    scene::Scene scene = smooth(4);
    scene.simulation.cloth.pinned.clear();
    scene.simulation.colliders = {sim::Sphere{{0.5, -0.3, 0.1}, 0.25, 0.3}};
    const Reference reference = find_reference(scene, 18, 1, ErrorQuantity::rms, 1000, no_tick);
    Settings finer = reference.settings;
    finer.push_back("simulation.substeps=" + std::to_string(64 * reference.substeps[2]));
    const Ending exact = run_to_end(with(scene, finer).simulation, 18, 1000, no_tick);
    const double error = errors_between(reference.ending, exact)[0];
    INFO("estimated " << reference.error[0] << " mm, is " << error << " mm");
    CHECK(error > 1e-6);
    CHECK(reference.error[0] > 0.3 * error);
    CHECK(reference.error[0] < 30 * error);
}

TEST_CASE("A chaotic scene is refused, with its growth and the time up to which it can be compared") {
    AccuracyConfig config = small_config();
    config.scene = tumbling();
    config.seconds = 4;
    std::string said;
    try {
        run_accuracy(config, {});
    } catch (const Refusal& refusal) {
        said = refusal.what();
    }
    CHECK_THAT(said,
               ContainsSubstring("chaotic") && ContainsSubstring("1e-10 m") && ContainsSubstring("times as much"));
    const std::size_t at = said.find("--seconds ");
    REQUIRE(at != std::string::npos);
    config.seconds = std::stod(said.substr(at + 10));
    CHECK(config.seconds > 0.1);
    CHECK(config.seconds < 4);
    CHECK_NOTHROW(run_accuracy(config, {}));
}

TEST_CASE("A perturbed state has other positions and the same velocities, and its pins are where they were") {
    scene::Scene scene = smooth(4);
    // Its velocities are differences of positions.
    scene.simulation.stepping.integrator = sim::IntegratorId::course_verlet;
    const auto simulation = sim::Simulation::create(scene.simulation),
               other = sim::Simulation::create(scene.simulation);
    simulation->step_frame();
    const double by = 1e-3;
    other->load_state(perturbed(simulation->save_state(), scene.simulation.cloth.pinned, by));
    const Shape a = shape_of(*simulation), b = shape_of(*other);
    std::set<double> moves;
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        const sim::Vec3 p = a.points[i], q = b.points[i];
        if (i >= 12) { // the upper row is pinned
            CHECK(p == q);
            continue;
        }
        for (const double move : {q.x - p.x, q.y - p.y, q.z - p.z}) {
            CHECK(std::abs(move) <= by);
            moves.insert(move);
        }
    }
    CHECK(moves.size() == 36);
    CHECK_THAT(other->diagnose().energy.kinetic, WithinRel(simulation->diagnose().energy.kinetic, 1e-9));
}

TEST_CASE("The energy of a method without velocities is that of the very end, to second order") {
    AccuracyConfig config = small_config();
    config.integrators = {sim::IntegratorId::course_verlet};
    config.substeps = {8, 16};
    config.quantity = ErrorQuantity::energy;
    const Table table = run_accuracy(config, {}).table;
    CHECK_THAT(std::log2(table.number(0, "energy_error_mJ") / table.number(1, "energy_error_mJ")), WithinAbs(2, 0.1));
}

TEST_CASE("A row's settings make its very run out of the scene") {
    AccuracyConfig config = small_config();
    config.rules = true;
    config.scene.simulation.rules.damping = sim::DampingRule::cs184;
    config.scene.simulation.cloth.damping = 0.3;
    config.substeps = {4};
    const Findings findings = run_accuracy(config, {});
    REQUIRE(findings.settings.size() == findings.table.rows.size());
    REQUIRE(findings.table.rows.size() == 3);
    CHECK(texts(findings.table, "rule") == std::set<std::string>{"physical", "damping=cs184"});
    const Ending exact = run_to_end(with(config.scene, findings.reference).simulation, 18, 1000, no_tick);
    for (std::size_t row = 0; row < findings.settings.size(); ++row) {
        const sim::Description d = with(config.scene, findings.settings[row]).simulation;
        CHECK(errors_between(run_to_end(d, 18, 1000, no_tick), exact)[1] ==
              findings.table.number(row, "largest_error_mm"));
    }
    // The course's damping per substep is the physical rate at the scene's own step: it hardly differs there.
    CHECK(findings.table.number(2, "rms_error_mm") < 1);
}

TEST_CASE("A run that blows up is a row without an error, and one beyond the budget is left out and told") {
    AccuracyConfig config = small_config();
    config.scene.simulation.cloth.ks = 5e5;
    config.seconds = 0.1;
    config.substeps = {1, 40};
    const Findings findings = run_accuracy(config, {});
    REQUIRE(findings.table.rows.size() == 4);
    CHECK(findings.table.text(0, "status") == "diverged");
    CHECK(findings.table.text(0, "rms_error_mm").empty());
    CHECK(findings.table.text(1, "status") == "ok");
    CHECK(findings.table.number(1, "rms_error_mm") > 0);

    config.budget = 1e-9;
    const Findings without = run_accuracy(config, {});
    CHECK(std::any_of(without.notes.begin(), without.notes.end(), [](const std::string& note) {
        return note.find("Left out") != std::string::npos &&
               note.find("rk4 in double precision with") != std::string::npos;
    }));
    CHECK(without.table.rows.size() < 4);
}

TEST_CASE("The front of a timed experiment is not beaten, and the sentence names the cheapest within the error") {
    AccuracyConfig config = small_config();
    config.rounds = 3;
    config.slot = 1e-3;
    config.precisions.push_back(sim::Precision::single_precision);
    config.tolerances = {0.1, 1e-30};
    const Findings findings = run_accuracy(config, {});
    const Table& table = findings.table;
    REQUIRE(table.rows.size() == 16);
    double cheapest = 1e9;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const double cost = table.number(i, "cost_s_per_s"), error = table.number(i, "rms_error_mm");
        CHECK(cost > 0);
        CHECK(table.number(i, "cost_min_s_per_s") <= cost);
        CHECK(table.number(i, "cost_max_s_per_s") >= cost);
        if (error <= 0.1)
            cheapest = std::min(cheapest, cost);
        for (std::size_t j = 0; j < table.rows.size(); ++j)
            if (table.text(i, "pareto") == "yes" && table.text(j, "resolved") == "yes")
                CHECK_FALSE((table.number(j, "cost_s_per_s") < cost && table.number(j, "rms_error_mm") < error));
    }
    CHECK(texts(table, "pareto") == std::set<std::string>{"no", "yes"});
    CHECK_THAT(findings.sentences.at(0), ContainsSubstring("Within 0.1 mm rms the cheapest is"));
    CHECK(findings.sentences.at(0).find(shown(cheapest, {"", "", 3}) + " s per simulated second") != std::string::npos);
    CHECK_THAT(findings.sentences.at(1), ContainsSubstring("cannot be told"));

    REQUIRE(findings.charts.size() == 2);
    const Chart& chart = findings.charts[0];
    REQUIRE(chart.guides.size() == 1);
    CHECK(chart.guides[0].vertical);
    CHECK(chart.guides[0].at == 1);
    REQUIRE(chart.series.size() == 5); // two methods, two precisions, the front
    CHECK(chart.series.back().emphasised);
    for (const Series& series : chart.series)
        for (std::size_t i = 0; i < series.x.size(); ++i)
            CHECK(series.x[i] == table.number(series.rows[i], "cost_s_per_s"));
}

TEST_CASE("What cannot be compared is refused: a time of no frame, springs that push") {
    AccuracyConfig config = small_config();
    config.seconds = 0.001;
    CHECK_THROWS_MATCHES(run_accuracy(config, {}), Refusal,
                         Catch::Matchers::MessageMatches(ContainsSubstring("frame")));
    config.seconds = 0.1;
    config.scene.simulation.cloth.density = -1;
    CHECK_THROWS_MATCHES(run_accuracy(config, {}), Refusal, Catch::Matchers::MessageMatches(ContainsSubstring("push")));
}

TEST_CASE("Self-collision that has nothing to do costs nothing: it is off in all runs, and that is told") {
    AccuracyConfig config = small_config();
    config.scene.simulation.rules.self_collision = sim::SelfCollisionRule::triangles;
    const Findings findings = run_accuracy(config, {});
    CHECK(with(config.scene, findings.settings[0]).simulation.rules.self_collision == sim::SelfCollisionRule::none);
}

TEST_CASE("An experiment that is not wanted any more ends, whichever part it is in", "[threads]") {
    for (const double until : {0.0, 0.2, 0.7})
        for (const int jobs : {1, 2}) {
            AccuracyConfig config = small_config();
            config.jobs = jobs;
            config.rounds = 1;
            config.slot = 1e-4;
            double last = 0;
            const Progress progress{[&](double share, const std::string&) {
                last = share;
                return share < until;
            }};
            CHECK_THROWS_AS(run_accuracy(config, progress), Cancelled);
            CHECK(last >= until);
        }
}

TEST_CASE("Errors are the same however many runs are made at a time", "[threads]") {
    AccuracyConfig config = small_config();
    const std::string alone = to_csv(run_accuracy(config, {}).table);
    config.jobs = 3;
    CHECK(to_csv(run_accuracy(config, {}).table) == alone);
}
