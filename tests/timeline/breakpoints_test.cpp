// Breakpoints hit in exactly the step in which their condition becomes true, every time that it is played.
#include "timeline/breakpoints.h"

#include <algorithm>
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>

#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;
using timeline::Breakpoint;
using timeline::BreakpointKind;

namespace {

/// A cloth on one pin that swings down into a sphere and a plane, folds and comes to rest.
sim::Description lively() {
    sim::Description d;
    d.cloth.num_width_points = d.cloth.num_height_points = 12;
    d.cloth.thickness = 0.04;
    d.cloth.pinned = {{0, 0}};
    d.colliders = {sim::Sphere{{0.5, 0.7, 0.5}, 0.2, 0.2}, sim::Plane{{0, 0.3, 0}, {0, 1, 0}, 0.4}};
    d.stepping.substeps = 15;
    return d;
}

struct Hit {
    std::uint64_t step = 0; ///< steps taken by then
    std::size_t which = 0;
    bool operator==(const Hit&) const = default;
};

std::vector<Hit> hits(sim::Simulation& simulation, timeline::BreakpointWatch& watch, int steps) {
    std::vector<Hit> found;
    for (int i = 0; i < steps; ++i) {
        watch.before_step(simulation);
        const sim::StepCounts counts = simulation.step();
        if (const auto hit = watch.after_step(simulation, counts))
            found.push_back({simulation.steps(), *hit});
    }
    return found;
}

std::vector<Hit> hits(const sim::Description& description, const Breakpoint& breakpoint, int steps) {
    timeline::BreakpointWatch watch;
    watch.set({breakpoint});
    const auto simulation = sim::Simulation::create(description);
    return hits(*simulation, watch, steps);
}

/// The steps in which a condition holds and before which it did not; condition(simulation, counts, energy before).
template <class Condition>
std::vector<Hit> edges(const sim::Description& description, int steps, bool at_start, Condition condition) {
    std::vector<Hit> found;
    const auto simulation = sim::Simulation::create(description);
    bool was = at_start;
    for (int i = 0; i < steps; ++i) {
        const double energy = simulation->diagnose().energy.total();
        const sim::StepCounts counts = simulation->step();
        const bool is = condition(*simulation, counts, energy);
        if (is && !was)
            found.push_back({simulation->steps(), 0});
        was = is;
    }
    return found;
}

constexpr int many = 1500;

} // namespace

TEST_CASE("A breakpoint on strain hits whenever the largest strain gets above its value", "[breakpoints]") {
    std::size_t found = 0;
    for (const double value : {0.02, 0.05, 0.1, 0.12}) {
        const auto expected = edges(lively(), many, false, [&](const sim::Simulation& s, const auto&, double) {
            return s.diagnose().max_strain > value;
        });
        CHECK(hits(lively(), {BreakpointKind::max_strain, value}, many) == expected);
        found += expected.size();
    }
    REQUIRE(found > 3);
}

TEST_CASE("A breakpoint on height hits whenever its point, and no other, passes it in its direction", "[breakpoints]") {
    const sim::GridPoint point{9, 4};
    const auto y = [](const sim::Simulation& s) { return s.position(4 * 12 + 9).y; };
    const auto falls = edges(lively(), many, false, [&](const auto& s, const auto&, double) { return y(s) < 0.85; });
    const auto rises = edges(lively(), many, true, [&](const auto& s, const auto&, double) { return y(s) > 0.85; });
    REQUIRE_FALSE(falls.empty());
    REQUIRE(hits(lively(), {BreakpointKind::point_falls, 0.85, point}, many) == falls);
    REQUIRE(hits(lively(), {BreakpointKind::point_rises, 0.85, point}, many) == rises);

    sim::Description up = bare_cloth(3, 3);
    up.stepping.gravity = {0, 9.8, 0};
    const auto passes =
        edges(up, many, false, [](const auto& s, const auto&, double) { return s.position(0).y > 1.2; });
    REQUIRE(passes.size() == 1);
    REQUIRE(hits(up, {BreakpointKind::point_rises, 1.2, {2, 2}}, many) == passes);
    REQUIRE(hits(up, {BreakpointKind::point_rises, 1.2, {3, 0}}, many).empty()); // there is no such point
    REQUIRE(hits(up, {BreakpointKind::point_falls, 1.2, {-1, 0}}, many).empty());
}

