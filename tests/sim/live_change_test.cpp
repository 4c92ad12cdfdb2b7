// Parameters that change between steps: the new ones hold from the next step on, positions and time stay.
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <functional>
#include <stdexcept>
#include <vector>

#include "support/side_by_side.h"

using namespace clothlab;
using namespace clothlab::test;
using reference::Parameters;

namespace {

Parameters start() {
    Parameters p;
    p.columns = p.rows = 10;
    p.pinned = {{0, 0}, {9, 0}};
    return p;
}

const std::vector<std::function<void(Parameters&)>> changes{
    [](Parameters& p) { p.ks = 700; },
    [](Parameters& p) { p.density = 40; },
    [](Parameters& p) { p.damping_percent = 2; },
    [](Parameters& p) { p.bending = false; },
    [](Parameters& p) {
        p.gravity = {3, -5, 1};
    },
    [](Parameters& p) {
        p.colliders = {{.place = {0.5, 0.9, 0.5}, .normal = {}, .radius = 0.2, .friction = 0.2}};
    },
    [](Parameters& p) {
        p.pinned = {{9, 9}};
    },
    [](Parameters& p) { p.thickness = 0.08; },
    [](Parameters& p) { p.substeps = 17; },
    [](Parameters& p) { p.colliders[0].friction = 0.9; },
    [](Parameters& p) { p.frames_per_second = 50; },
    [](Parameters& p) { p.stretch_limit = false; },
    [](Parameters& p) { p.self_collision = false; },
    [](Parameters& p) { p.wind = reference::Wind::course_with_step; },
    [](Parameters& p) { p.structural = false; },
    [](Parameters& p) { p.colliders.clear(); },
    [](Parameters& p) { p.bending = true; },
};

template <class Real>
sim::StepCounts run_with_changes() {
    Parameters parameters = start();
    const auto simulation = sim::Simulation::create(description_of(parameters, precision_of<Real>));
    reference::Simulator<Real> expected(parameters);
    sim::StepCounts sum;
    for (const auto& change : changes) {
        for (int i = 0; i < 23; ++i)
            step_both(*simulation, expected, sum);
        require_equal(*simulation, expected, sum);
        change(parameters);
        const double time = simulation->time();
        simulation->change(description_of(parameters, precision_of<Real>));
        expected.change(parameters);
        REQUIRE(simulation->time() == time);
        require_equal(*simulation, expected, sum); // a change by itself moves nothing
    }
    for (int i = 0; i < 23; ++i)
        step_both(*simulation, expected, sum);
    require_equal(*simulation, expected, sum);
    return sum;
}

} // namespace

TEST_CASE("Live changes of every parameter equal the reference to the last bit") {
    for (const sim::StepCounts& sum : {run_with_changes<double>(), run_with_changes<float>()}) {
        REQUIRE(sum.self_contacts > 0);
        REQUIRE(sum.contacts > 0);
        REQUIRE(sum.shortened_springs > 0);
    }
}

TEST_CASE("A live change is refused where the grid, the start or the precision would differ, and changes nothing") {
    sim::Description description = description_of(start());
    const auto simulation = sim::Simulation::create(description);
    simulation->step_frame();
    const std::uint64_t before = simulation->hash();
    const auto refuses = [&](const std::function<void(sim::Description&)>& edit) {
        sim::Description other = description;
        edit(other);
        REQUIRE_THROWS_AS(simulation->change(other), std::invalid_argument);
        REQUIRE(simulation->hash() == before);
        REQUIRE(simulation->description() == description);
    };
    refuses([](sim::Description& d) { d.cloth.num_width_points = 11; });
    refuses([](sim::Description& d) { d.cloth.height = 2; });
    refuses([](sim::Description& d) { d.cloth.orientation = sim::Orientation::vertical; });
    refuses([](sim::Description& d) { d.cloth.offset.x = 1; });
    refuses([](sim::Description& d) { d.stepping.precision = sim::Precision::single_precision; });
    refuses([](sim::Description& d) { d.stepping.seed = 1; });
    refuses([](sim::Description& d) { d.cloth.pinned = {{10, 0}}; });
    refuses([](sim::Description& d) { d.cloth.density = 0; });
    refuses([](sim::Description& d) { d.stepping.substeps = 0; });
    refuses([](sim::Description& d) { d.stepping.frames_per_second = 0; });
    refuses([](sim::Description& d) { d.colliders = {sim::Plane{{}, {0, 0, 0}, 0}}; });
    simulation->step(); // and it still runs
    REQUIRE(simulation->hash() != before);
}

TEST_CASE("Fewer substeps than the frame under way has had end that frame") {
    sim::Description description = description_of(start());
    const auto simulation = sim::Simulation::create(description);
    for (int i = 0; i < 20; ++i)
        simulation->step();
    REQUIRE(simulation->frame() == 0);
    description.stepping.substeps = 10;
    simulation->change(description);
    REQUIRE(simulation->frame() == 1);
    REQUIRE(simulation->substep() == 0);
    simulation->step_frame();
    REQUIRE(simulation->frame() == 2);
    REQUIRE(simulation->steps() == 30);
}

TEST_CASE("Time is the sum of the steps' lengths, also when that is changed") {
    reference::Parameters parameters = start();
    const auto simulation = sim::Simulation::create(description_of(parameters));
    reference::Simulator<double> expected(parameters);
    sim::StepCounts sum;
    for (int i = 0; i < 1000; ++i)
        step_both(*simulation, expected, sum);
    REQUIRE(simulation->time() == expected.time());
    REQUIRE_THAT(simulation->time(), Catch::Matchers::WithinRel(1000.0 / 90 / 30, 1e-13));
    parameters.substeps = 40;
    simulation->change(description_of(parameters));
    expected.change(parameters);
    for (int i = 0; i < 1000; ++i)
        step_both(*simulation, expected, sum);
    REQUIRE(simulation->time() == expected.time());
}
