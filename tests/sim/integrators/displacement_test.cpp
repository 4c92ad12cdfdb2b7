// What holds for every method that finds positions first and makes velocities of displacements.
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <limits>

#include "sim/diagnostics.h"
#include "sim/simulation.h"
#include "small_cloth.h"
#include "support/allocations.h"
#include "support/every_execution.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr auto methods = {sim::IntegratorId::pbd, sim::IntegratorId::xpbd, sim::IntegratorId::projective_dynamics,
                          sim::IntegratorId::vertex_block_descent};

sim::Description free_cloth(sim::IntegratorId integrator) {
    sim::Description description = small_cloth(integrator);
    description.cloth.pinned.clear();
    description.cloth.damping_rate = 0;
    return description;
}

/// Something of everything: wind, contacts, limit.
sim::Description busy_cloth(sim::IntegratorId integrator) {
    sim::Description description;
    description.cloth.num_width_points = 23;
    description.cloth.num_height_points = 17;
    description.cloth.orientation = sim::Orientation::vertical;
    description.cloth.pinned = {{0, 16}, {22, 16}};
    description.colliders = {sim::Sphere{{0.5, 0.6, 0.1}, 0.2, 0.2}};
    description.wind.kind = sim::WindKind::physical;
    description.stepping.substeps = 5;
    description.stepping.iterations = 4;
    description.stepping.integrator = integrator;
    return description;
}

} // namespace

TEST_CASE("A cloth at its rest lengths flies on unchanged, and falls as a stone does by backward Euler") {
    // Of vertical cloth every spring has a rest length of its own.
    const auto orientation = GENERATE(sim::Orientation::horizontal, sim::Orientation::vertical);
    for (const sim::IntegratorId integrator : methods) {
        sim::Description description = free_cloth(integrator);
        description.cloth.orientation = orientation;
        Sheet<double> sheet(description);
        const double dt = sheet.model.dt, g = sheet.model.gy;
        for (std::size_t i = 0; i < sheet.points(); ++i)
            Sheet<double>::put(sheet.state.velocity, i, {0.3, -0.2, 0.1});
        for (int n = 1; n <= 100; ++n) {
            sheet.step();
            const double t = n * dt, fallen = 0.5 * g * t * (t + dt);
            for (std::size_t i = 0; i < sheet.points(); ++i) {
                const sim::Vec3 d = minus(sheet.position(i), Sheet<double>::coordinates(sheet.start, i));
                REQUIRE(norm(minus(d, {0.3 * t, -0.2 * t + fallen, 0.1 * t})) < 1e-12);
            }
        }
        REQUIRE_THAT(sheet.state.velocity.y[0], WithinAbs(-0.2 + 100 * g * dt, 1e-11));
    }
}

TEST_CASE("Springs move no centre of mass, of block descent only as far as its iterations do not reach") {
    const auto drift = [](sim::IntegratorId integrator, int iterations) {
        sim::Description description = free_cloth(integrator);
        description.stepping.gravity = {0, 0, 0};
        description.stepping.iterations = iterations;
        Sheet<double> sheet(description);
        crumple(sheet);
        const sim::Vec3 before = sim::momentum(sheet.model, sheet.state).linear;
        for (int i = 0; i < 50; ++i)
            sheet.step();
        return norm(minus(sim::momentum(sheet.model, sheet.state).linear, before)) / (sheet.model.mass * 30);
    };
    REQUIRE(drift(sim::IntegratorId::pbd, 3) < 1e-12); // m/s
    REQUIRE(drift(sim::IntegratorId::xpbd, 3) < 1e-12);
    REQUIRE(drift(sim::IntegratorId::projective_dynamics, 3) < 1e-12);
    const double few = drift(sim::IntegratorId::vertex_block_descent, 1);
    const double many = drift(sim::IntegratorId::vertex_block_descent, 100);
    INFO(few << " m/s after one iteration, " << many << " m/s after a hundred");
    REQUIRE(few > 1e-4);
    REQUIRE(many < 1e-12);
}

TEST_CASE("Pins do not move, and whoever blows up leaves them finite") {
    for (const sim::IntegratorId integrator : methods)
        for (const double density : {1.8, -1.8}) {
            sim::Description description = small_cloth(integrator);
            description.cloth.density = density;
            Sheet<double> sheet(description);
            crumple(sheet);
            for (int i = 0; i < 300; ++i)
                sheet.step();
            for (const std::size_t pin : {sheet.at(0, 0), sheet.at(5, 0)}) {
                REQUIRE(sheet.position(pin) == Sheet<double>::coordinates(sheet.start, pin));
                REQUIRE(Sheet<double>::coordinates(sheet.state.velocity, pin) == sim::Vec3{});
            }
        }
}

