// Rules that are switched while a cloth moves, and runs of every rule by any number of threads.
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <functional>
#include <vector>

#include "sim/simulation.h"
#include "support/allocations.h"
#include "support/choices.h"
#include "support/effort.h"
#include "support/every_execution.h"

using namespace clothlab;
using namespace clothlab::test;
using Rules = sim::Rules;

namespace {

const std::vector<std::function<void(Rules&)>> switches{
    [](Rules& r) { r.self_collision = sim::SelfCollisionRule::triangles; },
    [](Rules& r) { r.limit = sim::LimitRule::iterated; },
    [](Rules& r) { r.friction = sim::FrictionRule::physical; },
    [](Rules& r) { r.damping = sim::DampingRule::physical; },
    [](Rules& r) { r.self_collision = sim::SelfCollisionRule::neighbours; },
    [](Rules& r) { r.plane = sim::PlaneRule::physical; },
    [](Rules& r) { r.limit = sim::LimitRule::off; },
    [](Rules& r) { r.self_collision = sim::SelfCollisionRule::cs184; },
    [](Rules& r) { r.friction = sim::FrictionRule::cs184; },
    [](Rules& r) { r.start = sim::StartRule::physical; },
    [](Rules& r) { r.limit = sim::LimitRule::cs184; },
    [](Rules& r) { r.self_collision = sim::SelfCollisionRule::none; },
    [](Rules& r) { r.plane = sim::PlaneRule::cs184; },
    [](Rules& r) { r.self_collision = sim::SelfCollisionRule::triangles; },
    [](Rules& r) { r.damping = sim::DampingRule::cs184; },
    [](Rules& r) { r.self_collision = sim::SelfCollisionRule::cs184; },
};

/// A cloth that stands on a plane, leans on a sphere and folds.
sim::Description collapsing(sim::Precision precision, sim::IntegratorId integrator) {
    sim::Description d;
    d.cloth.num_width_points = d.cloth.num_height_points = 12;
    d.cloth.orientation = sim::Orientation::vertical;
    d.cloth.thickness = 0.03;
    d.cloth.ks = 100;
    d.cloth.pinned = {{0, 11}};
    d.colliders = {sim::Plane{{0, 0.02, 0}, {0, 1, 0}, 0.5}, sim::Sphere{{0.5, 0.3, 0.1}, 0.2, 0.2}};
    d.stepping.precision = precision;
    d.stepping.integrator = integrator;
    return d;
}

} // namespace

TEST_CASE("A rule switched while running holds from the next step on, as in a run that was started with it") {
    for (const sim::Precision precision : both_precisions)
        for (const auto method : {sim::IntegratorId::course_verlet, sim::IntegratorId::velocity_verlet}) {
            // Under a sanitizer each precision and each method once.
            if (sanitized &&
                (precision == sim::Precision::single_precision) != (method == sim::IntegratorId::course_verlet))
                continue;
            sim::Description description = collapsing(precision, method);
            const auto simulation = sim::Simulation::create(description);
            sim::StepCounts sum;
            for (std::size_t n = 0; n < switches.size(); ++n) {
                INFO("switch " << n);
                for (int i = 0; i < 150; ++i) {
                    const sim::StepCounts counts = simulation->step();
                    sum.self_contacts += counts.self_contacts;
                    sum.contacts += counts.contacts;
                    sum.shortened_springs += counts.shortened_springs;
                }
                switches[n](description.rules);
                const std::uint64_t before = simulation->hash();
                REQUIRE(sim::can_change_live(simulation->description(), description));
                simulation->change(description);
                REQUIRE(simulation->hash() == before); // a change by itself moves nothing
                const auto fresh = sim::Simulation::create(description);
                fresh->load_state(simulation->save_state());
                for (int i = 0; i < 10; ++i) {
                    const sim::StepCounts expected = fresh->step(), counts = simulation->step();
                    REQUIRE(counts.self_contacts == expected.self_contacts);
                    REQUIRE(counts.contacts == expected.contacts);
                    REQUIRE(counts.shortened_springs == expected.shortened_springs);
                }
                REQUIRE(fresh->hash() == simulation->hash());
            }
            REQUIRE((sum.self_contacts > 0 && sum.contacts > 0 && sum.shortened_springs > 0));
            REQUIRE(simulation->diagnose().status == sim::Status::ok);
        }
}

TEST_CASE(
    "Steps by the physical rules have the same bits by any instruction set and number of threads, and allocate none",
    "[threads]") {
    for (const auto self_collision : {sim::SelfCollisionRule::neighbours, sim::SelfCollisionRule::triangles}) {
        std::uint64_t expected = 0;
        for (const sim::InstructionSet set : supported_sets())
            for (const int threads : {1, 3}) {
                sim::Description d = collapsing(sim::Precision::single_precision, sim::IntegratorId::course_verlet);
                d.rules = {.damping = sim::DampingRule::physical,
                           .start = sim::StartRule::physical,
                           .limit = sim::LimitRule::iterated,
                           .friction = sim::FrictionRule::physical,
                           .plane = sim::PlaneRule::physical,
                           .self_collision = self_collision};
                const auto simulation = sim::Simulation::create(d, exactly(set, threads));
                simulation->step();
                const std::size_t before = allocations();
                std::size_t contacts = 0;
                for (int i = 0; i < attempts(600); ++i)
                    contacts += simulation->step().self_contacts;
                REQUIRE(allocations() == before);
                REQUIRE(contacts > 0);
                INFO(name_of(set) << ", " << threads << " threads");
                REQUIRE((expected == 0 || simulation->hash() == expected));
                expected = simulation->hash();
            }
    }
}
