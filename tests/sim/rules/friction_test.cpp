// Friction on a slope: masses without springs on a plane, with gravity turned by the slope's angle instead of the
// plane.
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <numbers>

#include "sim/collision/colliders.h"
#include "sim/integrators/integrator.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double g = 9.8, degree = std::numbers::pi / 180;

/// Four masses on the plane y = 1, which they begin on; downhill is along x.
sim::Description slope(double angle, double friction, sim::FrictionRule rule, sim::PlaneRule plane) {
    sim::Description description = bare_cloth(2, 2);
    description.cloth.enable_structural = description.cloth.enable_shearing = description.cloth.enable_bending = false;
    description.colliders = {sim::Plane{{0, 1, 0}, {0, 1, 0}, friction}};
    description.rules.friction = rule;
    description.rules.plane = plane;
    description.stepping.gravity = {g * std::sin(angle), -g * std::cos(angle), 0};
    return description;
}
sim::Description coulomb(double angle, double mu) {
    return slope(angle, mu, sim::FrictionRule::physical, sim::PlaneRule::physical);
}

/// How far downhill the masses have gone after some seconds, in m.
template <class Real = double>
double slid(const sim::Description& description, double seconds) {
    Sheet<Real> sheet(description);
    const double from = sheet.position(0).x;
    for (auto n = std::llround(seconds / sheet.model.dt); n > 0; --n)
        sheet.step();
    return sheet.position(0).x - from;
}

} // namespace

TEST_CASE("Coulomb: a mass on a slope sticks iff the tangent of its angle is at most mu, with every method") {
    for (const sim::IntegratorInfo& method : sim::integrators())
        for (const double mu : {0.1, 0.5, 1.0}) {
            INFO(method.name << ", mu " << mu);
            const auto run = [&](double share) {
                sim::Description description = coulomb(std::atan(share * mu), mu);
                description.stepping.integrator = method.id;
                return slid(description, 0.5);
            };
            CHECK(std::abs(run(0.98)) < 1e-12);
            const double angle = std::atan(1.02 * mu), a = g * (std::sin(angle) - mu * std::cos(angle));
            CHECK_THAT(run(1.02), WithinRel(a * 0.5 * 0.5 / 2, 0.03));
        }
}

TEST_CASE("Coulomb: a sliding mass accelerates with g (sin a - mu cos a), with every method and in both precisions") {
    for (const sim::IntegratorInfo& method : sim::integrators())
        for (const double mu : {0.0, 0.3, 0.5}) {
            INFO(method.name << ", mu " << mu);
            const double angle = 40 * degree, a = g * (std::sin(angle) - mu * std::cos(angle));
            sim::Description description = coulomb(angle, mu);
            description.stepping.integrator = method.id;
            CHECK_THAT(slid(description, 1), WithinRel(a / 2, 0.005));
            description.stepping.substeps = 4; // at 30, a step's g dt² is but a few roundings of x
            CHECK_THAT(slid<float>(description, 1), WithinRel(a / 2, 0.02));
        }
}

TEST_CASE("Coulomb: a mass that is thrown downhill where it would stick comes to rest after v²/2a and stays") {
    const double mu = 0.5, angle = 20 * degree, speed = 0.4, a = g * (mu * std::cos(angle) - std::sin(angle));
    Sheet<double> sheet(coulomb(angle, mu));
    for (std::size_t i = 0; i < sheet.points(); ++i)
        sheet.state.previous.x[i] -= speed * sheet.model.dt;
    const double from = sheet.position(0).x;
    for (int n = 0; n < 2700; ++n)
        sheet.step();
    REQUIRE_THAT(sheet.position(0).x - from, WithinRel(speed * speed / (2 * a), 0.01));
    REQUIRE(sheet.position(0) == sheet.previous(0));
}

TEST_CASE("Coulomb: a mass that drops on level ground loses mu times the speed of its impact of its speed along it") {
    const double mu = 0.25, along = 1, fall = 2;
    Sheet<double> sheet(coulomb(0, mu));
    sheet.model.gy = 0; // the impact alone
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 x = sheet.position(i);
        Sheet<double>::put(sheet.state.position, i, {x.x, 1.01, x.z});
        Sheet<double>::put(sheet.state.previous, i, {x.x - along * sheet.model.dt, 1.01 + fall * sheet.model.dt, x.z});
    }
    for (int n = 0; n < 100; ++n)
        sheet.step();
    REQUIRE_THAT((sheet.position(0).x - sheet.previous(0).x) / sheet.model.dt, WithinRel(along - mu * fall, 1e-9));
    REQUIRE_THAT(sheet.position(0).y, WithinAbs(1, 1e-12));
}

