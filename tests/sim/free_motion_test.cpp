// Motions with an exact solution of the time-stepped equations: free fall, and a free sheet that flies and spins.
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "sim/simulation.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// A free cloth that starts at y = 0, so that the distance fallen is known to full precision.
sim::Description falling(double damping_percent) {
    sim::Description description;
    description.cloth.num_width_points = description.cloth.num_height_points = 6;
    description.cloth.damping = damping_percent;
    description.cloth.offset = {0, -1, 0};
    description.stepping.precision = sim::Precision::double_precision;
    return description;
}

/// A sheet that flies and turns about a skew axis, with its springs stretched at random and without outer forces.
Sheet<double> thrown_sheet(double damping_percent) {
    sim::Description description = bare_cloth(8, 6);
    description.cloth.damping = damping_percent;
    Sheet<double> sheet(description);
    sim::SplitMix64 random(11);
    const sim::Vec3 v{1.5, -0.7, 0.4}, w{0.8, 2.1, -1.3};
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 s = sheet.position(i), r = uniform_point(random, -0.01, 0.01);
        const sim::Vec3 x{s.x + r.x, s.y + r.y, s.z + r.z};
        const double dt = sheet.model.dt;
        sheet.put(sheet.state.position, i, x);
        sheet.put(sheet.state.previous, i,
                  {x.x - dt * (v.x + w.y * x.z - w.z * x.y), x.y - dt * (v.y + w.z * x.x - w.x * x.z),
                   x.z - dt * (v.z + w.x * x.y - w.y * x.x)});
    }
    return sheet;
}

void require_share(sim::Vec3 now, sim::Vec3 start, double share) {
    const double tolerance = 1e-9 * norm(start);
    REQUIRE_THAT(now.x, WithinAbs(share * start.x, tolerance));
    REQUIRE_THAT(now.y, WithinAbs(share * start.y, tolerance));
    REQUIRE_THAT(now.z, WithinAbs(share * start.z, tolerance));
}

} // namespace

TEST_CASE("Free fall without damping after n steps is a dt^2 n(n+1)/2") {
    const auto simulation = sim::Simulation::create(falling(0));
    const double dt = sim::step_length(simulation->description());
    for (int n = 1; n <= 500; ++n) { // beyond, rounding alone is over 1e-12
        simulation->step();
        const double expected = -9.8 * dt * dt * n * (n + 1) / 2;
        for (std::size_t i = 0; i < simulation->points(); ++i)
            REQUIRE_THAT(simulation->position(i).y, WithinRel(expected, 1e-12));
    }
}

TEST_CASE("Damped free fall after n steps is (a dt^2/d) (n - (1-d)(1-(1-d)^n)/d)") {
    const double percent = GENERATE(0.2, 5.0);
    const auto simulation = sim::Simulation::create(falling(percent));
    const double dt = sim::step_length(simulation->description()), d = percent / 100;
    for (int n = 1; n <= 2700; ++n) {
        simulation->step();
        if (n < 10)
            continue; // the formula itself cancels: d = 0.002 costs it 6 digits at n = 1
        const double expected = -9.8 * dt * dt / d * (n - (1 - d) * (1 - std::pow(1 - d, n)) / d);
        REQUIRE_THAT(simulation->position(17).y, WithinRel(expected, 1e-9));
    }
}

TEST_CASE("Free fall does not depend on stiffness or density") {
    sim::Description description = falling(0.2);
    description.cloth.ks = GENERATE(1.0, 5000.0, 20000.0);
    description.cloth.density = GENERATE(20.0, 1500.0);
    const auto simulation = sim::Simulation::create(description);
    const auto expected = sim::Simulation::create(falling(0.2));
    for (int frame = 0; frame < 10; ++frame) {
        simulation->step_frame();
        expected->step_frame();
    }
    REQUIRE(expected->position(17).y < -0.01);
    REQUIRE_THAT(simulation->position(17).y, WithinRel(expected->position(17).y, 1e-10));
}

TEST_CASE("The momenta of a spinning free sheet decay as (1-d)^n") {
    const double percent = GENERATE(0.0, 0.2, 1.0);
    Sheet<double> sheet = thrown_sheet(percent);
    const sim::Momentum start = sim::momentum(sheet.model, sheet.state);
    REQUIRE(norm(start.linear) > 1);
    REQUIRE(norm(start.angular) > 1);
    for (int n = 1; n <= 600; ++n) {
        sheet.step();
        const sim::Momentum now = sim::momentum(sheet.model, sheet.state);
        require_share(now.linear, start.linear, std::pow(1 - percent / 100, n));
        require_share(now.angular, start.angular, std::pow(1 - percent / 100, n));
    }
    REQUIRE(sim::diagnose(sheet.model, sheet.state).max_strain > 1e-3); // its springs were at work
}

TEST_CASE("Gravity adds m g dt to the momentum of a free sheet in every step") {
    sim::Description description = falling(0);
    const auto simulation = sim::Simulation::create(description);
    for (int n = 0; n < 100; ++n)
        simulation->step();
    const double weight = description.cloth.density * 1 * 1 * -9.8;
    REQUIRE_THAT(simulation->momentum().linear.y, WithinRel(weight * 100 * sim::step_length(description), 1e-10));
}
