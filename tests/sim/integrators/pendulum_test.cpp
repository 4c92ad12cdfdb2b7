// A mathematical pendulum of a stiff spring: T/T0 = (2/pi) K(sin(theta/2)), with the complete elliptic integral of the
// first kind. L. D. Landau, E. M. Lifshitz, "Mechanics", section 11, problem 1.
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/generators/catch_generators_range.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <numbers>

#include "support/oscillator.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double pi = std::numbers::pi;

/// (2/pi) K(modulus), by Gauss's arithmetic-geometric mean.
double slower_by(double modulus) {
    double a = 1, b = std::sqrt(1 - modulus * modulus);
    while (a - b > 1e-15) {
        const double mean = (a + b) / 2;
        b = std::sqrt(a * b);
        a = mean;
    }
    return 1 / a;
}

/// The period of a pendulum let go at an angle from the vertical, over that of small swings. Four times the time to its
/// first passage through the vertical.
double period(const sim::IntegratorInfo& method, double angle) {
    // The weight stretches the spring by g/omega² = 4e-6 of its length, and omega of the swing is 1/500 of the
    // spring's.
    sim::Description description = column(1, 0.3, method);
    description.stepping.frames_per_second = 5000;
    description.cloth.ks *= std::pow(5000.0 / 64, 2);
    description.stepping.gravity = {0, -9.8, 0};
    description.rules.start = sim::StartRule::physical;
    Sheet<double> sheet(description);
    const double length = 1 + sheet.model.mass * 9.8 * std::cos(angle) / sheet.model.k[0];
    for (const std::size_t i : {sheet.at(0, 1), sheet.at(1, 1)})
        sheet.place(i, {sheet.start.x[i], 1 - length * std::cos(angle), length * std::sin(angle)});
    sim::begin(sheet.model, sheet.state, sheet.work);
    const std::size_t bob = sheet.at(0, 1);
    double before = sheet.state.position.z[bob];
    for (int n = 0; n < 20000; ++n) {
        sheet.step();
        const double now = sheet.state.position.z[bob];
        if (now <= 0)
            return 4 * (n + before / (before - now)) * sheet.model.dt / (2 * pi * std::sqrt(1 / 9.8));
        before = now;
    }
    return 0;
}

} // namespace

TEST_CASE("The elliptic integral gives the pendulum's periods of the textbooks") {
    REQUIRE_THAT(slower_by(std::sin(pi / 12)), WithinAbs(1.017409, 5e-7));
    REQUIRE_THAT(slower_by(std::sin(pi / 4)), WithinAbs(1.180341, 5e-7));
    REQUIRE_THAT(slower_by(std::sin(5 * pi / 12)), WithinAbs(1.762204, 5e-7));
}

TEST_CASE(
    "A pendulum's period grows with its angle as the elliptic integral does, under every method that can hold it") {
    const sim::IntegratorInfo method = GENERATE(from_range(sim::integrators().begin(), sim::integrators().end()));
    if (method.limit(0) == 0 && method.order < 2) // a stiff spring is gone before the first swing
        return;
    const int degrees = GENERATE(30, 90, 150);
    INFO(method.name << " at " << degrees << " degrees");
    const double angle = degrees * pi / 180, expected = slower_by(std::sin(angle / 2));
    REQUIRE_THAT(period(method, angle), WithinRel(expected, method.order >= 2 ? 2e-5 : 2e-3));
}
