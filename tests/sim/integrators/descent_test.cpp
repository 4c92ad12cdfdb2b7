// Projective dynamics and vertex block descent: both find the solution of backward Euler.
#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <limits>

#include "sim/diagnostics.h"
#include "sim/forces/springs.h"
#include "sim/integrators/global_step.h"
#include "sim/simulation.h"
#include "small_cloth.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

double backward_euler_balance(Sheet<double>& sheet, const sim::Vec3Array<double>& v_n) {
    const sim::Model<double>& model = sheet.model;
    const double dt = model.dt;
    return out_of_balance(sheet, v_n, model.mass * (1 + model.damping_rate * dt) / (dt * dt), model.mass / dt);
}

/// A crumpled cloth after one step.
Sheet<double> stepped(sim::IntegratorId integrator, int iterations, double ks = 5000) {
    sim::Description description = small_cloth(integrator);
    description.stepping.iterations = iterations;
    description.cloth.ks = ks;
    Sheet<double> sheet(description);
    crumple(sheet);
    sheet.step();
    return sheet;
}

const auto projective = sim::IntegratorId::projective_dynamics;
const auto descent = sim::IntegratorId::vertex_block_descent;

} // namespace

TEST_CASE("Projective dynamics and vertex block descent end in backward Euler's balance of a crumpled cloth") {
    const auto integrator = GENERATE(projective, descent);
    sim::Description description = small_cloth(integrator);
    description.cloth.ks = GENERATE(50.0, 5000.0, 2e5);
    description.stepping.iterations = 1000;
    Sheet<double> sheet(description);
    crumple(sheet);
    const sim::Vec3Array<double> v_n = sheet.state.velocity;
    sheet.step();
    REQUIRE(backward_euler_balance(sheet, v_n) < 1e-8);
}

TEST_CASE("Chebyshev's acceleration brings ten iterations of block descent nearer to their end, and does not move it") {
    sim::Description description = small_cloth(descent);
    description.cloth.ks = 2e5; // ten plain iterations are far from enough
    const auto left = [&](double rho, int iterations) {
        description.stepping.acceleration = rho;
        description.stepping.iterations = iterations;
        Sheet<double> sheet(description);
        crumple(sheet);
        const sim::Vec3Array<double> v_n = sheet.state.velocity;
        sheet.step();
        return backward_euler_balance(sheet, v_n);
    };
    const double plain = left(0, 10), accelerated = left(0.7, 10);
    INFO(plain << " " << accelerated << " " << left(0.7, 1000));
    REQUIRE(accelerated < 0.5 * plain);
    REQUIRE(left(0.7, 1000) < 1e-8);
}

TEST_CASE(
    "Block descent's adaptive guess is nearer than inertia for cloth that hangs still, and falls as a stone does") {
    sim::Description description = small_cloth(descent);
    description.cloth.damping_rate = 20;
    description.stepping.first_guess = sim::FirstGuess::adaptive;
    description.stepping.iterations = 50;
    Sheet<double> hanging(description);
    for (int i = 0; i < 3000; ++i)
        hanging.step();
    const sim::State<double> rest = hanging.state;
    const auto end_of_step = [&](sim::FirstGuess guess, int iterations) {
        hanging.state = rest;
        hanging.model.first_guess = guess;
        hanging.model.iterations = iterations;
        hanging.step();
        return hanging.state.position;
    };
    const sim::Vec3Array<double> exact = end_of_step(sim::FirstGuess::adaptive, 2000);
    const auto left = [&](sim::FirstGuess guess) {
        const sim::Vec3Array<double> x = end_of_step(guess, 1);
        double largest = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
            largest =
                std::max(largest, norm(minus(Sheet<double>::coordinates(x, i), Sheet<double>::coordinates(exact, i))));
        return largest;
    };
    const double adaptive = left(sim::FirstGuess::adaptive), inertia = left(sim::FirstGuess::inertia);
    INFO(adaptive << " m " << inertia << " m");
    REQUIRE(adaptive < 0.1 * inertia);

    description.cloth.pinned.clear();
    description.cloth.damping_rate = 0;
    Sheet<double> falling(description);
    for (int i = 0; i < 100; ++i)
        falling.step();
    for (std::size_t i = 0; i < falling.points(); ++i)
        REQUIRE_THAT(falling.state.velocity.y[i], Catch::Matchers::WithinRel(-9.8 * 100 * falling.model.dt, 1e-9));
}

