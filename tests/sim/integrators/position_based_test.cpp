// Position based dynamics and XPBD: single springs, which both solve exactly, and what many springs come to.
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "sim/diagnostics.h"
#include "small_cloth.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Two springs that share no point: the diagonals of a square. The first runs from a pin at (0, 0) to (1, 1), the
/// other, free at both ends, from (1, 0) to (0, 1).
sim::Description two_diagonals(sim::IntegratorId integrator) {
    sim::Description description = bare_cloth(2, 2);
    description.cloth.enable_structural = description.cloth.enable_bending = false;
    description.cloth.pinned = {{0, 0}};
    description.stepping.integrator = integrator;
    description.stepping.iterations = 1;
    return description;
}

/// Stretches both diagonals about their middle or pin and lets go.
void stretch_diagonals(Sheet<double>& sheet, double factor) {
    sheet.place(sheet.at(1, 1), {factor, 1, factor});
    sheet.place(sheet.at(1, 0), {0.5 + 0.5 * factor, 1, 0.5 - 0.5 * factor});
    sheet.place(sheet.at(0, 1), {0.5 - 0.5 * factor, 1, 0.5 + 0.5 * factor});
}

double distance(const Sheet<double>& sheet, std::size_t a, std::size_t b) {
    return norm(minus(sheet.position(a), sheet.position(b)));
}

double largest_strain_after(sim::Description description, int steps) {
    Sheet<double> sheet(description);
    for (int i = 0; i < steps; ++i)
        sheet.step();
    return sim::diagnose(sheet.model, sheet.state).max_strain;
}

} // namespace

TEST_CASE("One spring under XPBD, with one iteration, is backward Euler") {
    sim::Description description = two_diagonals(sim::IntegratorId::xpbd);
    description.cloth.ks = GENERATE(1.0, 5000.0, 1e7);
    Sheet<double> sheet(description);
    stretch_diagonals(sheet, 1.1);
    const double dt = sheet.model.dt, rest = std::sqrt(2.0);
    // Stretches and their rates; the free spring has the mass m/2.
    double u[2] = {0.1 * rest, 0.1 * rest}, v[2] = {0, 0};
    for (int i = 0; i < 200; ++i) {
        sheet.step();
        for (int s = 0; s < 2; ++s) {
            const double y2 = (s + 1) * description.cloth.ks / sheet.model.mass * dt * dt;
            v[s] = (v[s] - y2 / dt * u[s]) / (1 + y2);
            u[s] += dt * v[s];
        }
        REQUIRE_THAT(distance(sheet, sheet.at(0, 0), sheet.at(1, 1)) - rest, WithinAbs(u[0], 1e-12));
        REQUIRE_THAT(distance(sheet, sheet.at(1, 0), sheet.at(0, 1)) - rest, WithinAbs(u[1], 1e-12));
    }
}

TEST_CASE("One damped spring under XPBD is backward Euler with a damper, and one that only turns is not damped") {
    sim::Description description = two_diagonals(sim::IntegratorId::xpbd);
    const double beta = GENERATE(0.5, 20.0, 1e6), k = GENERATE(0.0, 5000.0);
    description.cloth.ks = k;
    description.stepping.spring_damping = beta;
    Sheet<double> sheet(description);
    stretch_diagonals(sheet, 1.1);
    const double dt = sheet.model.dt, rest = std::sqrt(2.0);
    Sheet<double>::put(sheet.state.velocity, sheet.at(1, 1), {0.3, 0, 0.3});
    double u = 0.1 * rest, v = 0.3 * rest;
    for (int i = 0; i < 200; ++i) {
        sheet.step();
        v = (v - dt * k / sheet.model.mass * u) / (1 + (k * dt * dt + beta * dt) / sheet.model.mass);
        u += dt * v;
        REQUIRE_THAT(distance(sheet, sheet.at(0, 0), sheet.at(1, 1)) - rest, WithinAbs(u, 1e-12));
    }

    Sheet<double> falling(description);
    for (const auto& [column, row] : {sim::GridPoint{1, 0}, sim::GridPoint{0, 1}}) // the free diagonal, as one
        Sheet<double>::put(falling.state.velocity, falling.at(column, row), {0.1, -2, 0.3});
    falling.step();
    REQUIRE_THAT(falling.state.velocity.y[falling.at(1, 0)], WithinAbs(-2, 1e-12));
}