TEST_CASE("A breakpoint on a collider hits in the first step that would have ended inside it", "[breakpoints]") {
    sim::Description falling = bare_cloth(8, 8);
    falling.stepping.gravity = {0, -9.8, 0};
    const auto first_below = [&](auto inside) {
        const auto free = sim::Simulation::create(falling);
        while (!inside(*free))
            free->step();
        return free->steps();
    };
    const sim::Vec3 centre{0.5, 0.6, 0.5};
    const std::uint64_t in_sphere = first_below([&](const sim::Simulation& s) {
        for (std::size_t i = 0; i < s.points(); ++i)
            if (norm(minus(s.position(i), centre)) <= 0.3)
                return true;
        return false;
    });
    const std::uint64_t below_plane = first_below([](const sim::Simulation& s) { return s.position(0).y <= 0.8; });
    const auto first = [&](BreakpointKind kind, const sim::Collider& collider) {
        sim::Description d = falling;
        d.colliders = {collider};
        const auto all = hits(d, {kind, 0}, 800);
        return all.empty() ? 0 : all.front().step;
    };
    const sim::Sphere sphere{centre, 0.3, 0};
    const sim::Plane plane{{0, 0.8, 0}, {0, 1, 0}, 0};
    CHECK(first(BreakpointKind::sphere_contact, sphere) == in_sphere);
    CHECK(first(BreakpointKind::plane_contact, plane) == below_plane);
    CHECK(first(BreakpointKind::sphere_contact, plane) == 0);
    CHECK(first(BreakpointKind::plane_contact, sphere) == 0);
}

TEST_CASE("Breakpoints on contacts hit when a step has some and the one before had none", "[breakpoints]") {
    const auto expected = [](auto count) {
        return edges(lively(), many, false,
                     [&](const auto&, const sim::StepCounts& c, double) { return count(c) > 0; });
    };
    const auto sphere = expected([](const sim::StepCounts& c) { return c.sphere_contacts; });
    const auto plane = expected([](const sim::StepCounts& c) { return c.plane_contacts; });
    const auto self = expected([](const sim::StepCounts& c) { return c.self_contacts; });
    REQUIRE_FALSE(sphere.empty());
    REQUIRE_FALSE(plane.empty());
    REQUIRE_FALSE(self.empty());
    CHECK(hits(lively(), {BreakpointKind::sphere_contact}, many) == sphere);
    CHECK(hits(lively(), {BreakpointKind::plane_contact}, many) == plane);
    CHECK(hits(lively(), {BreakpointKind::self_contact}, many) == self);
}

TEST_CASE("A breakpoint on energy hits when a step gains more than its value", "[breakpoints]") {
    sim::Description gaining = lively();
    gaining.stepping.integrator = sim::IntegratorId::explicit_euler; // which makes energy out of nothing
    const double value = 0.02;
    const auto expected = edges(gaining, 600, false, [&](const sim::Simulation& s, const auto&, double before) {
        return s.diagnose().energy.total() - before > value;
    });
    REQUIRE_FALSE(expected.empty());
    REQUIRE(hits(gaining, {BreakpointKind::energy_gain, value}, 600) == expected);
}

TEST_CASE("A breakpoint on speed hits when a cloth that moved comes to rest, not while it has not begun",
          "[breakpoints]") {
    sim::Description d = lively();
    d.cloth.damping = 3;
    const auto expected = edges(
        d, 3000, true, [](const sim::Simulation& s, const auto&, double) { return s.diagnose().rms_speed < 0.2; });
    REQUIRE_FALSE(expected.empty());
    REQUIRE(expected.front().step > 100);
    REQUIRE(hits(d, {BreakpointKind::rms_speed, 0.2}, 3000) == expected);
}

