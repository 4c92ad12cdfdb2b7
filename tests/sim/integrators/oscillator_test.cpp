// Every method on the oscillator: its frequency, its damping and its limit are those of its formula.
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "support/choices.h"
#include "support/oscillator.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

double frequency_error(const sim::IntegratorInfo& method, double y) {
    return propagation(method, y).argument() / y - 1;
}
double growth(const sim::IntegratorInfo& method, double y) {
    return propagation(method, y).modulus() - 1;
}

/// The coefficient of y^power in an error that goes on with y^(power + 2).
template <class Error>
double coefficient(const sim::IntegratorInfo& method, int power, Error error) {
    const double y = power < 5 ? 0.1 : 0.2;
    return (4 * error(method, y) / std::pow(y, power) - error(method, 2 * y) / std::pow(2 * y, power)) / 3;
}

} // namespace

TEST_CASE("A step multiplies an oscillation by the exact factor of the method's formula") {
    const sim::IntegratorInfo method = any_method();
    INFO(method.name);
    const ExactMethod* known = exact(method.name);
    if (!known)
        SUCCEED("nothing but its traits is known of it");
    for (const double y : {0.1, 0.3, 0.9}) {
        if (!known)
            break;
        INFO("omega dt = " << y);
        const Propagation measured = propagation(method, y);
        REQUIRE_THAT(measured.modulus(), WithinRel(std::abs(known->factor(y)), 2e-11));
        REQUIRE_THAT(measured.argument(), WithinRel(std::arg(known->factor(y)), 2e-11));
    }
}

TEST_CASE("The frequency error of an oscillation is -y^2/3 for Euler and BDF2, y^2/24 for Verlet, -y^4/120 for RK4, "
          "-y^2/12 for the midpoint rule") {
    const sim::IntegratorInfo method = any_method();
    INFO(method.name);
    if (const ExactMethod* known = exact(method.name)) {
        const Law law = known->frequency_error;
        REQUIRE_THAT(coefficient(method, law.power, frequency_error), WithinRel(law.coefficient, 2e-3));
    } else if (method.order > 0) {
        const double coarse = std::abs(frequency_error(method, 0.2)), fine = std::abs(frequency_error(method, 0.1));
        INFO(coarse << " at y = 0.2, " << fine << " at 0.1");
        REQUIRE((fine < 1e-11 || std::log2(coarse / fine) > method.order - 0.1));
    }
}

TEST_CASE("The growth of an oscillation in a step is y^2/2 for explicit Euler, -y^2/2 for backward Euler, -y^4/4 for "
          "BDF2, nothing for Verlet and the midpoint rule") {
    const sim::IntegratorInfo method = any_method();
    INFO(method.name);
    if (const ExactMethod* known = exact(method.name)) {
        const Law law = known->growth;
        if (law.coefficient == 0)
            REQUIRE_THAT(growth(method, 0.5), WithinAbs(0, 1e-13));
        else
            REQUIRE_THAT(coefficient(method, law.power, growth), WithinRel(law.coefficient, 5e-3));
    } else if (method.order > 0) {
        const double coarse = std::abs(growth(method, 0.2)), fine = std::abs(growth(method, 0.1));
        INFO(coarse << " at y = 0.2, " << fine << " at 0.1");
        REQUIRE((fine < 1e-12 || std::log2(coarse / fine) > method.order + 0.9));
    }
}

TEST_CASE("An oscillation is stable at 0.999 of the method's limit, damped or not, and grows at 1.001") {
    const sim::IntegratorInfo method = any_method();
    INFO(method.name);
    const double limit = method.limit(0), damped_limit = method.limit(0.3);
    if (limit == 0)
        REQUIRE(propagation(method, 0.05).modulus() > 1 + 1e-8);
    if (limit > 0 && limit < sim::no_limit) {
        REQUIRE(propagation(method, 0.999 * limit).modulus() < 1 + 1e-12);
        REQUIRE(propagation(method, 1.001 * limit).modulus() > 1 + 1e-7);
        REQUIRE(propagation(method, 0.999 * damped_limit, 0.3).modulus() < 1 + 1e-12);
        if (damped_limit != limit)
            REQUIRE(propagation(method, 1.001 * damped_limit, 0.3).modulus() > 1 + 1e-7);
    }
}

TEST_CASE("The limits are those of the textbooks") {
    const auto limit = [](std::string_view name) {
        for (const sim::IntegratorInfo& method : sim::integrators())
            if (method.name == name)
                return method.limit(0);
        return -1.0;
    };
    REQUIRE(limit("explicit-euler") == 0);
    REQUIRE(limit("heun") == 0);
    for (const char* verlet : {"course-verlet", "velocity-verlet", "symplectic-euler"})
        REQUIRE(limit(verlet) == 2);
    REQUIRE_THAT(limit("rk4"), WithinAbs(2.828, 5e-4));
    REQUIRE_THAT(limit("dormand-prince"), WithinAbs(0.997, 5e-4));
}

TEST_CASE("Methods without a limit do not grow at omega dt = 100") {
    const sim::IntegratorInfo method = any_method();
    INFO(method.name);
    if (method.family != sim::Family::explicit_method)
        REQUIRE(method.limit(0) == sim::no_limit);
    if (stable(method, 100)) {
        Sheet<double> sheet(column(1, 100, method));
        displace(sheet, 1, 0.01);
        double largest = 0;
        for (int n = 0; n < 300; ++n) {
            sheet.step();
            largest = std::max(largest, std::abs(displacement(sheet, 1)));
        }
        REQUIRE(largest < 0.01 * (1 + 1e-9));
        REQUIRE((largest > 0) == (method.order > 0)); // a rigid rod does not move at all
    }
}