TEST_CASE("Position based dynamics with k = 1 solves one spring at once, whatever its ks") {
    sim::Description description = two_diagonals(sim::IntegratorId::pbd);
    description.cloth.ks = GENERATE(0.0, 5000.0);
    Sheet<double> sheet(description);
    stretch_diagonals(sheet, GENERATE(0.7, 1.5));
    sheet.step();
    REQUIRE_THAT(distance(sheet, sheet.at(0, 0), sheet.at(1, 1)), WithinAbs(std::sqrt(2.0), 1e-15));
    REQUIRE_THAT(distance(sheet, sheet.at(1, 0), sheet.at(0, 1)), WithinAbs(std::sqrt(2.0), 1e-15));
    REQUIRE(sheet.position(sheet.at(0, 0)) == sim::Vec3{0, 1, 0});
}

TEST_CASE("Position based dynamics leaves 1 - k of one spring's error in a step, however many iterations it has") {
    sim::Description description = two_diagonals(sim::IntegratorId::pbd);
    description.stepping.pbd_stiffness = 0.3;
    description.stepping.iterations = GENERATE(1, 2, 7, 100);
    Sheet<double> sheet(description);
    stretch_diagonals(sheet, 1.5);
    sheet.step();
    const double left = 0.7 * 0.5 * std::sqrt(2.0);
    REQUIRE_THAT(distance(sheet, sheet.at(0, 0), sheet.at(1, 1)) - std::sqrt(2.0), WithinAbs(left, 1e-14));
    REQUIRE_THAT(distance(sheet, sheet.at(1, 0), sheet.at(0, 1)) - std::sqrt(2.0), WithinAbs(left, 1e-14));
}

TEST_CASE("Position based dynamics' bending springs have a fifth of k") {
    sim::Description description = bare_cloth(3, 2);
    description.cloth.enable_structural = description.cloth.enable_shearing = false;
    description.stepping.integrator = sim::IntegratorId::pbd;
    description.stepping.pbd_stiffness = 0.5;
    description.stepping.iterations = 4;
    Sheet<double> sheet(description);
    sheet.place(sheet.at(2, 0), {2, 1, 0});
    sheet.step();
    REQUIRE_THAT(distance(sheet, sheet.at(0, 0), sheet.at(2, 0)) - 1, WithinAbs(0.9, 1e-14));
}

TEST_CASE("Position based dynamics stretches less with more iterations and with shorter steps, and ks does nothing") {
    const auto hung = [](int iterations, int substeps, double ks) {
        sim::Description description = small_cloth(sim::IntegratorId::pbd);
        description.stepping.iterations = iterations;
        description.stepping.substeps = substeps;
        description.stepping.pbd_stiffness = 1;
        description.cloth.ks = ks;
        return largest_strain_after(description, 20 * substeps);
    };
    const double strain = hung(2, 5, 5000);
    REQUIRE(hung(20, 5, 5000) < 0.5 * strain);
    REQUIRE(hung(2, 20, 5000) < 0.7 * strain);
    REQUIRE(hung(2, 5, 50) == strain);
}