TEST_CASE("Played again from anywhere, breakpoints hit in the same steps", "[breakpoints]") {
    std::vector<Breakpoint> all;
    for (std::size_t kind = 0; kind < timeline::breakpoint_kinds; ++kind)
        all.push_back({static_cast<BreakpointKind>(kind), timeline::breakpoint_info()[kind].value, {6, 6}});
    timeline::BreakpointWatch watch;
    watch.set(all);
    const auto simulation = sim::Simulation::create(lively());
    const auto start = simulation->save_state();
    const auto first = hits(*simulation, watch, many);
    REQUIRE(first.size() > 5);
    simulation->load_state(start);
    watch.reset();
    REQUIRE(hits(*simulation, watch, many) == first);

    for (const int from : {100, 333, 900}) {
        simulation->load_state(start);
        for (int i = 0; i < from; ++i)
            simulation->step();
        watch.reset();
        auto later = hits(*simulation, watch, many - from);
        std::vector<Hit> expected;
        std::copy_if(first.begin(), first.end(), std::back_inserter(expected),
                     [&](const Hit& hit) { return hit.step > static_cast<std::uint64_t>(from) + 1; });
        std::erase_if(later, [&](const Hit& hit) { return hit.step == static_cast<std::uint64_t>(from) + 1; });
        CHECK(later == expected);
    }
}

TEST_CASE("After a seek, what is true already hits nothing", "[breakpoints]") {
    const auto simulation = sim::Simulation::create(lively());
    while (simulation->diagnose().max_strain <= 0.05 || simulation->step().sphere_contacts == 0)
        simulation->step();
    REQUIRE(simulation->diagnose().max_strain > 0.02);
    timeline::BreakpointWatch watch;
    watch.set({{BreakpointKind::max_strain, 0.02},
               {BreakpointKind::sphere_contact},
               {BreakpointKind::point_falls, 2, {5, 5}}});
    const auto here = simulation->save_state();
    REQUIRE(hits(*simulation, watch, 1).empty());
    simulation->load_state(here);
    watch.reset();
    REQUIRE(hits(*simulation, watch, 1).empty());
}

TEST_CASE("Breakpoints that are off do not hit, and the first of several that hit is told", "[breakpoints]") {
    const Breakpoint falls{BreakpointKind::point_falls, 0.9, {6, 6}};
    Breakpoint off = falls;
    off.on = false;
    timeline::BreakpointWatch watch;
    CHECK_FALSE(watch.any());
    watch.set({off});
    CHECK_FALSE(watch.any());
    const auto simulation = sim::Simulation::create(lively());
    const auto start = simulation->save_state();
    REQUIRE(hits(*simulation, watch, 500).empty());
    simulation->load_state(start);
    watch.set({off, falls, falls});
    CHECK(watch.any());
    const auto found = hits(*simulation, watch, 500);
    REQUIRE(found.size() == 1);
    REQUIRE(found.front().which == 1);
}

TEST_CASE("A breakpoint says what it pauses at, with units", "[breakpoints]") {
    CHECK(timeline::describe({BreakpointKind::max_strain, 0.05}) == "max strain > 5 %");
    CHECK(timeline::describe({BreakpointKind::sphere_contact}) == "sphere contact");
    CHECK(timeline::describe({BreakpointKind::energy_gain, 0.25}) == "energy gain > 0.25 J in a step");
    CHECK(timeline::describe({BreakpointKind::point_falls, 0.5, {3, 4}}) == "point 3, 4 below 0.5 m");
    CHECK(timeline::describe({BreakpointKind::rms_speed, 0.01}) == "RMS speed < 0.01 m/s");
    for (const auto& info : timeline::breakpoint_info()) {
        CHECK(std::string(info.name).size() > 3);
        CHECK(std::string(info.help).ends_with("."));
    }
}
