// Memory: none is allocated while steps are taken, and a run holds so many bytes per point.
#include <catch2/catch_test_macros.hpp>
#include <new>

#include "sim/simulation.h"
#include "support/allocations.h"
#include "support/effort.h"
#include "support/every_execution.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

sim::Description busy(int points) {
    sim::Description d;
    d.cloth.num_width_points = d.cloth.num_height_points = points;
    d.cloth.orientation = sim::Orientation::vertical;
    d.cloth.ks = 300;
    d.cloth.thickness = 0.4 / points;
    d.cloth.pinned = {{0, points - 1}};
    d.colliders = {sim::Plane{{0, 0.005, 0}, {0, 1, 0}, 0.5}, sim::Sphere{{0.5, 0.2, 0.1}, 0.2, 0.1}};
    return d;
}

double bytes_per_point(sim::Description d, int threads = 1) {
    d.cloth.num_width_points = d.cloth.num_height_points = 200;
    const auto simulation = sim::Simulation::create(d, exactly(sim::resolve(sim::InstructionSet::automatic), threads));
    return static_cast<double>(simulation->memory_bytes()) / 40000;
}

} // namespace

TEST_CASE("The counter of allocations counts") {
    const std::size_t before = allocations();
    ::operator delete(::operator new(8)); // a call, which no compiler may leave out
    ::operator delete(::operator new(64, std::align_val_t(64)), std::align_val_t(64));
    REQUIRE(allocations() == before + 2);
}

TEST_CASE("A step allocates no memory, with contacts of all kinds, in wind, and in any way of computing it",
          "[threads]") {
    for (const sim::InstructionSet set : supported_sets())
        for (const int threads : {1, 3})
            for (const sim::WindKind wind : {sim::WindKind::none, sim::WindKind::physical}) {
                sim::Description description = busy(30);
                description.wind.kind = wind;
                const auto simulation = sim::Simulation::create(description, exactly(set, threads));
                sim::StepCounts sum;
                const std::size_t before = allocations();
                for (int i = 0; i < attempts(1200); ++i) {
                    const sim::StepCounts counts = simulation->step();
                    sum.self_contacts += counts.self_contacts;
                    sum.contacts += counts.contacts;
                    sum.shortened_springs += counts.shortened_springs;
                }
                const std::size_t after = allocations();
                INFO(name_of(set) << ", " << threads << " threads");
                REQUIRE(after == before);
                REQUIRE((sum.self_contacts > 0 && sum.contacts > 0 && sum.shortened_springs > 0));
            }
}

TEST_CASE("Many steps at once allocate no memory either, also after a change of the springs", "[threads]") {
    sim::Description description;
    description.cloth.num_width_points = description.cloth.num_height_points = 40;
    description.rules.limit = sim::LimitRule::off;
    description.rules.self_collision = sim::SelfCollisionRule::none;
    const auto simulation =
        sim::Simulation::create(description, exactly(sim::resolve(sim::InstructionSet::automatic), 3));
    const std::size_t held = simulation->memory_bytes();
    for (const double ks : {5000.0, 2000.0}) {
        description.cloth.ks = ks;
        simulation->change(description);
        const std::size_t before = allocations();
        simulation->advance(attempts(1000));
        REQUIRE(allocations() == before);
        REQUIRE(simulation->memory_bytes() == held);
    }
}

TEST_CASE("What a scene does not use costs no memory") {
    if (sim::resolve(sim::InstructionSet::automatic) == sim::InstructionSet::scalar)
        SKIP("no vectors here");
    sim::Description bare;
    bare.rules.self_collision = sim::SelfCollisionRule::none;
    const double springs = bytes_per_point(bare);
    CHECK(springs < 30); // positions and previous positions 24, pins 1, scratch rows
    sim::Description windy = bare;
    windy.wind.kind = sim::WindKind::physical;
    CHECK(bytes_per_point(windy) > springs + 11); // forces 12
    sim::Description standing = bare;
    standing.cloth.orientation = sim::Orientation::vertical;
    CHECK(bytes_per_point(standing) > springs + 23); // rest lengths 24
    const double contacts = bytes_per_point({});
    CHECK(contacts < 125);
    sim::Description exact;
    exact.stepping.precision = sim::Precision::double_precision;
    // 2048 x 2048 within 1 GiB: positions for the picture come on top.
    CHECK(bytes_per_point(exact) * 2048 * 2048 < 0.85 * (1 << 30));
}

TEST_CASE("Threads that take many steps at once hold two thirds of the points each besides", "[threads]") {
    sim::Description springs;
    springs.rules.self_collision = sim::SelfCollisionRule::none;
    springs.rules.limit = sim::LimitRule::off;
    const double more = bytes_per_point(springs, 2) - bytes_per_point(springs);
    if (sim::resolve(sim::InstructionSet::automatic) == sim::InstructionSet::scalar)
        SKIP("no vectors here");
    CHECK(more > 2 * 2.0 / 3 * 24);
    CHECK(more < 40); // with two rows on either side, and scratch rows for the second thread
}
