// The stretch limit that is swept over until it holds.
#include "sim/iterated_limit.h"

#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <limits>

#include "sim/stretch_limit.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;

namespace {

/// The longest spring, in rest lengths, of those with a free end.
template <class Real>
double longest(const Sheet<Real>& sheet) {
    double most = 0;
    sim::for_each_spring(sheet.model.grid->columns, sheet.model.grid->rows,
                         [&](std::uint32_t a, std::uint32_t b, std::size_t s) {
                             if (!(sheet.model.pinned[a] && sheet.model.pinned[b]))
                                 most = std::max(most, norm(minus(sheet.position(a), sheet.position(b))) /
                                                           static_cast<double>(sheet.model.grid->rest_length(s, a)));
                         });
    return most;
}

template <class Real>
Sheet<Real> pulled(double tolerance, double by) {
    sim::Description description = bare_cloth(12, 12);
    for (int column = 0; column < 12; ++column)
        description.cloth.pinned.push_back({column, 0});
    description.stepping.tolerance = tolerance;
    description.rules.limit = sim::LimitRule::iterated;
    Sheet<Real> sheet(description);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 x = sheet.position(i);
        sheet.place(i, {x.x, x.y, by * x.z});
    }
    return sheet;
}

} // namespace

TEST_CASE("After the iterated limit no spring is longer than 1.1 + tolerance, where one sweep leaves many so") {
    for (const double tolerance : {1e-2, 1e-3}) {
        Sheet<double> once = pulled<double>(tolerance, 1.3);
        sim::limit_stretch(once.model, once.state, once.work);
        REQUIRE(longest(once) > 1.1 + tolerance);
        Sheet<double> sheet = pulled<double>(tolerance, 1.3);
        const std::size_t shortened = sim::limit_stretch_iterated(sheet.model, sheet.state);
        INFO("tolerance " << tolerance << ", " << shortened << " shortened");
        CHECK(shortened > 100);
        CHECK(longest(sheet) <= 1.1 + tolerance + 1e-12);
        CHECK(sim::limit_stretch_iterated(sheet.model, sheet.state) == 0); // and then it is idle
        Sheet<float> single = pulled<float>(tolerance, 1.3);
        sim::limit_stretch_iterated(single.model, single.state);
        CHECK(longest(single) <= 1.1 + tolerance + 1e-5);
    }
}

TEST_CASE("The iterated limit leaves springs alone that are at most ten percent long") {
    Sheet<double> sheet = pulled<double>(0, 1.0999);
    const sim::State<double> before = sheet.state;
    REQUIRE(sim::limit_stretch_iterated(sheet.model, sheet.state) == 0);
    REQUIRE(sheet.state == before);
}

TEST_CASE("The iterated limit conserves the momentum of free cloth and moves no pin") {
    Sheet<double> sheet = pulled<double>(1e-3, 1.4);
    const sim::Vec3 pin = sheet.position(0);
    sim::limit_stretch_iterated(sheet.model, sheet.state);
    REQUIRE(sheet.position(0) == pin);
    Sheet<double> free = pulled<double>(1e-3, 1.4);
    free.model.pinned.assign(free.points(), 0);
    const auto middle = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < free.points(); ++i)
            sum += free.position(i).z;
        return sum / static_cast<double>(free.points());
    };
    const double before = middle();
    REQUIRE(sim::limit_stretch_iterated(free.model, free.state) > 0);
    REQUIRE_THAT(middle(), WithinAbs(before, 1e-14));
}

TEST_CASE("Where pins are too far apart for the limit it gives up after its last sweep, and the run goes on") {
    sim::Description description = bare_cloth(5, 2);
    description.rules.limit = sim::LimitRule::iterated;
    description.cloth.pinned = {{0, 0}, {4, 0}};
    Sheet<double> sheet(description);
    sheet.place(4, {2, 1, 0}); // 2 m, where 1.1 m of cloth hang
    const std::size_t springs = 8 + 5 + 8 + 6;
    const std::size_t shortened = sim::limit_stretch_iterated(sheet.model, sheet.state);
    REQUIRE(shortened >= static_cast<std::size_t>(sim::most_limit_sweeps));
    REQUIRE(shortened <= springs * static_cast<std::size_t>(sim::most_limit_sweeps));
    REQUIRE(longest(sheet) > 1.5);
    for (int n = 0; n < 10; ++n)
        REQUIRE(sheet.step().shortened_springs > 0);
    REQUIRE(std::isfinite(sheet.position(7).y));
}

TEST_CASE("A hanging cloth keeps to the iterated limit in every step, however soft it is") {
    sim::Description description = bare_cloth(10, 10);
    description.cloth.pinned = {{0, 0}, {9, 0}};
    description.cloth.ks = 20;
    description.cloth.damping = 0.2;
    description.stepping.gravity = {0, -9.8, 0};
    description.stepping.tolerance = 1e-2;
    description.rules.limit = sim::LimitRule::iterated;
    Sheet<double> sheet(description);
    std::size_t shortened = 0;
    for (int n = 0; n < 600; ++n) {
        shortened += sheet.step().shortened_springs;
        REQUIRE(longest(sheet) <= 1.11 + 1e-12);
    }
    REQUIRE(shortened > 0);
}
