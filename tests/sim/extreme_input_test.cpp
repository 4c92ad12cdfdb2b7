// Inputs that no cloth has: nothing crashes or hangs, and a run that blows up says so and why.
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <limits>
#include <stdexcept>

#include "sim/intersections.h"
#include "sim/simulation.h"
#include "support/sheet.h"

using namespace clothlab;
using Catch::Matchers::ContainsSubstring;

namespace {

sim::Description scene(sim::Precision precision) {
    sim::Description description;
    description.cloth.num_width_points = description.cloth.num_height_points = 10;
    description.cloth.pinned = {{0, 0}};
    description.colliders = {sim::Sphere{{0.5, 0.8, 0.5}, 0.3, 0.1}, sim::Plane{{0, 0.3, 0}, {0, 1, 0}, 0.5}};
    description.stepping.precision = precision;
    return description;
}

/// Runs some frames with everything that looks at a run, and returns the last diagnosis.
sim::Diagnostics run(const sim::Description& description, int frames = 10) {
    const auto simulation = sim::Simulation::create(description);
    sim::Snapshot snapshot;
    for (int frame = 0; frame < frames; ++frame) {
        simulation->step_frame();
        simulation->capture(snapshot);
        sim::count_intersections(snapshot.columns, snapshot.rows, snapshot.positions);
        simulation->momentum();
    }
    REQUIRE(simulation->frame() == static_cast<std::uint64_t>(frames));
    const auto resumed = sim::Simulation::create(description);
    resumed->load_state(simulation->save_state());
    REQUIRE(resumed->hash() == simulation->hash());
    const sim::Diagnostics result = simulation->diagnose();
    REQUIRE((result.status == sim::Status::diverged) == !result.cause.empty());
    return result;
}

const auto both = {sim::Precision::single_precision, sim::Precision::double_precision};

} // namespace

TEST_CASE("A stiffness of 1e12 N/m diverges, with the stiffness as its cause") {
    for (const sim::Precision precision : both) {
        sim::Description description = scene(precision);
        description.cloth.ks = 1e12;
        const sim::Diagnostics result = run(description);
        REQUIRE(result.status == sim::Status::diverged);
        REQUIRE_THAT(result.cause, ContainsSubstring("ks is too stiff"));
    }
}

TEST_CASE("A cloth of 1e-9 kg/m2 diverges, with the stiffness as its cause") {
    for (const sim::Precision precision : both) {
        sim::Description description = scene(precision);
        description.cloth.density = 1e-9;
        const sim::Diagnostics result = run(description);
        REQUIRE(result.status == sim::Status::diverged);
        REQUIRE_THAT(result.cause, ContainsSubstring("ks is too stiff"));
    }
}

TEST_CASE("A cloth of 1e9 kg/m2 falls as any other") {
    for (const sim::Precision precision : both) {
        sim::Description description = scene(precision);
        description.cloth.density = 1e9;
        REQUIRE(run(description).status == sim::Status::ok);
    }
}

TEST_CASE("A negative density without the stretch limit diverges, with the density as its cause") {
    for (const sim::Precision precision : both) {
        sim::Description description = scene(precision);
        description.cloth.density = -15;
        run(description); // with the limit it may do as it likes
        description.rules.limit = sim::LimitRule::off;
        const sim::Diagnostics result = run(description, 90);
        REQUIRE(result.status == sim::Status::diverged);
        REQUIRE_THAT(result.cause, ContainsSubstring("density is negative"));
    }
}

TEST_CASE("A thickness of zero collides nowhere") {
    for (const sim::Precision precision : both) {
        sim::Description description = scene(precision);
        description.cloth.thickness = 0;
        const auto simulation = sim::Simulation::create(description);
        for (int n = 0; n < 300; ++n)
            REQUIRE(simulation->step().self_contacts == 0);
        REQUIRE(simulation->diagnose().status == sim::Status::ok);
    }
}

TEST_CASE("A thickness of a kilometre, colliders of any size and damping beyond all bounds do not hang") {
    sim::Description description = scene(GENERATE(sim::Precision::single_precision, sim::Precision::double_precision));
    SECTION("thickness") {
        description.cloth.thickness = 1000;
    }
    SECTION("colliders") {
        description.colliders = {sim::Sphere{{0, 0, 0}, 1e30, 0}, sim::Sphere{{0.5, 1, 0.5}, 1e-30, 1},
                                 sim::Plane{{1e30, -1e30, 0}, {1e-30, 1e-30, 0}, -3}};
    }
    SECTION("damping") {
        description.cloth.damping = GENERATE(-50.0, 250.0, 1e30);
    }
    SECTION("gravity") {
        description.stepping.gravity = {0, -1e35, 1e35};
    }
    run(description);
}

TEST_CASE("A cloth at 1e30 m runs") {
    for (const sim::Precision precision : both) {
        sim::Description description = scene(precision);
        description.cloth.offset = {1e30, -1e30, 1e30};
        run(description);
        description.cloth.pinned.clear();
        description.colliders.clear();
        run(description);
    }
}

TEST_CASE("Positions that are not numbers are reported as divergence") {
    const double nowhere = GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
    for (const sim::Precision precision : both) {
        sim::Description description = scene(precision);
        description.cloth.offset.y = nowhere;
        const sim::Diagnostics result = run(description);
        REQUIRE(result.status == sim::Status::diverged);
        REQUIRE_THAT(result.cause, ContainsSubstring("finite"));
    }
}

TEST_CASE("A single NaN spreads and is reported, whichever point has it") {
    for (const int point : {0, 37, 99}) {
        test::Sheet<double> sheet(scene(sim::Precision::double_precision));
        sheet.place(static_cast<std::size_t>(point), {0.5, std::numeric_limits<double>::quiet_NaN(), 0.5});
        REQUIRE(sim::diagnose(sheet.model, sheet.state).status == sim::Status::diverged);
        for (int n = 0; n < 30; ++n)
            sheet.step();
        const sim::Diagnostics result = sim::diagnose(sheet.model, sheet.state);
        REQUIRE(result.status == sim::Status::diverged);
        REQUIRE_FALSE(result.cause.empty());
    }
}

TEST_CASE("Descriptions without meaning are refused with a sentence") {
    const auto refuses = [](auto edit) {
        sim::Description description = scene(sim::Precision::single_precision);
        edit(description);
        try {
            sim::Simulation::create(description);
            FAIL("a description without meaning was taken");
        } catch (const std::invalid_argument& error) {
            REQUIRE(std::string(error.what()).size() > 20);
        }
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    refuses([](sim::Description& d) { d.cloth.num_width_points = 1; });
    refuses([](sim::Description& d) { d.cloth.num_height_points = -3; });
    refuses([](sim::Description& d) { d.cloth.width = 0; });
    refuses([](sim::Description& d) { d.cloth.height = -1; });
    refuses([](sim::Description& d) { d.cloth.width = nan; });
    refuses([](sim::Description& d) { d.cloth.density = 0; });
    refuses([](sim::Description& d) { d.cloth.density = nan; });
    refuses([](sim::Description& d) { d.cloth.pinned = {{10, 0}}; });
    refuses([](sim::Description& d) { d.cloth.pinned = {{0, -1}}; });
    refuses([](sim::Description& d) { d.stepping.substeps = 0; });
    refuses([](sim::Description& d) { d.stepping.frames_per_second = nan; });
    refuses([](sim::Description& d) { d.colliders = {sim::Plane{{0, 0, 0}, {0, 0, 0}, 0}}; });
}