TEST_CASE("Coulomb: a mass on a sphere sticks iff the tangent of its angle from the top is at most mu") {
    const double mu = 0.5, radius = 0.7;
    for (const double share : {0.98, 1.02}) {
        sim::Description description = coulomb(0, mu);
        description.colliders = {sim::Sphere{{0.2, -0.3, 0.1}, radius, mu}};
        Sheet<double> sheet(description);
        const double angle = std::atan(share * mu);
        const sim::Vec3 start{0.2 + radius * std::sin(angle), -0.3 + radius * std::cos(angle), 0.1};
        for (std::size_t i = 0; i < sheet.points(); ++i)
            sheet.place(i, start);
        for (int n = 0; n < 1350; ++n)
            sheet.step();
        const double way = norm(minus(sheet.position(0), start));
        if (share < 1) {
            CHECK(way < 1e-9);
        } else {
            CHECK(way > 0.01); // 0.09 m/s² at first, and more as the sphere falls away
            CHECK(way < 0.1);
        }
    }
}

TEST_CASE("The course's friction creeps at any value below 1: 156 mm/s at 0.5 and 30 degrees with 30 substeps") {
    const auto speed = [](double friction, sim::PlaneRule plane) {
        sim::Description d = slope(30 * degree, friction, sim::FrictionRule::cs184, plane);
        d.cloth.damping = 0.2; // the course's; without it, it creeps at 188 mm/s
        return (slid(d, 4) - slid(d, 1)) / 3;
    };
    CHECK_THAT(speed(0.5, sim::PlaneRule::cs184), WithinAbs(0.156, 0.002));
    CHECK(speed(0.9, sim::PlaneRule::cs184) > 0.001);
    CHECK_THAT(speed(1, sim::PlaneRule::cs184), WithinAbs(0, 1e-12));
    // Without the kick it is in contact in every step, and v = (1 - f) ((1 - d) v + g sin a dt) has a limit.
    CHECK_THAT(speed(0.5, sim::PlaneRule::physical), WithinRel(0.5 * g * 0.5 / 2700 / (1 - 0.5 * 0.998), 1e-6));
    CHECK_THAT(speed(1, sim::PlaneRule::physical), WithinAbs(0, 1e-12));
}

TEST_CASE(
    "Coulomb's friction on the course's plane holds a mass only in contact, not while the kick has it in the air") {
    const auto run = [](double friction) {
        return slid(slope(15 * degree, friction, sim::FrictionRule::physical, sim::PlaneRule::cs184), 1);
    };
    const double free = g * std::sin(15 * degree) / 2;
    CHECK_THAT(run(0), WithinRel(free, 0.01));
    CHECK(run(0.2) < 0.5 * free);
    CHECK(run(1) < 0.2 * free);
    CHECK(run(1) > 0.001); // and on the physical plane it sticks
    CHECK(std::abs(slid(coulomb(15 * degree, 1), 1)) < 1e-12);
}

TEST_CASE("The physical plane puts what is below it on it, wherever that came from, and leaves the rest alone") {
    const auto friction = GENERATE(sim::FrictionRule::cs184, sim::FrictionRule::physical);
    for (const double mu : {0.0, 0.6, 1.0}) {
        sim::Description description = bare_cloth(20, 20);
        description.rules.plane = sim::PlaneRule::physical;
        description.rules.friction = friction;
        const sim::Vec3 point{0.1, 0.05, -0.1}, normal{1, 4, -2};
        description.colliders = {sim::Plane{point, normal, mu}};
        description.cloth.pinned = {{3, 3}};
        Sheet<double> sheet(description);
        const auto height = [&](sim::Vec3 x) { return dot(minus(x, point), normal) / norm(normal); };
        sim::SplitMix64 random(5);
        for (std::size_t i = 0; i < sheet.points(); ++i) {
            Sheet<double>::put(sheet.state.position, i, uniform_point(random, -0.7, 0.8));
            Sheet<double>::put(sheet.state.previous, i, uniform_point(random, -0.7, 0.8));
        }
        Sheet<double>::put(sheet.state.position, sheet.at(3, 3), {0, -3, 0});
        const sim::State<double> before = sheet.state;
        const std::size_t contacts = sim::resolve_colliders(sheet.model, sheet.state, sheet.work).all();
        std::size_t below = 0;
        for (std::size_t i = 0; i < sheet.points(); ++i) {
            const sim::Vec3 was = Sheet<double>::coordinates(before.position, i), is = sheet.position(i);
            if (height(was) >= 0 || sheet.model.pinned[i]) {
                REQUIRE(is == was);
                continue;
            }
            ++below;
            REQUIRE(height(is) > -1e-15);
            if (mu == 0 || friction == sim::FrictionRule::physical)
                REQUIRE_THAT(height(is), WithinAbs(0, 1e-15));
            if (mu == 0)
                REQUIRE_THAT(norm(minus(is, was)), WithinAbs(-height(was), 1e-15)); // straight up
        }
        REQUIRE(below > 100);
        REQUIRE(contacts == below);
    }
}
