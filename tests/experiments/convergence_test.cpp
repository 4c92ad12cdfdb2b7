#include "experiments/accuracy/convergence.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>
#include <limits>

#include "sim/random.h"

using namespace clothlab::experiments;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Halved from 1 s on, and errors of them.
struct Refinement {
    std::vector<double> dt, error;
    std::vector<bool> usable;
    Refinement(int steps, double (*error_of)(double)) {
        for (int i = 0; i < steps; ++i) {
            dt.push_back(std::ldexp(1, -i));
            error.push_back(error_of(dt.back()));
            usable.push_back(true);
        }
    }
    auto slope() const { return fit_slope(dt, error, usable); }
};

} // namespace

TEST_CASE("The slope of a power of the step is its exponent, over all of the steps") {
    const auto slope = Refinement(11, [](double dt) { return 7 * std::pow(dt, 4); }).slope();
    REQUIRE(slope);
    CHECK_THAT(slope->slope, WithinAbs(4, 1e-9));
    CHECK_THAT(slope->decades, WithinAbs(10 * std::log10(2.0), 1e-9));
    CHECK(slope->first == 0);
    CHECK(slope->last == 10);
}

TEST_CASE("Where the error is saturated at coarse steps and rounding at fine ones, the slope is of those between") {
    const auto slope = Refinement(30, [](double dt) { return std::min(1.0, 1e3 * dt * dt) + 1e-9; }).slope();
    REQUIRE(slope);
    CHECK_THAT(slope->slope, WithinAbs(2, 0.03));
    CHECK(slope->first == 5); // 1e3 dt² = 1 at dt = 2^-5
    CHECK(slope->last >= 17); // 1e3 dt² is 60 times the rounding at 2^-17
    CHECK(slope->last <= 18);
}

TEST_CASE("Errors that do not fall, fall as steps do not let them, or are too few have no slope") {
    CHECK_FALSE(Refinement(11, [](double) { return 0.3; }).slope());
    CHECK_FALSE(
        Refinement(11, [](double dt) { return std::pow(dt, 2) * (std::fmod(std::log2(dt), 2) == 0 ? 1 : 2); }).slope());
    CHECK_FALSE(Refinement(2, [](double dt) { return dt; }).slope());
}

TEST_CASE("A point that is of no use, or without an error above zero, ends a run of steps") {
    Refinement refinement(11, [](double dt) { return dt; });
    refinement.usable[7] = false;
    auto slope = refinement.slope();
    REQUIRE(slope);
    CHECK(slope->first == 0);
    CHECK(slope->last == 6);
    refinement.error[4] = 0;
    refinement.error[5] = std::numeric_limits<double>::quiet_NaN();
    slope = refinement.slope();
    REQUIRE(slope);
    CHECK(slope->last == 3);
}

TEST_CASE("From steps h, h/2 and h/4 the error of the finest is estimated to its leading term") {
    const auto solution = [](double h) { return 1 + 0.3 * h * h; };
    const double h = 0.1, coarse = std::abs(solution(h) - solution(h / 2)),
                 fine = std::abs(solution(h / 2) - solution(h / 4));
    CHECK_THAT(refined_error(coarse, fine, 2), WithinRel(std::abs(solution(h / 4) - 1), 1e-6));
    // Differences that fall faster than the order allows are not believed.
    CHECK_THAT(refined_error(1, 1e-3, 2), WithinRel(1e-3 / 3, 1e-12));
    // Rounding.
    CHECK(refined_error(3e-14, 5e-14, 5) == 5e-14);
    CHECK(refined_error(0, 0, 5) == 0);
}

TEST_CASE("The Pareto front is what no other point beats") {
    const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
    //                             0    1    2    3    4    5    6    7
    const std::vector<double> cost{1, 2, 2, 3, 4, 5, nan, 0.5}, error{9, 5, 4, 4, 6, 1, 0, inf};
    CHECK(pareto_front(cost, error) == std::vector{true, false, true, false, false, true, false, false});
    CHECK(pareto_front({}, {}).empty());
}

TEST_CASE("On random points the front has all that no other point beats, and nothing else") {
    clothlab::sim::SplitMix64 random(3);
    std::vector<double> cost, error;
    for (int i = 0; i < 300; ++i) {
        cost.push_back(std::floor(20 * random.unit()));
        error.push_back(std::floor(20 * random.unit()));
    }
    const std::vector<bool> front = pareto_front(cost, error);
    for (std::size_t i = 0; i < cost.size(); ++i) {
        bool beaten = false;
        for (std::size_t j = 0; j < cost.size(); ++j)
            beaten = beaten || (cost[j] <= cost[i] && error[j] <= error[i] &&
                                (cost[j] < cost[i] || error[j] < error[i] || j < i));
        REQUIRE(front[i] == !beaten);
    }
}