TEST_CASE("A run with the adaptive guess goes on from a saved state, and from a switch to it, bit for bit") {
    sim::Description description = small_cloth(descent);
    description.stepping.precision = sim::Precision::double_precision;
    const auto straight = sim::Simulation::create(description);
    straight->step_frame();
    description.stepping.first_guess = sim::FirstGuess::adaptive;
    straight->change(description);
    for (int i = 0; i < 7; ++i)
        straight->step();
    const auto resumed = sim::Simulation::create(description);
    resumed->load_state(straight->save_state());
    for (int i = 0; i < 20; ++i) {
        straight->step();
        resumed->step();
        REQUIRE(resumed->hash() == straight->hash());
    }
}

TEST_CASE("For a point among pinned ones that pull, block descent is Newton's method: its digits double") {
    sim::Description description = bare_cloth(5, 5);
    for (int row = 0; row < 5; ++row)
        for (int column = 0; column < 5; ++column)
            if (column != 2 || row != 2)
                description.cloth.pinned.push_back({column, row});
    description.cloth.ks = 1e7; // the inertia hardly counts
    description.stepping.integrator = descent;
    const auto left = [&](int iterations) {
        description.stepping.iterations = iterations;
        Sheet<double> sheet(description);
        sim::SplitMix64 random(9);
        for (const std::uint32_t pin : sheet.model.pins) {
            const sim::Vec3 at = sheet.position(pin), out = uniform_point(random, -0.1, 0.1);
            sheet.place(pin, {3 * at.x + out.x, at.y + out.y, 3 * at.z + out.z});
        }
        sheet.place(sheet.at(2, 2), {1.7, 1.2, 1.4});
        const sim::Vec3Array<double> v_n = sheet.state.velocity;
        sheet.step();
        return backward_euler_balance(sheet, v_n);
    };
    const double first = left(1), second = left(2), third = left(3);
    INFO(first << ", " << second << ", " << third);
    REQUIRE(second < 1e-4 * first);
    REQUIRE(third < 1e-6 * second);
}

TEST_CASE("Ten iterations of 1 ms leave 1e-4 of backward Euler's step to projective dynamics, 2e-8 to block descent") {
    const Sheet<double> solution = stepped(descent, 1000);
    const double whole = farthest(solution, solution.state.previous);
    const auto left = [&](sim::IntegratorId integrator) {
        return farthest(stepped(integrator, 10), solution.state.position) / whole;
    };
    REQUIRE_THAT(left(projective), WithinRel(1.08e-4, 0.1));
    REQUIRE_THAT(left(descent), WithinRel(1.6e-8, 0.1));
}

TEST_CASE("With ten iterations of 1 ms the error of both after 0.1 s is backward Euler's to 4 digits") {
    const auto end = [](sim::IntegratorId integrator, int substeps, int iterations) {
        sim::Description description = small_cloth(integrator);
        description.stepping.substeps = substeps;
        description.stepping.iterations = iterations;
        description.stepping.tolerance = 0;
        Sheet<double> sheet(description);
        crumple(sheet);
        for (int i = 0; i < 10 * substeps; ++i)
            sheet.step();
        return sheet;
    };
    const Sheet<double> truth = end(sim::IntegratorId::rk4, 320, 1);
    const auto error = [&](sim::IntegratorId integrator, int iterations) {
        return farthest(end(integrator, 10, iterations), truth.state.position);
    };
    const double backward_euler = error(sim::IntegratorId::backward_euler, 1); // Newton's method, to the tolerance
    REQUIRE_THAT(error(projective, 10), WithinRel(backward_euler, 1e-4));      // 4.0e-5
    REQUIRE_THAT(error(descent, 10), WithinRel(backward_euler, 1e-8));         // 2.1e-9
}

