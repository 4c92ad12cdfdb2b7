// Pinned points have not moved by a bit, whatever stage wants them to.
#include <catch2/catch_test_macros.hpp>
#include <vector>

#include "sim/simulation.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// Stretched, thick, in the wind, and pinned all over: on the sphere, below the plane, between free neighbours.
sim::Description held_cloth(bool vertical) {
    sim::Description description;
    description.cloth.num_width_points = description.cloth.num_height_points = 10;
    description.cloth.orientation = vertical ? sim::Orientation::vertical : sim::Orientation::horizontal;
    description.cloth.ks = 30;
    description.cloth.thickness = 0.08;
    description.cloth.pinned = {{0, 0}, {1, 0}, {9, 0}, {4, 4}, {5, 4}, {7, 7}, {0, 9}, {9, 9}};
    description.colliders = {sim::Sphere{{0.5, vertical ? 0.4 : 0.95, vertical ? 0.05 : 0.5}, 0.2, 0.2},
                             sim::Plane{{0, vertical ? 0.3 : 0.98, 0}, {0.1, 1, 0}, 0.4}};
    description.wind.kind = sim::WindKind::course;
    description.stepping.accelerations = {{3, -20, 2}};
    return description;
}

template <class Real>
void require_pins_hold(const sim::Description& description) {
    Sheet<Real> sheet(description);
    const sim::State<Real> start = sheet.state;
    sim::StepCounts sum;
    for (int n = 0; n < 300; ++n) {
        const sim::StepCounts counts = sheet.step();
        sum.self_contacts += counts.self_contacts;
        sum.contacts += counts.contacts;
        sum.shortened_springs += counts.shortened_springs;
    }
    REQUIRE(sum.self_contacts > 100);
    REQUIRE(sum.contacts > 100);
    REQUIRE(sum.shortened_springs > 100);
    std::vector<bool> pinned(sheet.points());
    for (const auto& [column, row] : description.cloth.pinned)
        pinned[sheet.at(column, row)] = true;
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const bool held = sheet.position(i) == Sheet<Real>::coordinates(start.position, i) &&
                          sheet.previous(i) == Sheet<Real>::coordinates(start.previous, i);
        REQUIRE(held == pinned[i]);
    }
}

} // namespace

TEST_CASE("Pinned points have not moved by a bit, with sphere, plane, self-collision, limit and wind on them") {
    for (const bool vertical : {false, true}) {
        require_pins_hold<double>(held_cloth(vertical));
        require_pins_hold<float>(held_cloth(vertical));
    }
}

TEST_CASE("A cloth that is pinned everywhere stays as it is") {
    sim::Description description = held_cloth(false);
    description.cloth.pinned.clear();
    for (int row = 0; row < 10; ++row)
        for (int column = 0; column < 10; ++column)
            description.cloth.pinned.push_back({column, row});
    Sheet<double> sheet(description);
    const sim::Vec3Array<double> start = sheet.state.position;
    for (int n = 0; n < 50; ++n) {
        const sim::StepCounts counts = sheet.step();
        REQUIRE(counts.contacts + counts.self_contacts + counts.shortened_springs == 0);
    }
    REQUIRE(sheet.state.position == start);
}

TEST_CASE("A point that is released falls, and one that is caught stays where it was caught") {
    sim::Description description = held_cloth(false);
    description.colliders.clear();
    const auto simulation = sim::Simulation::create(description);
    simulation->step_frame();
    const sim::Vec3 held = simulation->position(0);
    description.cloth.pinned = {{5, 5}};
    simulation->change(description);
    const sim::Vec3 caught = simulation->position(55);
    simulation->step_frame();
    REQUIRE(simulation->position(0).y < held.y);
    REQUIRE(simulation->position(55) == caught);
}
