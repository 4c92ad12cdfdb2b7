// Spheres and planes by the course's rules: where points end up, what friction does, who is left alone.
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "sim/collision/colliders.h"
#include "support/every_execution.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

const sim::Vec3 centre{0.3, -0.2, 0.1};
constexpr double radius = 0.5;

Sheet<double> sheet_with(const sim::Collider& collider) {
    sim::Description description = bare_cloth(20, 20);
    description.colliders = {collider};
    return Sheet<double>(description);
}

/// Points in and around the box of the sphere, each of which came from another one.
void scatter(Sheet<double>& sheet, std::uint64_t seed) {
    sim::SplitMix64 random(seed);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        sheet.put(sheet.state.position, i, uniform_point(random, -0.7, 0.8));
        sheet.put(sheet.state.previous, i, uniform_point(random, -0.7, 0.8));
    }
}

double from_centre(sim::Vec3 x) {
    return norm(minus(x, centre));
}

} // namespace

TEST_CASE("After the sphere stage no free point is inside the sphere, and points outside have not moved") {
    Sheet<double> sheet = sheet_with(sim::Sphere{centre, radius, 0});
    scatter(sheet, 1);
    const sim::State<double> before = sheet.state;
    const std::size_t contacts = sim::resolve_colliders(sheet.model, sheet.state, sheet.work).all();
    std::size_t inside = 0;
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 was = Sheet<double>::coordinates(before.position, i), is = sheet.position(i);
        REQUIRE(sheet.previous(i) == Sheet<double>::coordinates(before.previous, i));
        if (from_centre(was) > radius) {
            REQUIRE(is == was);
            continue;
        }
        ++inside;
        REQUIRE_THAT(from_centre(is), WithinRel(radius, 1e-14));
        const sim::Vec3 ray = minus(was, centre), out = minus(is, centre); // it went straight out
        REQUIRE_THAT(dot(ray, out), WithinRel(norm(ray) * norm(out), 1e-12));
    }
    REQUIRE(inside > 50);
    REQUIRE(inside < 350);
    REQUIRE(contacts == inside);
}

TEST_CASE("A point at the very centre of a sphere has no direction and stays") {
    Sheet<double> sheet = sheet_with(sim::Sphere{centre, radius, 0});
    for (std::size_t i = 0; i < sheet.points(); ++i)
        sheet.place(i, {0.3, 5, 0.1});
    sheet.put(sheet.state.position, 3, centre);
    REQUIRE(sim::resolve_colliders(sheet.model, sheet.state, sheet.work).all() == 0);
    REQUIRE(sheet.position(3) == centre);
    sheet.put(sheet.state.position, 3, {centre.x, centre.y + 1e-12, centre.z});
    REQUIRE(sim::resolve_colliders(sheet.model, sheet.state, sheet.work).all() == 1);
    REQUIRE_THAT(sheet.position(3).y, WithinRel(centre.y + radius, 1e-12));
}

TEST_CASE("After the plane stage no point that started above is below, and none that started below is above") {
    const sim::Vec3 point{0.1, 0.05, -0.1}, normal{1, 4, -2};
    Sheet<double> sheet = sheet_with(sim::Plane{point, normal, 0});
    scatter(sheet, 2);
    const auto height = [&](sim::Vec3 x) { return dot(minus(x, point), normal) / norm(normal); };
    const sim::State<double> before = sheet.state;
    const std::size_t contacts = sim::resolve_colliders(sheet.model, sheet.state, sheet.work).all();
    std::size_t down = 0, up = 0;
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 was = Sheet<double>::coordinates(before.position, i), is = sheet.position(i);
        const bool started_above = height(sheet.previous(i)) >= 0;
        REQUIRE((height(is) > 0) == started_above);
        if ((height(was) > 0) == started_above) {
            REQUIRE(is == was);
            continue;
        }
        ++(started_above ? down : up);
        REQUIRE_THAT(height(is), WithinAbs(started_above ? 1e-4 : -1e-4, 1e-15)); // the course's offset
    }
    REQUIRE(down > 20);
    REQUIRE(up > 20);
    REQUIRE(contacts == down + up);
}

TEST_CASE("A point that comes to lie on the plane is in contact, and one that starts on it started above") {
    const auto after = [](double from, double to) {
        Sheet<double> sheet = sheet_with(sim::Plane{{0, 0, 0}, {0, 1, 0}, 0});
        sheet.put(sheet.state.previous, 0, {0, from, 0});
        sheet.put(sheet.state.position, 0, {0, to, 0});
        sim::resolve_colliders(sheet.model, sheet.state, sheet.work);
        return sheet.position(0).y;
    };
    REQUIRE_THAT(after(0.5, 0), WithinRel(1e-4, 1e-9));
    REQUIRE_THAT(after(-0.5, 0), WithinRel(-1e-4, 1e-9));
    REQUIRE_THAT(after(0, -0.25), WithinRel(1e-4, 1e-9));
    REQUIRE_THAT(after(0, 0), WithinRel(1e-4, 1e-9));
    REQUIRE(after(0, 0.25) == 0.25);
}

