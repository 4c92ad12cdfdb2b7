// What every method owes a run, whatever it computes.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>

#include "sim/simulation.h"
#include "support/allocations.h"
#include "support/choices.h"
#include "support/effort.h"
#include "support/every_execution.h"
#include "support/methods.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// Of several vectors in width and, by its number of rows, several threads' work; falls onto a sphere, in double
/// precision in wind.
sim::Description busy_cloth(const sim::IntegratorInfo& method, sim::Precision precision) {
    sim::Description description;
    description.cloth.num_width_points = 22;
    description.cloth.num_height_points = 40;
    description.cloth.thickness = 0.01;
    description.cloth.pinned = {{0, 0}, {21, 0}};
    description.colliders = {sim::Sphere{{0.5, 0.82, 0.5}, 0.2, 0.3}};
    if (precision == sim::Precision::double_precision)
        description.wind.kind = sim::WindKind::physical;
    description.stepping.precision = precision;
    description.stepping.integrator = method.id;
    description.stepping.iterations = 4;
    description.stepping.substeps = 15;
    return description;
}

/// As the shipped scenes are: hung by two corners, and fallen onto a sphere, both with all the course's rules.
sim::Description shipped(int which, const sim::IntegratorInfo& method, sim::Precision precision) {
    sim::Description description;
    description.cloth.num_width_points = description.cloth.num_height_points = 20;
    if (which == 0) {
        description.cloth.pinned = {{0, 0}, {19, 0}};
    } else {
        description.cloth.thickness = 0.02;
        description.colliders = {sim::Sphere{{0.5, 0.75, 0.5}, 0.2, 0.3}, sim::Plane{{0, 0.7, 0}, {0, 1, 0}, 0.5}};
    }
    description.stepping.precision = precision;
    description.stepping.integrator = method.id;
    return description;
}

void step(sim::Simulation& simulation, int steps) {
    for (int n = 0; n < steps; ++n)
        simulation.step();
}

bool same_positions(const sim::Simulation& a, const sim::Simulation& b) {
    for (std::size_t i = 0; i < a.points(); ++i)
        if (!(a.position(i) == b.position(i)))
            return false;
    return true;
}

} // namespace

TEST_CASE("Every method says what it is, by a name of its own") {
    const std::span<const sim::IntegratorInfo> all = sim::integrators();
    for (const sim::IntegratorInfo& method : all) {
        INFO(method.name);
        for (const std::string_view text :
             {method.title, method.help, method.limit_formula, method.cost, method.source})
            REQUIRE_FALSE(text.empty());
        REQUIRE(std::count_if(all.begin(), all.end(), [&](const auto& other) { return other.name == method.name; }) ==
                1);
        REQUIRE((method.order >= 0 && method.limit(0) >= 0 && method.limit(0.5) >= 0));
        REQUIRE((method.velocity || !method.history));
    }
}

TEST_CASE("Every method gives the same bits in any way of computing it", "[threads]") {
    const sim::IntegratorInfo method = any_method();
    const sim::Precision precision = GENERATE(sim::Precision::single_precision, sim::Precision::double_precision);
    INFO(method.name);
    const sim::Description description = busy_cloth(method, precision);
    const auto plain = sim::Simulation::create(description, exactly(sim::InstructionSet::scalar, 1));
    step(*plain, 6);
    for (const sim::InstructionSet set : supported_sets())
        for (const int threads : {1, 2, 3}) {
            if (sanitized && threads != 3)
                continue;
            const auto other = sim::Simulation::create(description, exactly(set, threads));
            step(*other, 6);
            INFO(name_of(set) << ", " << threads << " threads");
            REQUIRE(other->hash() == plain->hash());
        }
}

TEST_CASE("Every method goes on from a saved state bit for bit") {
    const sim::IntegratorInfo method = any_method();
    const sim::Precision precision = GENERATE(sim::Precision::single_precision, sim::Precision::double_precision);
    INFO(method.name);
    const sim::Description description = busy_cloth(method, precision);
    const auto whole = sim::Simulation::create(description), resumed = sim::Simulation::create(description);
    step(*whole, 9);
    step(*resumed, 3); // what it kept from these is not of the state that it goes on from
    resumed->load_state(whole->save_state());
    REQUIRE(resumed->hash() == whole->hash());
    step(*whole, 9);
    step(*resumed, 9);
    REQUIRE(resumed->hash() == whole->hash());
}