TEST_CASE("A run that is saved and loaded half way goes on to the same bits") {
    for (const sim::IntegratorId integrator : methods)
        for (const sim::Precision precision : {sim::Precision::single_precision, sim::Precision::double_precision}) {
            sim::Description description = busy_cloth(integrator);
            description.stepping.precision = precision;
            const auto whole = sim::Simulation::create(description), resumed = sim::Simulation::create(description);
            for (int i = 0; i < 17; ++i)
                whole->step();
            resumed->load_state(whole->save_state());
            for (int i = 0; i < 17; ++i) {
                whole->step();
                resumed->step();
            }
            REQUIRE(whole->hash() == resumed->hash());
            REQUIRE(whole->diagnose().status == sim::Status::ok);
        }
}

TEST_CASE("Instruction sets and threads change no bit of methods of displacements", "[threads]") {
    for (const sim::IntegratorId integrator : methods) {
        const auto hash = [&](const sim::Execution& execution) {
            sim::Description description = busy_cloth(integrator);
            description.wind.kind = sim::WindKind::course;
            const auto simulation = sim::Simulation::create(description, execution);
            for (int i = 0; i < 20; ++i)
                simulation->step();
            return simulation->hash();
        };
        const std::uint64_t expected = hash(exactly(sim::InstructionSet::scalar, 1));
        for (const sim::InstructionSet set : supported_sets())
            for (const int threads : {1, 3}) {
                INFO(name_of(set) << ", " << threads << " threads");
                REQUIRE(hash(exactly(set, threads)) == expected);
            }
    }
}

TEST_CASE("Once a step is taken, methods of displacements allocate no memory") {
    for (const sim::IntegratorId integrator : methods) {
        const auto simulation = sim::Simulation::create(busy_cloth(integrator));
        for (int i = 0; i < 20; ++i) // contacts come to their sizes too
            simulation->step();
        const std::size_t before = allocations();
        for (int i = 0; i < 20; ++i)
            simulation->step();
        REQUIRE(allocations() == before);
    }
}

TEST_CASE("No stiffness, density or size of a step makes methods of displacements blow up, and none hangs") {
    const auto precision = GENERATE(sim::Precision::single_precision, sim::Precision::double_precision);
    for (const sim::IntegratorId integrator : methods)
        for (const double ks : {0.0, 1e-300, 5000.0, 1e8, 1e12})
            for (const double density : {1e-6, 150.0, 1e9}) {
                sim::Description description = busy_cloth(integrator);
                description.cloth.num_width_points = description.cloth.num_height_points = 6;
                description.cloth.pinned = {{0, 5}, {5, 5}};
                description.wind.kind = sim::WindKind::none;
                description.cloth.ks = ks;
                description.cloth.density = density;
                description.stepping.substeps = 1;
                description.stepping.precision = precision;
                const auto simulation = sim::Simulation::create(description);
                for (int i = 0; i < 30; ++i)
                    simulation->step();
                INFO(static_cast<int>(integrator) << ", ks " << ks << ", density " << density);
                REQUIRE(simulation->diagnose().status == sim::Status::ok);
            }
}

TEST_CASE("Inputs that no cloth has neither crash nor hang methods of displacements") {
    const auto method = GENERATE(values(methods));
    sim::Description description = small_cloth(method);
    SECTION("the smallest grid, all of it pinned") {
        description.cloth.num_width_points = description.cloth.num_height_points = 2;
        description.cloth.pinned = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
        Sheet<double> sheet(description);
        sheet.step();
        REQUIRE(sheet.state.position == sheet.start);
    }
    SECTION("the smallest grid, free") {
        description.cloth.num_width_points = description.cloth.num_height_points = 2;
        description.cloth.pinned.clear();
        Sheet<float> sheet(description);
        for (int i = 0; i < 10; ++i)
            sheet.step();
        REQUIRE(sim::diagnose(sheet.model, sheet.state).status == sim::Status::ok);
    }
    SECTION("all points in one place: no spring has a direction, and all fall together") {
        description.cloth.pinned.clear();
        Sheet<float> sheet(description);
        for (std::size_t i = 0; i < sheet.points(); ++i)
            sheet.place(i, {0.5, 1, 0.5});
        for (int i = 0; i < 10; ++i)
            sheet.step();
        for (std::size_t i = 0; i < sheet.points(); ++i)
            REQUIRE(sheet.position(i) == sheet.position(0));
        REQUIRE(sheet.position(0).y < 1);
    }
    SECTION("a point that is no number is reported") {
        Sheet<float> sheet(description);
        sheet.state.position.y[sheet.at(3, 3)] = std::numeric_limits<float>::quiet_NaN();
        for (int i = 0; i < 5; ++i)
            sheet.step();
        REQUIRE(sim::diagnose(sheet.model, sheet.state).status == sim::Status::diverged);
    }
    SECTION("a negative density") {
        description.cloth.density = -1.8;
        Sheet<double> sheet(description);
        for (int i = 0; i < 100; ++i)
            sheet.step();
        REQUIRE(sheet.state.steps == 100);
    }
}
