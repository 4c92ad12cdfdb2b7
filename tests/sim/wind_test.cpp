// The two winds: the course's formula against the reference, the physical one against hand calculation.
#include "sim/forces/wind.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <numbers>

#include "support/sheet.h"
#include "support/side_by_side.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double rho = 1.3, drag = 0.8, lift = 0.6;

/// A flat sheet of 1 m x 1 m in a wind without gusts.
Sheet<double> sheet_in(sim::Vec3 velocity, double lift_coefficient = 0) {
    sim::Description description = bare_cloth(6, 5);
    description.wind.kind = sim::WindKind::physical;
    description.wind.velocity = velocity;
    description.wind.gust = 0;
    description.wind.air_density = rho;
    description.wind.drag = drag;
    description.wind.lift = lift_coefficient;
    return Sheet<double>(description);
}

sim::Vec3 total_force(Sheet<double>& sheet) {
    sheet.still_forces();
    sim::add_wind_forces(sheet.model, sheet.state, sheet.work.force);
    sim::Vec3 sum;
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 f = Sheet<double>::coordinates(sheet.work.force, i);
        sum = {sum.x + f.x, sum.y + f.y, sum.z + f.z};
    }
    return sum;
}

reference::Parameters windy_cloth(reference::Wind wind) {
    reference::Parameters p;
    p.columns = 7;
    p.rows = 9;
    p.pinned = {{0, 0}, {6, 0}};
    p.vertical = true;
    p.seed = 2;
    p.wind = wind;
    p.wind_velocity = {3, 0.5, 2};
    p.air_density = rho;
    p.drag = drag;
    p.lift = lift;
    p.gust = 0.4;
    p.gust_period = 0.3;
    return p;
}

} // namespace

TEST_CASE("The course's wind equals the reference to the last bit with either clock") {
    reference::Parameters p =
        windy_cloth(GENERATE(reference::Wind::course_with_step, reference::Wind::course_with_time));
    p.vertical = GENERATE(false, true);
    p.offset = {-1.7, 0.4, 2.2};
    require_same_bits(p, [](const sim::StepCounts&) { return true; });
}

TEST_CASE("In long steps, where every bit of the course's wind counts, it equals the reference") {
    reference::Parameters p =
        windy_cloth(GENERATE(reference::Wind::course_with_step, reference::Wind::course_with_time));
    p.frames_per_second = GENERATE(3, 5);
    p.substeps = 1;
    p.ks = 10;
    p.gravity = {};
    require_same_bits(p, [](const sim::StepCounts&) { return true; });
}

TEST_CASE("The course's wind and its two clocks make three different motions") {
    const auto end = [](reference::Wind wind) {
        const auto simulation = sim::Simulation::create(description_of(windy_cloth(wind)));
        for (int frame = 0; frame < 10; ++frame)
            simulation->step_frame();
        return simulation->position(62);
    };
    const sim::Vec3 still = end(reference::Wind::none), step = end(reference::Wind::course_with_step),
                    time = end(reference::Wind::course_with_time);
    REQUIRE(norm(minus(step, still)) > 1e-4);
    REQUIRE(norm(minus(time, still)) > 1e-4);
    REQUIRE(norm(minus(step, time)) > 1e-6);
}

TEST_CASE("The course's wind is its formula") {
    const sim::Triple<double> w = sim::course_wind<double>({0.3, -0.8, 1.7}, 0.25);
    REQUIRE_THAT(w.x, WithinRel(std::sin(0.3 * -0.8 * 0.25), 1e-14));
    REQUIRE_THAT(w.y, WithinRel(1.2 * std::cos(5 * 1.7 * 0.25), 1e-14));
    REQUIRE_THAT(w.z, WithinRel(1.5 * (std::sin(std::cos(5 * 0.3 * -0.8 * 1.7)) - 0.8 / 1.5), 1e-14));
}

TEST_CASE("The course's air resistance is 0.5 |a| |v| v") {
    const sim::Triple<double> r = sim::course_air_resistance<double>({3, 4, 0}, {0, 2, -1});
    REQUIRE(r.x == 0);
    REQUIRE_THAT(r.y, WithinRel(0.5 * 5 * std::sqrt(5.0) * 2, 1e-14));
    REQUIRE_THAT(r.z, WithinRel(-0.5 * 5 * std::sqrt(5.0), 1e-14));
}

TEST_CASE("The physical wind's forces equal the reference's to 1e-12 on a cloth in motion") {
    const reference::Parameters parameters = windy_cloth(reference::Wind::physical);
    Sheet<double> sheet(description_of(parameters));
    reference::Simulator<double> expected(parameters);
    sim::SplitMix64 random(8);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 x = sheet.position(i), r = uniform_point(random, -0.05, 0.05);
        const sim::Vec3 now{x.x + r.x, x.y + r.y, x.z + r.z}, v = uniform_point(random, -2, 2);
        const double dt = sheet.model.dt;
        const sim::Vec3 before{now.x - dt * v.x, now.y - dt * v.y, now.z - dt * v.z};
        sheet.put(sheet.state.position, i, now);
        sheet.put(sheet.state.previous, i, before);
        expected.masses[i].x = {now.x, now.y, now.z};
        expected.masses[i].previous = {before.x, before.y, before.z};
    }
    REQUIRE(norm(total_force(sheet)) > 1);
    expected.parameters.ks = 0; // nothing but the wind
    expected.parameters.gravity = {};
    expected.gather_forces();
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 want = vec3(expected.masses[i].force);
        REQUIRE(norm(want) > 0);
        REQUIRE(norm(minus(Sheet<double>::coordinates(sheet.work.force, i), want)) < 1e-12 * norm(want));
    }
}

