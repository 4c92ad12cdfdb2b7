// Every method on both sides of its own limit, on a chain whose modes are known; and what damping by the step does to
// refinement.
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "sim/integrators/integrator.h"
#include "sim/stability.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinRel;

namespace {

constexpr int columns = 2, rows = 8, masses = rows - 1;
const double pi = std::acos(-1.0);

/// A strip of springs along its length only, held at one end: two equal chains, whose motion along themselves is
/// linear. Its fastest mode is omega = 2 sqrt(k/m) sin((2N - 1) pi / (2 (2N + 1))) and has the shape
/// sin((2N - 1) pi j / (2N + 1)), j = 1 ... N.
sim::Description chain(const sim::IntegratorInfo& method, double damping_percent) {
    sim::Description description = bare_cloth(columns, rows);
    description.cloth.enable_shearing = description.cloth.enable_bending = false;
    description.cloth.pinned = {{0, 0}, {1, 0}};
    description.cloth.damping = damping_percent;
    description.stepping.integrator = method.id;
    description.stepping.tolerance = 0; // no control of the step
    return description;
}

double fastest(const sim::Description& d) {
    return 2 * std::sqrt(d.cloth.ks / sim::point_mass(d.cloth)) *
           std::sin((2 * masses - 1) * pi / (2 * (2 * masses + 1)));
}

double shape(int row) {
    return std::sin((2 * masses - 1) * pi * row / (2 * masses + 1));
}

/// Whether the fastest mode grows at this share of the method's limit: whether, of some thousand steps, the largest
/// amplitude of the later half is above that of the earlier half.
bool grows(const sim::IntegratorInfo& method, double damping_percent, double share) {
    sim::Description description = chain(method, damping_percent);
    const double omega = fastest(description), limit = method.limit(damping_percent / 100);
    description.stepping.frames_per_second = omega / (share * limit * description.stepping.substeps);
    Sheet<double> sheet(description);
    const sim::StabilityMargin margin = sim::stability_margin(sheet.model, sheet.state);
    REQUIRE_THAT(margin.omega, WithinRel(omega, 1e-6));
    REQUIRE(margin.stable() == (share < 1));
    for (int row = 1; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const sim::Vec3 x = sheet.position(sheet.at(column, row));
            sheet.place(sheet.at(column, row), {x.x, x.y, x.z + 1e-4 * shape(row)});
        }
    const auto amplitude = [&] {
        double along = 0, speed = 0;
        for (int row = 1; row < rows; ++row) {
            const std::size_t i = sheet.at(0, row);
            const double x = sheet.state.position.z[i];
            along += shape(row) * (x - sheet.start.z[i]);
            speed += shape(row) * (sheet.state.velocity.size() != 0 ? sheet.state.velocity.z[i]
                                                                    : (x - sheet.state.previous.z[i]) / sheet.model.dt);
        }
        return std::hypot(along, speed / omega);
    };
    constexpr int half = 3000;
    double earlier = 0, later = 0;
    const double begin = amplitude();
    for (int i = 0; i < 2 * half; ++i) {
        sheet.step();
        const double now = amplitude();
        if (now > 100 * begin) // Verlet just below its limit reaches 32; a chain folds up before it reaches 1000
            return true;
        double& largest = i < half ? earlier : later;
        largest = std::max(largest, now);
    }
    return later > earlier * (1 + 1e-4);
}

} // namespace

TEST_CASE("Every explicit method that has a limit holds at 0.999 of it on a chain, and grows at 1.001") {
    int methods = 0;
    for (const sim::IntegratorInfo& method : sim::integrators()) {
        if (!(method.limit(0) > 0 && method.limit(0) < sim::no_limit))
            continue;
        INFO(method.name);
        REQUIRE_FALSE(grows(method, 0, 0.999));
        REQUIRE(grows(method, 0, 1.001));
        ++methods;
    }
    REQUIRE(methods >= 5);
}