TEST_CASE("A plane's normal counts by its direction, not by its length") {
    Sheet<double> once = sheet_with(sim::Plane{{0, 0, 0}, {0, 1, 0}, 0.25});
    Sheet<double> fourfold = sheet_with(sim::Plane{{0, 0, 0}, {0, 4, 0}, 0.25});
    scatter(once, 3);
    scatter(fourfold, 3);
    REQUIRE(sim::resolve_colliders(once.model, once.state, once.work).all() > 0);
    sim::resolve_colliders(fourfold.model, fourfold.state, fourfold.work);
    REQUIRE(once.state == fourfold.state);
}

TEST_CASE("With friction 1 a point in contact stays where it was, and with less it goes that much of the way") {
    const bool on_sphere = GENERATE(true, false);
    const auto run = [&](double friction) {
        const sim::Collider sphere = sim::Sphere{centre, radius, friction};
        const sim::Collider plane = sim::Plane{{0, 0.05, 0}, {0, 1, 0}, friction};
        Sheet<double> sheet = sheet_with(on_sphere ? sphere : plane);
        scatter(sheet, 4);
        return std::pair{sim::resolve_colliders(sheet.model, sheet.state, sheet.work).all(), std::move(sheet)};
    };
    const auto [contacts, sliding] = run(0);
    const auto [same, creeping] = run(0.75);
    const auto [still, sticking] = run(1);
    REQUIRE(contacts > 50);
    REQUIRE(same == contacts);
    REQUIRE(still == contacts);
    Sheet<double> untouched = sheet_with(sim::Sphere{});
    scatter(untouched, 4);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < sliding.points(); ++i) {
        if (sliding.position(i) == untouched.position(i))
            continue;
        ++moved;
        const sim::Vec3 from = sliding.previous(i);
        REQUIRE(sticking.position(i) == from);
        const sim::Vec3 way = minus(sliding.position(i), from), share = minus(creeping.position(i), from);
        REQUIRE(norm(way) > 0);
        REQUIRE_THAT(norm(minus(share, {0.25 * way.x, 0.25 * way.y, 0.25 * way.z})), WithinAbs(0, 1e-15));
    }
    REQUIRE(moved == contacts);
}

TEST_CASE("A cloth that falls on a sticky slope stays there and on a slippery one slides down") {
    const auto slid = [](double friction) {
        sim::Description description = bare_cloth(6, 6);
        description.stepping.gravity = {0, -9.8, 0};
        description.colliders = {sim::Plane{{1, 1 - 1e-3, 0}, {-1, 20, 0}, friction}}; // it rises along x
        Sheet<double> sheet(description);
        std::size_t contacts = 0;
        for (int i = 0; i < 2700; ++i)
            contacts += sheet.step().contacts;
        REQUIRE(contacts > 100);
        return sheet.position(0).x;
    };
    REQUIRE(std::abs(slid(1)) < 1e-2);
    REQUIRE(slid(0) < -5e-2);
}

TEST_CASE("Colliders act in scene order") {
    const sim::Collider high = sim::Plane{{0, 0.4, 0}, {0, 1, 0}, 0}, low = sim::Plane{{0, 0.1, 0}, {0, 1, 0}, 0};
    const auto height = [](const sim::Collider& first, const sim::Collider& second) {
        sim::Description description = bare_cloth(2, 2);
        description.colliders = {first, second};
        Sheet<double> sheet(description);
        sheet.put(sheet.state.previous, 0, {0, 0.6, 0});
        sheet.put(sheet.state.position, 0, {0, 0, 0});
        return std::pair{sim::resolve_colliders(sheet.model, sheet.state, sheet.work).all(), sheet.position(0).y};
    };
    REQUIRE(height(high, low) == std::pair{std::size_t{1}, 0.4 + 1e-4}); // out of the first, it misses the second
    const auto [contacts, y] = height(low, high);
    REQUIRE(contacts == 2);
    REQUIRE_THAT(y, WithinAbs(0.4 + 1e-4, 1e-15));
}

TEST_CASE("Contacts are counted by what is touched, whatever computes them", "[threads]") {
    const auto sphere_and_plane = [](sim::FrictionRule friction, const sim::Execution& execution) {
        sim::Description description = bare_cloth(60, 60);
        description.rules.friction = friction;
        description.cloth.enable_structural = description.cloth.enable_shearing = description.cloth.enable_bending =
            false;
        description.colliders = {sim::Sphere{centre, radius, 0.1}, sim::Plane{{0, -5, 0}, {0, 1, 0}, 0}};
        Sheet<float> sheet(description, execution);
        for (std::size_t i = 0; i < sheet.points(); ++i)
            sheet.place(i, {0, 5, 0}); // off everything
        for (std::size_t i = 0; i < 3; ++i)
            sheet.place(i, {centre.x, centre.y + 0.1 + 0.1 * static_cast<double>(i), centre.z});
        for (std::size_t i = 100; i < 3600; i += 500) { // they cross the plane in this step
            sheet.put(sheet.state.previous, i, {2, -4.95, 2});
            sheet.put(sheet.state.position, i, {2, -4.98, 2});
        }
        return sheet.step();
    };
    for (const sim::FrictionRule friction : {sim::FrictionRule::cs184, sim::FrictionRule::physical}) {
        for (const sim::InstructionSet set : supported_sets()) {
            for (const int threads : {1, 3}) {
                const sim::StepCounts counts = sphere_and_plane(friction, exactly(set, threads));
                CHECK(counts.sphere_contacts == 3);
                CHECK(counts.plane_contacts == 7);
                CHECK(counts.contacts == 10);
            }
        }
    }
}
