// What the timeline says of a change of parameters.
#include <catch2/catch_test_macros.hpp>

#include "scene/fields.h"
#include "ui/change_text.h"

namespace clothlab::test {

using ui::describe_change;

TEST_CASE("A changed number is told with what it was, what it is, and the unit that the panels show") {
    const sim::Description before;
    sim::Description after = before;
    after.cloth.ks = 8000;
    CHECK(describe_change(before, after) == "Stiffness ks 5000 -> 8000 N/m");
    after = before;
    after.cloth.density = 70; // kg/m²
    CHECK(describe_change(before, after) == "Density 15 -> 7 g/cm²");
    after = before;
    after.stepping.substeps = 60;
    CHECK(describe_change(before, after) == "Substeps 30 -> 60 per frame");
}

TEST_CASE("Switches, choices and vectors are told by what they read") {
    const sim::Description before;
    sim::Description after = before;
    after.cloth.enable_shearing = false;
    CHECK(describe_change(before, after) == "Shear springs on -> off");
    after = before;
    after.rules.limit = sim::LimitRule::off;
    CHECK(describe_change(before, after).find(" cs184 -> off") != std::string::npos);
    after = before;
    after.stepping.gravity = {0, -1.62, 0};
    CHECK(describe_change(before, after) == "Gravity (0, -9.8, 0) -> (0, -1.62, 0) m/s²");
}

TEST_CASE("Pins and colliders are told, too") {
    sim::Description before;
    before.colliders = {sim::Sphere{}, sim::Plane{}};
    sim::Description after = before;
    std::get<sim::Sphere>(after.colliders[0]).radius = 0.3;
    CHECK(describe_change(before, after) == "Sphere (collider 1) changed");
    after = before;
    after.colliders.pop_back();
    CHECK(describe_change(before, after) == "Colliders 2 -> 1");
    after = before;
    after.cloth.pinned = {{0, 0}};
    CHECK(describe_change(before, after) == "Pins 0 -> 1 points");
}

TEST_CASE("Three differences are written out and the others counted, and equal descriptions differ in nothing") {
    const sim::Description before;
    sim::Description after = before;
    after.cloth.ks = 1;
    after.cloth.damping = 1;
    after.cloth.enable_bending = false;
    after.stepping.substeps = 10;
    after.stepping.gravity.y = 0;
    const std::string text = describe_change(before, after);
    CHECK(text.find("Stiffness ks 5000 -> 1 N/m; ") == 0);
    CHECK(text.find("; and 2 more") != std::string::npos);
    CHECK(describe_change(before, before) == "nothing");
}

TEST_CASE("No parameter of a run changes without being told") {
    for (const scene::Field& f : scene::fields()) {
        if (f.effect == scene::Effect::look || f.type == scene::FieldType::text)
            continue;
        INFO(f.key);
        scene::Scene before, after;
        if (f.type == scene::FieldType::vector) {
            sim::Vec3 v = f.get_vector(after);
            v.x += 1;
            f.set_vector(after, v);
        } else
            f.set(after, f.get(after) == 0 ? 1 : 0);
        CHECK(describe_change(before.simulation, after.simulation).find(std::string(f.label)) == 0);
    }
}

} // namespace clothlab::test