TEST_CASE(
    "A change between two steps leaves nothing behind of what was: it is as if the new run had loaded the state") {
    const sim::IntegratorInfo method = any_method();
    INFO(method.name);
    const sim::Description before = busy_cloth(method, sim::Precision::double_precision);
    std::vector<sim::Description> changes(4, before);
    changes[0].cloth.ks *= 0.7;
    changes[1].cloth.density *= 1.5;
    changes[2].cloth.pinned = {{5, 7}};
    changes[3].cloth.enable_shearing = false;
    for (const sim::Description& after : changes) {
        const auto changed = sim::Simulation::create(before), loaded = sim::Simulation::create(after);
        step(*changed, 5);
        loaded->load_state(changed->save_state());
        changed->change(after);
        step(*changed, 5);
        step(*loaded, 5);
        INFO("change " << &after - changes.data());
        REQUIRE(changed->hash() == loaded->hash());
    }
}

TEST_CASE("A switch to any method and back keeps every position, and the motion") {
    const sim::IntegratorInfo from = any_method();
    INFO("from " << from.name);
    sim::Description description = bare_cloth(12, 12);
    description.cloth.pinned = {{0, 0}, {11, 0}};
    description.stepping.gravity = {0, -9.8, 0};
    solve_exactly(description, from);
    for (const sim::IntegratorInfo& to : sim::integrators()) {
        if (sanitized && &to - &sim::integrators().front() > 2 && from.id != sim::IntegratorId::course_verlet)
            continue; // there each method is left and entered, not in every pair
        INFO("to " << to.name);
        const auto switched = sim::Simulation::create(description), straight = sim::Simulation::create(description);
        step(*switched, 40);
        step(*straight, 40);
        sim::Description other = description;
        solve_exactly(other, to);
        switched->change(other);
        REQUIRE(same_positions(*switched, *straight));
        // At a speed of 0.15 m/s. That of Verlet's positions is half a step old: 9.8 m/s² / 5400 s.
        const sim::Momentum now = switched->momentum(), was = straight->momentum();
        REQUIRE(norm(was.linear) > 10);
        REQUIRE(norm(minus(now.linear, was.linear)) < 0.02 * norm(was.linear));
        switched->change(description);
        REQUIRE(same_positions(*switched, *straight));
        if (from.history) // it has to begin anew
            continue;
        step(*switched, 1);
        step(*straight, 1);
        for (std::size_t i = 0; i < straight->points(); ++i)
            REQUIRE(norm(minus(switched->position(i), straight->position(i))) < 1e-12);
    }
}

TEST_CASE("Every method but explicit Euler runs scenes like the shipped ones") {
    const sim::IntegratorInfo method = any_method();
    const int which = GENERATE(0, 1);
    const sim::Precision precision = GENERATE(sim::Precision::single_precision, sim::Precision::double_precision);
    if (method.limit(0) == 0 && method.order < 2) // it grows too fast for any
        return;
    if (sanitized && (which != 0 || precision == sim::Precision::double_precision)) // the same code again
        return;
    INFO(method.name << ", scene " << which);
    const auto simulation = sim::Simulation::create(shipped(which, method, precision));
    const sim::Vec3 start = simulation->position(210);
    for (int frame = 0; frame < (sanitized ? 12 : 30); ++frame)
        simulation->step_frame();
    const sim::Diagnostics result = simulation->diagnose();
    INFO(result.cause);
    REQUIRE(result.status == sim::Status::ok);
    REQUIRE(result.max_strain < 0.2);
    REQUIRE(result.rms_speed < 10);
    REQUIRE(simulation->position(210).y < start.y - 0.02);
}

TEST_CASE("Steps of every method allocate no memory once it is warm", "[threads]") {
    const sim::IntegratorInfo method = any_method();
    const int threads = GENERATE(1, 3);
    const sim::Precision precision = GENERATE(sim::Precision::single_precision, sim::Precision::double_precision);
    INFO(method.name << ", " << threads << " threads");
    const auto simulation =
        sim::Simulation::create(busy_cloth(method, precision), exactly(sim::InstructionSet::automatic, threads));
    step(*simulation, 3);
    const std::size_t before = allocations();
    step(*simulation, attempts(20));
    REQUIRE(allocations() == before);
}