TEST_CASE("Ten frames in the physical wind, gusts included, follow the reference") {
    const reference::Parameters parameters = windy_cloth(reference::Wind::physical);
    const auto simulation = sim::Simulation::create(description_of(parameters));
    const auto still = sim::Simulation::create(description_of(windy_cloth(reference::Wind::none)));
    reference::Simulator<double> expected(parameters);
    for (int frame = 0; frame < 10; ++frame) {
        simulation->step_frame();
        still->step_frame();
        expected.frame();
        for (std::size_t i = 0; i < simulation->points(); ++i)
            REQUIRE(norm(minus(simulation->position(i), vec3(expected.masses[i].x))) < 1e-12);
    }
    REQUIRE(norm(minus(simulation->position(62), still->position(62))) > 1e-5);
}

TEST_CASE("A wind along the cloth has no force on it") {
    Sheet<double> sheet = sheet_in({3, 0, -2}, lift);
    REQUIRE(norm(total_force(sheet)) == 0);
}

TEST_CASE("The drag of a wind across the cloth is 0.5 rho Cd A v^2, from either side") {
    const double v = GENERATE(0.1, 4.0, -7.0);
    Sheet<double> sheet = sheet_in({0, v, 0}, lift);
    const sim::Vec3 force = total_force(sheet);
    REQUIRE_THAT(force.y, WithinRel(0.5 * rho * drag * 1 * v * std::abs(v), 1e-12));
    REQUIRE_THAT(force.x, WithinAbs(0, 1e-12));
    REQUIRE_THAT(force.z, WithinAbs(0, 1e-12));
    // A corner with one triangle and one with two share as 1 : 2.
    REQUIRE_THAT(sheet.work.force.y[sheet.at(5, 0)], WithinRel(2 * sheet.work.force.y[sheet.at(0, 0)], 1e-12));
}

TEST_CASE("A slanting wind drags along itself with the cosine and lifts across with cosine times sine") {
    const double angle = GENERATE(0.2, 0.7, 1.4, 2.5), v = 5; // to the cloth's normal
    const sim::Vec3 along{std::sin(angle), std::cos(angle), 0};
    const double pressure = 0.5 * rho * std::abs(std::cos(angle)) * v * v;
    Sheet<double> sheet = sheet_in({v * along.x, v * along.y, 0}, lift);
    const sim::Vec3 force = total_force(sheet);
    REQUIRE_THAT(dot(force, along), WithinRel(drag * pressure, 1e-12));
    const sim::Vec3 across{force.x - drag * pressure * along.x, force.y - drag * pressure * along.y, force.z};
    REQUIRE_THAT(norm(across), WithinRel(lift * pressure * std::sin(angle), 1e-12));
    REQUIRE(across.y * along.y > 0); // to the side that the normal, turned with the wind, points to
    REQUIRE_THAT(force.z, WithinAbs(0, 1e-12));
}

TEST_CASE("A cloth that moves with the air feels nothing") {
    const sim::Vec3 v{2, 3, -1};
    Sheet<double> sheet = sheet_in(v, lift);
    REQUIRE(norm(total_force(sheet)) > 1);
    const double dt = sheet.model.dt;
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 x = sheet.position(i);
        sheet.put(sheet.state.previous, i, {x.x - dt * v.x, x.y - dt * v.y, x.z - dt * v.z});
    }
    REQUIRE(norm(total_force(sheet)) < 1e-20);
}

TEST_CASE("A wind that stands on the cloth but for rounding does not push it sideways") {
    // The sheet stands on (2, 3, 6)/7; rounding leaves an angle of 1e-16 between the wind and its normal.
    const sim::Vec3 normal{2.0 / 7, 3.0 / 7, 6.0 / 7}, e{6.0 / 7, 2.0 / 7, -3.0 / 7}, f{-3.0 / 7, 6.0 / 7, -2.0 / 7};
    Sheet<double> sheet = sheet_in({5 * normal.x, 5 * normal.y, 5 * normal.z}, lift);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 x = sheet.position(i);
        sheet.place(i, {x.x * e.x + x.z * f.x, x.x * e.y + x.z * f.y, x.x * e.z + x.z * f.z});
    }
    const sim::Vec3 force = total_force(sheet);
    const double along = dot(force, normal);
    REQUIRE_THAT(along, WithinRel(0.5 * rho * drag * 25, 1e-9));
    REQUIRE(norm(minus(force, {along * normal.x, along * normal.y, along * normal.z})) < 1e-6 * along);
}

TEST_CASE("Gusts stay within 1 +- gust of the wind, blow along it, and come and go") {
    sim::Wind wind;
    wind.velocity = {3, -1, 2};
    wind.gust = 0.3;
    wind.gust_period = 2;
    double least = 2, most = 0;
    for (int i = 0; i < 5000; ++i) {
        const double time = 0.013 * i;
        const sim::Vec3 air = sim::air_velocity(wind, time);
        const double share = air.x / 3;
        double s = 0;
        for (const double ratio : {1.0, 0.618, 0.377})
            s += std::sin(2 * std::numbers::pi * time / (2 * ratio)) / 3;
        REQUIRE_THAT(share, WithinRel(1 + 0.3 * s, 1e-12));
        REQUIRE_THAT(norm(minus(air, {3 * share, -share, 2 * share})), WithinAbs(0, 1e-12));
        REQUIRE(share > 0.7);
        REQUIRE(share < 1.3);
        least = std::min(least, share);
        most = std::max(most, share);
    }
    REQUIRE(least < 0.8);
    REQUIRE(most > 1.2);
    REQUIRE(sim::air_velocity(wind, 0) == wind.velocity);
}
