// `experiment needs` as a whole, with costs that are given, so that it does the same every time.
#include <algorithm>
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

#include "experiments/needs/chaos.h"
#include "needs_scenes.h"
#include "scene/io.h"
#include "support/files.h"

using namespace clothlab;
using namespace clothlab::experiments;
using namespace clothlab::experiments::needs;
using namespace clothlab::test;

namespace {

/// How far a model is from the full one, in mm RMS at the worst of all frames; infinite where it fails.
double off_by(const scene::Scene& full, const scene::Scene& model, std::uint64_t frames) {
    const auto one = sim::Simulation::create(full.simulation), other = sim::Simulation::create(model.simulation);
    other->watch(true);
    double worst = 0;
    for (std::uint64_t i = 0; i < frames; ++i) {
        one->step_frame();
        other->step_frame();
        if (other->trouble())
            return std::numeric_limits<double>::infinity();
        const Shape shape = shape_of(*one);
        worst = std::max(worst, 1000 * distance(shape, resampled(shape_of(*other), shape.columns, shape.rows)).rms);
    }
    return worst;
}

std::vector<std::size_t> rows_of(const Table& table, const std::string& stage) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        if (table.text(i, "stage") == stage)
            rows.push_back(i);
    return rows;
}

/// The sentence of the refusal.
std::string refusal(const Config& config) {
    try {
        run_needs(config, {});
    } catch (const Refusal& refused) {
        return refused.what();
    }
    return "";
}

} // namespace

TEST_CASE("The recommended model is cheaper and within the tolerance, as its row says", "[needs]") {
    for (const double tolerance : {0.5, 5.0}) {
        const Config config = needs_of(hanging_cloth(), tolerance);
        const Result result = run_needs(config, {});
        const Table& table = result.findings.table;
        const std::size_t row = rows_of(table, "recommended").at(0);
        const scene::Scene model = with(config.scene, result.findings.settings[row]);
        REQUIRE(model.simulation == result.recommended.simulation);
        const double off = off_by(config.scene, model, config.frames);
        REQUIRE(off <= tolerance);
        REQUIRE(table.number(row, "deviation_mm") == off);
        REQUIRE(table.number(row, "speed_up") > 1);
        REQUIRE(table.number(row, "speed_up") == work(config.scene.simulation) / work(result.recommended.simulation));
        const std::size_t again = rows_of(table, "run again").at(0);
        REQUIRE(table.number(again, "deviation_mm") == off);
    }
}

TEST_CASE("Every further omission from the recommended model breaks the tolerance", "[needs]") {
    Config config = needs_of(hanging_cloth(), 2);
    SECTION("in the air") {}
    SECTION("on a sphere and a plane") {
        config.scene = falling_cloth();
        config.scene.simulation.stepping.substeps = 4;
        config.tolerance = 30;
        config.frames = 12;
    }
    const Result result = run_needs(config, {});
    const Table& table = result.findings.table;
    const double cost = work(result.recommended.simulation);
    const std::vector<std::size_t> rows = rows_of(table, "one more");
    REQUIRE(rows.size() == alternatives(result.recommended, config.kept).size());
    int omissions = 0;
    for (const std::size_t row : rows) {
        INFO(table.text(row, "model"));
        const scene::Scene model = with(config.scene, result.findings.settings[row]);
        REQUIRE(model.simulation != result.recommended.simulation);
        const double off = off_by(config.scene, model, config.frames);
        REQUIRE((table.text(row, "within") == "yes") == (off <= config.tolerance));
        if (off <= config.tolerance)
            REQUIRE(work(model.simulation) > (1 - 0.03) * cost);
        const std::string what = table.text(row, "model");
        if (what.starts_with("no ") || what.starts_with("without ")) {
            REQUIRE(off > config.tolerance);
            ++omissions;
        }
    }
    REQUIRE(omissions > 0);
}

TEST_CASE("Each greedy step costs less than the one before and stays within the tolerance", "[needs]") {
    const Config config = needs_of(hanging_cloth(), 3);
    const Result result = run_needs(config, {});
    const Table& table = result.findings.table;
    const std::vector<std::size_t> free = rows_of(table, "free"), greedy = rows_of(table, "greedy");
    REQUIRE(free.size() == 1);
    REQUIRE(table.number(free[0], "deviation_mm") == 0);
    REQUIRE(table.text(free[0], "evidence").starts_with("proof: self-collision pushed no pair"));
    REQUIRE(greedy.size() > 1);
    double speed_up = table.number(free[0], "speed_up");
    for (const std::size_t row : greedy) {
        REQUIRE(table.number(row, "speed_up") > 0.97 * speed_up); // what gains nothing is left out at last
        REQUIRE(table.number(row, "deviation_mm") <= 3);
        speed_up = table.number(row, "speed_up");
    }
}