TEST_CASE("Every iteration of projective dynamics lowers the energy that backward Euler minimises") {
    // Its matrix is never less than the energy's second derivative, however crumpled the cloth.
    sim::Description description = small_cloth(projective);
    description.cloth.ks = 2e5;
    description.cloth.damping_rate = 0;
    double last = std::numeric_limits<double>::infinity();
    for (int iterations = 1; iterations <= 30; ++iterations) {
        description.stepping.iterations = iterations;
        Sheet<double> sheet(description);
        crumple(sheet);
        const sim::Vec3Array<double> v_n = sheet.state.velocity;
        sheet.step();
        const double dt = sheet.model.dt;
        double energy = sim::spring_energy(sheet.model, sheet.state.position);
        for (std::size_t i = 0; i < sheet.points(); ++i) {
            if (sheet.model.pinned[i])
                continue;
            const sim::Vec3 v = Sheet<double>::coordinates(v_n, i), d = minus(sheet.position(i), sheet.previous(i));
            const sim::Vec3 off{d.x - dt * v.x, d.y - dt * (v.y - 9.8 * dt), d.z - dt * v.z};
            energy += 0.5 * sheet.model.mass / (dt * dt) * dot(off, off);
        }
        INFO(iterations << " iterations");
        REQUIRE(energy < last);
        last = energy;
    }
}

TEST_CASE("The global step is a dense solution of A I + the springs' Laplacian, without the pinned points") {
    sim::Description description = bare_cloth(7, 5);
    description.cloth.pinned = {{0, 0}, {3, 2}};
    description.cloth.enable_shearing = GENERATE(true, false);
    Sheet<double> sheet(description);
    const double a = 300;
    const auto n = static_cast<Eigen::Index>(sheet.points());
    Eigen::MatrixXd matrix = a * Eigen::MatrixXd::Identity(n, n);
    sheet.for_each_pulling_spring([&](std::uint32_t p, std::uint32_t q, std::size_t s) {
        const double k = sheet.model.spring_constant(s);
        matrix(p, p) += k;
        matrix(q, q) += k;
        matrix(p, q) -= k;
        matrix(q, p) -= k;
    });
    sim::SplitMix64 random(3);
    Eigen::MatrixXd right(n, 3);
    sim::GlobalStep& global = sim::GlobalStep::of(sheet.model, a, sheet.work);
    REQUIRE(global.usable());
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const auto r = static_cast<Eigen::Index>(i);
        for (int axis = 0; axis < 3; ++axis)
            right(r, axis) = global[i][static_cast<std::size_t>(axis)] = uniform(random, -1, 1);
        if (sheet.model.pinned[i]) { // the same as to take it out
            matrix.row(r).setZero();
            matrix.col(r).setZero();
            matrix(r, r) = 1;
        }
    }
    global.solve();
    const Eigen::MatrixXd solution = matrix.ldlt().solve(right);
    for (std::size_t i = 0; i < sheet.points(); ++i)
        if (!sheet.model.pinned[i])
            for (int axis = 0; axis < 3; ++axis)
                REQUIRE_THAT(global[i][static_cast<std::size_t>(axis)],
                             WithinAbs(solution(static_cast<Eigen::Index>(i), axis), 1e-15));
}

TEST_CASE("Projective dynamics factorises anew when anything in its matrix changes") {
    const auto edit = GENERATE(
        as<void (*)(sim::Description&)>(), [](sim::Description& d) { d.cloth.ks *= 2; },
        [](sim::Description& d) { d.stepping.substeps *= 2; }, [](sim::Description& d) { d.cloth.density *= 3; },
        [](sim::Description& d) { d.cloth.enable_shearing = false; },
        [](sim::Description& d) { d.cloth.damping_rate = 100; },
        [](sim::Description& d) {
            d.cloth.pinned.push_back({3, 3});
        });
    sim::Description description = small_cloth(projective);
    Sheet<double> sheet(description), fresh(description);
    crumple(sheet);
    sheet.step();
    edit(description);
    sheet.model = sim::make_model<double>(description, sheet.model.grid); // without prepare(), which begins anew itself
    fresh.model = sheet.model;
    fresh.state = sheet.state;
    sheet.step();
    fresh.step();
    REQUIRE(sheet.state == fresh.state);
}

TEST_CASE("A matrix without a solution is reported as divergence at once") {
    // A mass that is the springs' exact negative: the only point that is free has A + sum of k = 0.
    sim::Description description = bare_cloth(2, 2);
    description.cloth.pinned = {{0, 0}, {1, 0}, {0, 1}};
    description.stepping.integrator = projective;
    description.stepping.frames_per_second = description.stepping.substeps = 1;
    description.cloth.density = -3 * 4;
    description.cloth.ks = 1;
    Sheet<double> sheet(description);
    sheet.step();
    REQUIRE(sim::diagnose(sheet.model, sheet.state).status == sim::Status::diverged);
    REQUIRE(sheet.position(sheet.at(0, 1)) == sim::Vec3{0, 1, 1});
}
