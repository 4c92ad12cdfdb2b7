// Chains of N masses and springs: their modes, the motion of each mode under every method, and how far a hanging one is
// stretched. F. S. Crawford, "Waves" (Berkeley Physics Course 3), section 2.4.
#include <Eigen/Dense>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <numbers>

#include "sim/forces/forces.h"
#include "support/choices.h"
#include "support/oscillator.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double pi = std::numbers::pi;
constexpr int masses = 9;

/// Frequencies in units of sqrt(k/m), j from 1.
double fixed_free(int j) {
    return 2 * std::sin((2 * j - 1) * pi / (2 * (2 * masses + 1)));
}
double fixed_fixed(int j) {
    return 2 * std::sin(j * pi / (2 * (masses + 1)));
}

/// Pinned at its last row too, with as many free masses.
sim::Description fixed_at_both_ends(double y, const sim::IntegratorInfo& method) {
    sim::Description description = column(masses + 1, y, method);
    description.cloth.pinned.push_back({0, masses + 1});
    description.cloth.pinned.push_back({1, masses + 1});
    return description;
}

/// The frequencies of the cloth's own forces, ascending, in units of sqrt(k/m). Along a straight chain they are linear
/// in the displacements, so that those by an eighth of a rest length give the stiffness matrix to rounding.
std::vector<double> frequencies(const sim::Description& description) {
    Sheet<double> sheet(description);
    const double by = 0.125 * description.cloth.height / (description.cloth.num_height_points - 1);
    Eigen::MatrixXd stiffness(masses, masses);
    for (int j = 0; j < masses; ++j) {
        displace(sheet, j + 1, by);
        sim::evaluate_conservative_forces(sheet.model, sheet.state.position, sheet.work, sheet.work.force);
        for (int i = 0; i < masses; ++i)
            stiffness(i, j) = -sheet.work.force.z[sheet.at(0, i + 1)] / (by * description.cloth.ks);
        displace(sheet, j + 1, 0);
    }
    const Eigen::VectorXd squares = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness).eigenvalues();
    std::vector<double> result;
    for (const double square : squares)
        result.push_back(std::sqrt(square));
    return result;
}

/// Mass `i`, from 1, in mode j of the chain that is fixed at its first end only.
double shape(int j, int i) {
    return std::sin((2 * j - 1) * pi * i / (2 * masses + 1));
}

/// How much of mode j there is, and how large the rest is at any mass, in rest lengths.
std::pair<double, double> projected(const Sheet<double>& sheet, int j) {
    double product = 0, square = 0, rest = 0;
    for (int i = 1; i <= masses; ++i) {
        product += shape(j, i) * displacement(sheet, i);
        square += shape(j, i) * shape(j, i);
    }
    const double amount = product / square;
    for (int i = 1; i <= masses; ++i)
        rest = std::max(rest, std::abs(displacement(sheet, i) - amount * shape(j, i)));
    return {amount, rest};
}

} // namespace

TEST_CASE("A chain fixed at one end has the frequencies 2 sqrt(k/m) sin((2j-1) pi / (2(2N+1)))") {
    const std::vector<double> found = frequencies(column(masses, 0.5, sim::integrators()[0]));
    for (int j = 1; j <= masses; ++j)
        REQUIRE_THAT(found[static_cast<std::size_t>(j - 1)], WithinRel(fixed_free(j), 1e-12));
}

TEST_CASE("A chain fixed at both ends has the frequencies 2 sqrt(k/m) sin(j pi / (2(N+1)))") {
    const std::vector<double> found = frequencies(fixed_at_both_ends(0.5, sim::integrators()[0]));
    for (int j = 1; j <= masses; ++j)
        REQUIRE_THAT(found[static_cast<std::size_t>(j - 1)], WithinRel(fixed_fixed(j), 1e-12));
}

TEST_CASE("Every mode of a chain keeps its shape and has the method's frequency and damping") {
    const sim::IntegratorInfo method = any_method();
    if (method.order == 0) // it moves rigid rods, not springs
        return;
    const int j = GENERATE(1, 2, masses);
    INFO(method.name << ", mode " << j);
    const double k =
        method.limit(0) > 0 ? 0.45 : 0.05; // omega dt of one spring alone; rounding must not outgrow the mode
    Sheet<double> sheet(column(masses, k, method));
    for (int i = 1; i <= masses; ++i)
        displace(sheet, i, 0.01 * shape(j, i));
    double rest = 0;
    const Propagation measured = fit(series(method, 0.01, 200, [&] {
        sheet.step();
        const auto [amount, other] = projected(sheet, j);
        rest = std::max(rest, other);
        return amount;
    }));
    const double y = k * fixed_free(j);
    const bool local = method.family == sim::Family::position_based; // sweeps couple the modes until they converge
    REQUIRE(rest < (local ? 1e-6 : 1e-10));
    if (const ExactMethod* known = exact(method.name)) {
        REQUIRE_THAT(measured.modulus(), WithinRel(std::abs(known->factor(y)), local ? 1e-4 : 1e-9));
        REQUIRE_THAT(measured.argument(), WithinRel(std::arg(known->factor(y)), local ? 1e-3 : 1e-9));
    } else {
        REQUIRE_THAT(measured.argument(), WithinRel(y, std::pow(y, method.order)));
    }
}

TEST_CASE("A hanging chain of N masses is m g N(N+1)/(2k) longer, and finds that length from elsewhere") {
    const sim::IntegratorInfo method = any_method();
    if (method.order == 0) // it has no k
        return;
    INFO(method.name);
    // Methods that make every oscillation grow do so more slowly than damping calms it where omega² dt is below its
    // rate.
    const double y = method.limit(0) > 0 ? 0.3 : 0.06;
    sim::Description description = column(masses, y, method);
    description.rules.damping = sim::DampingRule::physical;
    description.cloth.damping_rate = 2 * fixed_free(1) * y / sim::step_length(description); // critical for the slowest
    const double gravity = 0.008 * description.cloth.ks / sim::point_mass(description.cloth);
    description.stepping.gravity = {0, 0, gravity};
    description.stepping.iterations = 200;
    Sheet<double> sheet(description);
    const double unit = sheet.model.mass * gravity / description.cloth.ks; // how far one mass stretches one spring
    for (int i = 1; i <= masses; ++i)
        displace(sheet, i, 1.01 * unit * (i * masses - 0.5 * i * (i - 1)));
    for (int n = 0; n < 300 / y; ++n)
        sheet.step();
    REQUIRE_THAT(displacement(sheet, masses), WithinRel(unit * masses * (masses + 1) / 2, 1e-10));
    for (int i = 1; i <= masses; ++i)
        REQUIRE_THAT(displacement(sheet, i), WithinRel(unit * (i * masses - 0.5 * i * (i - 1)), 1e-10));
}