TEST_CASE("The preset loads and gives the recommended model's bits", "[needs]") {
    const Config config = needs_of(hanging_cloth(), 2);
    const Result result = run_needs(config, {});
    const TemporaryFolder folder;
    const auto file = folder / "preset.json";
    scene::save_scene(result.recommended, file);
    const scene::Scene preset = scene::load_scene(file);
    REQUIRE(preset.description.find("experiment needs") != std::string::npos);
    REQUIRE(preset.description.find("hanging") != std::string::npos);
    const std::size_t row = rows_of(result.findings.table, "recommended").at(0);
    const scene::Scene model = with(config.scene, result.findings.settings[row]);
    REQUIRE(hash_after(preset.simulation, 24) == hash_after(model.simulation, 24));
    REQUIRE(hash_after(preset.simulation, 24) != hash_after(config.scene.simulation, 24));
}

TEST_CASE("Findings have settings for every row and points of the chart that lead to rows", "[needs]") {
    const Config config = needs_of(hanging_cloth(), 2);
    const Findings findings = run_needs(config, {}).findings;
    REQUIRE(findings.settings.size() == findings.table.rows.size());
    REQUIRE(findings.settings[0].empty()); // the full model
    for (const Settings& settings : findings.settings)
        REQUIRE_NOTHROW(with(config.scene, settings));
    const Chart& chart = findings.charts.at(0);
    REQUIRE((chart.x.log && chart.y.log));
    for (const Series& series : chart.series) {
        REQUIRE(series.x.size() == series.rows.size());
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            REQUIRE(series.rows[i] < findings.table.rows.size());
            REQUIRE(series.x[i] == findings.table.number(series.rows[i], "speed_up"));
            const double deviation = findings.table.number(series.rows[i], "deviation_mm");
            REQUIRE(series.y[i] > 0); // zero cannot be on a logarithmic axis
            REQUIRE((series.y[i] == deviation || (deviation < 1e-9 && series.y[i] < config.tolerance)));
        }
    }
    REQUIRE(chart.guides.at(0).at == config.tolerance);
    REQUIRE(findings.sentences.at(0).find("x faster") != std::string::npos);
}

TEST_CASE("A model that may not be touched is recommended as it is", "[needs]") {
    Config config = needs_of(hanging_cloth(), 1e-3);
    config.kept = {"cloth", "simulation", "rules"};
    const Result result = run_needs(config, {});
    REQUIRE(result.recommended.simulation == config.scene.simulation);
    REQUIRE(result.findings.sentences.at(0).starts_with("Nothing can be left out"));
    config.kept = {"simulation.precison"};
    REQUIRE_THROWS_AS(run_needs(config, {}), scene::SceneError);
}

TEST_CASE("A full model that is no yardstick is refused with a reason and a suggestion", "[needs]") {
    Config config = needs_of(hanging_cloth(), 1e-9);
    const std::string chaotic = refusal(config);
    INFO(chaotic);
    REQUIRE(chaotic.find("chaotic") != std::string::npos);
    REQUIRE(chaotic.find("mm, more than the tolerance of 1e-09 mm") != std::string::npos);
    REQUIRE(chaotic.find("Use ") != std::string::npos);

    config = needs_of(hanging_cloth(), 1);
    config.quantity = Quantity::first_contact;
    REQUIRE(refusal(config).find("no point touches a collider") != std::string::npos);

    config = needs_of(hanging_cloth(), 1);
    config.scene.simulation.cloth.ks = 1e9;
    config.scene.simulation.rules.limit = sim::LimitRule::off;
    REQUIRE(refusal(config).find("diverge") != std::string::npos);
}

TEST_CASE("Where a nudge moves the shape too far, what it does not move is suggested", "[needs]") {
    Config config = needs_of(hanging_cloth(), 1);
    Record full, nudged;
    for (const double off : {0.0, 0.0004, 0.05}) { // m, of one of two points, level with each other
        full.shapes.push_back({2, 1, {{0, 1, 0}, {1, 1, 0}}});
        nudged.shapes.push_back({2, 1, {{0, 1, 0}, {1 + off, 1, 0}}});
    }
    full.times = nudged.times = {0.1, 0.2, 0.3};
    full.energies = nudged.energies = {1, 1, 1};
    full.start_height = nudged.start_height = 1;
    full.simulated_s = 0.3;
    try {
        noise_of(config, full, nudged, 1e-10);
        FAIL();
    } catch (const Refusal& refused) {
        const std::string why = refused.what();
        INFO(why);
        REQUIRE(why.find("--seconds 0.2") != std::string::npos);
        REQUIRE(why.find("--quantity drape") != std::string::npos);
        REQUIRE(why.find("--quantity largest") == std::string::npos);
        REQUIRE(why.find("first-contact") == std::string::npos);
    }
    config.tolerance = 40; // 50 mm of one of two points are 35 mm RMS
    REQUIRE_THAT(noise_of(config, full, nudged, 1e-10), Catch::Matchers::WithinRel(50 / std::sqrt(2.0), 1e-12));
}

