// What methods keep of the energy.
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "sim/diagnostics.h"
#include "support/methods.h"
#include "support/oscillator.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Smallest and largest total energy of an oscillation, over that at its start.
std::pair<double, double> range_of_energy(sim::IntegratorId id, double y, int steps) {
    Sheet<double> sheet(column(1, y, method_of(id)));
    displace(sheet, 1, 0.2); // so little that no prediction of a method turns the spring round
    const double start = sim::diagnose(sheet.model, sheet.state).energy.total();
    double low = start, high = start;
    for (int n = 0; n < steps; ++n) {
        sheet.step();
        const double now = sim::diagnose(sheet.model, sheet.state).energy.total();
        low = std::min(low, now);
        high = std::max(high, now);
    }
    return {low / start, high / start};
}

} // namespace

TEST_CASE("Implicit midpoint conserves a quadratic energy exactly, whatever the step") {
    const auto [low, high] = range_of_energy(sim::IntegratorId::implicit_midpoint, GENERATE(0.1, 1.0, 4.0), 1000);
    REQUIRE(low > 1 - 1e-12);
    REQUIRE(high < 1 + 1e-12);
    REQUIRE(low != high);
}

TEST_CASE("Verlet's energy swings by y^2/4 and does not drift") {
    // It conserves v²/2 + omega² x²/2 (1 - y²/4): E. Hairer, C. Lubich, G. Wanner, Acta Numerica 12 (2003), section 5.
    for (const double y : {0.05, 0.1, 0.2}) {
        const auto [low, high] = range_of_energy(sim::IntegratorId::velocity_verlet, y, 2000);
        REQUIRE_THAT(1 - low, WithinRel(y * y / 4, 5e-3)); // the lowest point need not be one of the steps
        REQUIRE_THAT(high, WithinAbs(1, 1e-11));
    }
}

TEST_CASE("Explicit Euler gains energy and backward Euler loses it, by a factor of 1 + y^2 in every step") {
    constexpr double y = 0.1;
    REQUIRE_THAT(range_of_energy(sim::IntegratorId::explicit_euler, y, 100).second,
                 WithinRel(std::pow(1 + y * y, 100), 1e-10));
    REQUIRE_THAT(range_of_energy(sim::IntegratorId::backward_euler, y, 100).first,
                 WithinRel(std::pow(1 + y * y, -100), 1e-10));
}