TEST_CASE("XPBD with many iterations is backward Euler where no spring turns") {
    // Two rows of bending springs, moved along themselves.
    sim::Description description = small_cloth(sim::IntegratorId::xpbd);
    description.cloth.num_height_points = 2;
    description.cloth.enable_structural = description.cloth.enable_shearing = false;
    description.cloth.ks = GENERATE(5000.0, 1e6);
    description.cloth.pinned = {{0, 0}, {1, 0}, {0, 1}};
    description.rules.damping = GENERATE(sim::DampingRule::cs184, sim::DampingRule::physical);
    description.cloth.damping = 1;
    description.stepping.gravity = {9.8, 0, 0};
    description.stepping.iterations = 2000;
    Sheet<double> sheet(description);
    sim::SplitMix64 random(7);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const double moved = uniform(random, -0.05, 0.05), speed = uniform(random, -1, 1);
        const sim::Vec3 at = sheet.position(i);
        if (sheet.model.pinned[i])
            continue;
        sheet.place(i, {at.x + moved, at.y, at.z});
        sheet.state.velocity.x[i] = speed;
    }
    // Course: the step knows of no damping, then a hundredth of the velocity is lost. Physical: the exact solution of
    // v' = a - c v, with the springs' part of a too, takes the place of v_n + dt a.
    const double dt = sheet.model.dt, m = sheet.model.mass;
    const bool physical = description.rules.damping == sim::DampingRule::physical;
    const double keep = physical ? std::exp(-5.4 * dt) : 1, share = physical ? (1 - keep) / (5.4 * dt) : 1;
    sim::Vec3Array<double> v_n = sheet.state.velocity;
    for (double& v : v_n.x)
        v *= keep;
    sheet.step();
    REQUIRE(out_of_balance(sheet, v_n, m / (share * dt * dt), m / (share * dt)) < 1e-8);
    const std::size_t i = sheet.at(3, 1);
    const double moved = (sheet.position(i).x - sheet.previous(i).x) / dt;
    REQUIRE_THAT(sheet.state.velocity.x[i], WithinRel(physical ? moved : 0.99 * moved, 1e-14));
}

TEST_CASE("Where springs turn, XPBD with many iterations is out of backward Euler's balance, by what falls with dt²") {
    const auto out = [](int substeps) {
        sim::Description description = small_cloth(sim::IntegratorId::xpbd);
        description.cloth.damping_rate = 0;
        description.stepping.substeps = substeps;
        description.stepping.iterations = 1000;
        Sheet<double> sheet(description);
        crumple(sheet);
        const sim::Vec3Array<double> v_n = sheet.state.velocity;
        sheet.step();
        const double dt = sheet.model.dt, m = sheet.model.mass;
        return out_of_balance(sheet, v_n, m / (dt * dt), m / dt);
    };
    const double coarse = out(40), fine = out(80), finer = out(160);
    INFO(coarse << ", " << fine << ", " << finer);
    REQUIRE(finer > 0.01); // of a point's weight: it is there
    REQUIRE_THAT(coarse / fine, WithinAbs(4, 0.3));
    REQUIRE_THAT(fine / finer, WithinAbs(4, 0.1));
}

TEST_CASE("Small steps: ten times the substeps of one iteration are nearer to the truth than ten iterations") {
    // M. Macklin et al. 2019: the same number of sweeps, both against a much finer solution.
    sim::Description description = small_cloth(sim::IntegratorId::rk4);
    description.stepping.substeps = 400;
    const auto end = [](const sim::Description& d) {
        Sheet<double> sheet(d);
        for (int i = 0; i < 20 * d.stepping.substeps; ++i)
            sheet.step();
        return sheet;
    };
    const Sheet<double> truth = end(description);
    description.stepping.integrator = sim::IntegratorId::xpbd;
    const auto error = [&](int substeps, int iterations) {
        description.stepping.substeps = substeps;
        description.stepping.iterations = iterations;
        return farthest(end(description), truth.state.position);
    };
    const double iterated = error(2, 10), small_steps = error(20, 1);
    INFO(iterated << " m with iterations, " << small_steps << " m with small steps");
    REQUIRE(small_steps < 0.3 * iterated);
}