TEST_CASE("The limits of the simplest methods hold with damping too, weak and strong") {
    const auto id =
        GENERATE(sim::IntegratorId::course_verlet, sim::IntegratorId::velocity_verlet,
                 sim::IntegratorId::symplectic_euler, sim::IntegratorId::explicit_euler, sim::IntegratorId::heun);
    const double damping = GENERATE(0.2, 20.0);
    const sim::IntegratorInfo& method = sim::integrators()[static_cast<std::size_t>(id)];
    INFO(method.name << ", " << damping << " %");
    REQUIRE_FALSE(grows(method, damping, 0.999));
    REQUIRE(grows(method, damping, 1.001));
}

TEST_CASE("Methods without limit let no mode grow, at ten times the limit of Verlet") {
    for (const sim::IntegratorInfo& method : sim::integrators()) {
        if (method.family != sim::Family::implicit_method || method.limit(0) != sim::no_limit)
            continue;
        INFO(method.name);
        sim::Description description = chain(method, 0);
        description.stepping.tolerance = 1e-6;
        description.stepping.frames_per_second = fastest(description) / (20.0 * description.stepping.substeps);
        Sheet<double> sheet(description);
        for (int row = 1; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                const sim::Vec3 x = sheet.position(sheet.at(column, row));
                sheet.place(sheet.at(column, row), {x.x, x.y, x.z + 1e-4 * shape(row)});
            }
        for (int i = 0; i < 500; ++i)
            sheet.step();
        for (std::size_t i = 0; i < sheet.points(); ++i)
            REQUIRE(norm(minus(sheet.position(i), Sheet<double>::coordinates(sheet.start, i))) < 1.1e-4);
    }
}

namespace {

/// How far a cloth falls from rest in half a second, in m.
double fall(sim::DampingRule rule, int substeps) {
    sim::Description description = bare_cloth(2, 2);
    description.stepping.gravity = {0, -9.8, 0};
    description.rules.damping = rule;
    description.cloth.damping = 2;      // %
    description.cloth.damping_rate = 5; // 1/s
    description.stepping.substeps = substeps;
    Sheet<double> sheet(description);
    for (int i = 0; i < 45 * substeps; ++i)
        sheet.step();
    return 1 - sheet.state.position.y[0];
}

} // namespace

TEST_CASE(
    "With damping per step refinement does not converge: cloth falls with g dt / d, half as fast for half the dt") {
    // x(n) = x(n-1) + u(n), u(n) = (1 - d) u(n-1) + g dt², so that u(n) = g dt² (1 - (1 - d)^n) / d.
    const double g = 9.8, d = 0.02, keep = 1 - d;
    for (const int substeps : {10, 20, 40, 80}) {
        const double dt = 1 / (90.0 * substeps), n = 45 * substeps;
        const double exact = g * dt * dt / d * (n - keep * (1 - std::pow(keep, n)) / d);
        REQUIRE_THAT(fall(sim::DampingRule::cs184, substeps), WithinRel(exact, 1e-9));
    }
    // Towards no fall at all: first order in dt, g dt T / d less what is lost until the end speed is reached.
    const double ratio = fall(sim::DampingRule::cs184, 80) / fall(sim::DampingRule::cs184, 160);
    REQUIRE_THAT(ratio, WithinRel(2.0, 0.01));
    REQUIRE_THAT(fall(sim::DampingRule::cs184, 160), WithinRel(g * 0.5 / (90.0 * 160) / d, 0.01));
}

TEST_CASE("With the physical rule the same refinement converges to v' = g - c v, with first order") {
    const double g = 9.8, c = 5, t = 0.5;
    const double exact = g * (t / c + std::expm1(-c * t) / (c * c));
    const auto error = [&](int substeps) { return fall(sim::DampingRule::physical, substeps) - exact; };
    // Each step moves by dt times the exact speed at its end, so that the error is half a step of the end speed.
    const double speed = -g * std::expm1(-c * t) / c;
    for (const int substeps : {10, 40, 160}) {
        REQUIRE_THAT(error(substeps), WithinRel(0.5 * speed / (90.0 * substeps), 0.01));
        REQUIRE_THAT(error(substeps) / error(2 * substeps), WithinRel(2.0, 0.01));
    }
}