TEST_CASE("First contact is when the cloth has fallen to the plane", "[needs]") {
    scene::Scene scene = hanging_cloth();
    scene.simulation.cloth.pinned.clear();
    scene.simulation.cloth.damping = 0;
    scene.simulation.rules.start = sim::StartRule::physical;
    scene.simulation.colliders = {sim::Plane{{0, 0.51, 0}, {0, 1, 0}, 0}};
    const double falls = std::sqrt(2 * 0.49 / 9.8), step = sim::step_length(scene.simulation);
    const Course course = course_of(scene.simulation, 24, 1);
    const Record full = record(scene.simulation, course, {});
    REQUIRE(full.first_contact >= falls - 1e-9);
    REQUIRE(full.first_contact <= falls + step + 1e-9);
    const Record other = record(with(scene, {"plane.point=0,0.6,0"}).simulation, course, {});
    REQUIRE_THAT(deviation(Quantity::first_contact, full, other, false),
                 Catch::Matchers::WithinAbs(1000 * (falls - std::sqrt(2 * 0.4 / 9.8)), 1000 * step));
    const Record none = record(with(scene, {"colliders.0=none"}).simulation, course, {});
    REQUIRE(std::isinf(deviation(Quantity::first_contact, full, none, false)));

    Config config = needs_of(scene, 5);
    config.quantity = Quantity::first_contact;
    const Result result = run_needs(config, {});
    REQUIRE(result.recommended.simulation.colliders.size() == 1);
    REQUIRE_FALSE(result.recommended.simulation.cloth.enable_bending); // a cloth that falls freely needs no springs
    REQUIRE(result.recommended.simulation.stepping.substeps < 8);
}

TEST_CASE("A nudge moves the free points by no more than it says, and nothing else", "[needs]") {
    scene::Scene scene = hanging_cloth();
    const Course course = course_of(scene.simulation, 1, 1);
    const double infinity = std::numeric_limits<double>::infinity();
    for (const auto precision : {sim::Precision::single_precision, sim::Precision::double_precision}) {
        scene.simulation.stepping.precision = precision;
        const Record plain = record(scene.simulation, course, {});
        const Record nudged = record(scene.simulation, course, {}, infinity, true);
        const double by = nudge(*sim::Simulation::create(scene.simulation));
        const double off = distance(plain.shapes[0], nudged.shapes[0]).largest;
        REQUIRE(plain.hash != nudged.hash);
        REQUIRE(off > by / 10);
        REQUIRE(off < by * 20);                                           // after one frame
        REQUIRE(plain.shapes[0].points[0] == nudged.shapes[0].points[0]); // a pin
    }
}

TEST_CASE("Equal shapes are no distance apart, to the bit", "[needs]") {
    const auto simulation = sim::Simulation::create(falling_cloth().simulation);
    run_frames(*simulation, 20);
    REQUIRE(distance(shape_of(*simulation), shape_of(*simulation)).largest == 0);
}

TEST_CASE("A coarser grid is compared at all points of the finer one, those between its own included", "[needs]") {
    Record full, coarse;
    // Three points in an arch, of which the coarser grid has the two at its feet.
    full.shapes = {{3, 1, {{0, 0, 0}, {1, 0.3, 0}, {2, 0, 0}}}};
    coarse.shapes = {{2, 1, {{0, 0, 0}, {2, 0, 0}}}};
    REQUIRE_THAT(deviation(Quantity::largest, full, coarse, false), Catch::Matchers::WithinRel(300.0, 1e-12));
    REQUIRE_THAT(deviation(Quantity::rms, full, coarse, false),
                 Catch::Matchers::WithinRel(300 / std::sqrt(3.0), 1e-12));
    REQUIRE_THAT(deviation(Quantity::drape, full, coarse, true), Catch::Matchers::WithinRel(300.0, 1e-12));
}

TEST_CASE("The search ends when it is cancelled", "[needs]") {
    int told = 0;
    double last = 0;
    const Progress progress{[&](double share, const std::string&) {
        REQUIRE(share >= 0);
        REQUIRE(share <= 1);
        last = std::max(last, share);
        return ++told < 400;
    }};
    REQUIRE_THROWS_AS(run_needs(needs_of(hanging_cloth(), 2), progress), Cancelled);
    REQUIRE(told == 400);
    REQUIRE(last > 0);
}
