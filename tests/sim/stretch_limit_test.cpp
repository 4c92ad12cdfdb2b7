// The course's stretch limit: one Gauss-Seidel sweep to 110 % of the rest length.
#include "sim/stretch_limit.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinRel;

namespace {

Sheet<double> stretched(sim::Description description, std::uint64_t seed) {
    Sheet<double> sheet(description);
    sim::SplitMix64 random(seed);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 x = sheet.position(i), r = uniform_point(random, -0.1, 0.1);
        sheet.place(i, {1.3 * x.x + r.x, 1.3 * x.y + r.y, 1.3 * x.z + r.z});
    }
    return sheet;
}

/// Length over rest length of the spring that is swept last: from the last mass to the one two above it.
double last_strain(const Sheet<double>& sheet) {
    const std::size_t a = sheet.points() - 1, b = a - 2 * static_cast<std::size_t>(sheet.model.grid->columns);
    return norm(minus(sheet.position(a), sheet.position(b))) / sheet.model.grid->rest_length(5, a);
}

} // namespace

TEST_CASE("After the sweep the spring swept last is within ten percent") {
    int shortened = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        sim::Description description = bare_cloth(7, 5);
        Sheet<double> sheet = stretched(description, seed);
        REQUIRE(sim::limit_stretch(sheet.model, sheet.state, sheet.work) > 10);
        REQUIRE(last_strain(sheet) <= 1.1 * (1 + 1e-15 * 4));
        if (last_strain(sheet) > 1.1 * (1 - 1e-14))
            ++shortened;
    }
    REQUIRE(shortened > 20); // to just the limit: it was the sweep that did it
}

TEST_CASE("The sweep brings a lone long spring to 110 percent, moving its free ends") {
    sim::Description description = bare_cloth(2, 2);
    const int pins = GENERATE(0, 1, 2);
    if (pins > 0)
        description.cloth.pinned.push_back({0, 0});
    if (pins > 1)
        description.cloth.pinned.push_back({1, 0});
    Sheet<double> sheet(description);
    // Point 0 and 1 are 1.5 m apart instead of 1 m; the others sit where no spring of theirs is long.
    sheet.place(0, {0, 0, 0});
    sheet.place(1, {1.5, 0, 0});
    sheet.place(2, {0.75, 0, 0.5});
    sheet.place(3, {0.75, 0, 0.6});
    REQUIRE(sim::limit_stretch(sheet.model, sheet.state, sheet.work) == (pins == 2 ? 0 : 1));
    const double first = pins == 0 ? 0.2 : 0, second = pins == 0 ? 1.3 : pins == 1 ? 1.1 : 1.5;
    if (first > 0) {
        REQUIRE_THAT(sheet.position(0).x, WithinRel(first, 1e-12));
    } else {
        REQUIRE(sheet.position(0) == sim::Vec3{});
    }
    REQUIRE_THAT(sheet.position(1).x, WithinRel(second, 1e-12));
    REQUIRE(sheet.previous(1) == sim::Vec3{1.5, 0, 0});
}

TEST_CASE("Springs up to ten percent long, and compressed ones, are left alone") {
    Sheet<double> sheet(bare_cloth(6, 6));
    const double scale = GENERATE(0.3, 1.0, 1.0999);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 x = sheet.position(i);
        sheet.place(i, {scale * x.x, x.y, scale * x.z});
    }
    const sim::State<double> before = sheet.state;
    REQUIRE(sim::limit_stretch(sheet.model, sheet.state, sheet.work) == 0);
    REQUIRE(sheet.state == before);
}

TEST_CASE("The limit holds springs of kinds that are switched off") {
    sim::Description description = bare_cloth(5, 5);
    Sheet<double> with = stretched(description, 3);
    description.cloth.enable_structural = description.cloth.enable_shearing = description.cloth.enable_bending = false;
    Sheet<double> without = stretched(description, 3);
    REQUIRE(sim::limit_stretch(with.model, with.state, with.work) > 0);
    sim::limit_stretch(without.model, without.state, without.work);
    REQUIRE(with.state == without.state);
}
