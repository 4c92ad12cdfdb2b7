// Self-collision by the course's rule, on points placed by hand and on random clouds against brute force.
#include "sim/collision/self_collision.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "support/description_of.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinRel;

namespace {

constexpr double thickness = 0.05; // points are kept 0.1 m apart; cells are 3 * 1 m / 10 = 0.3 m wide

reference::Parameters thick_cloth() {
    reference::Parameters p;
    p.columns = p.rows = 10;
    p.thickness = thickness;
    p.substeps = 5;
    return p;
}

/// A cloth whose points lie far from each other, but for the first two.
Sheet<double> two_points(sim::Vec3 first, sim::Vec3 second) {
    Sheet<double> sheet(description_of(thick_cloth()));
    for (std::size_t i = 0; i < sheet.points(); ++i)
        sheet.place(i, {0, 0, 10 + static_cast<double>(i)});
    sheet.place(0, first);
    sheet.place(1, second);
    return sheet;
}

std::size_t resolve(Sheet<double>& sheet) {
    return sim::resolve_self_collision(sheet.model, sheet.state, sheet.work);
}
double apart(const Sheet<double>& sheet) {
    return norm(minus(sheet.position(0), sheet.position(1)));
}

/// Sets the same cloud of points in both; `reach` m wide, so that from one to very many cells are in use.
template <class Real>
void require_cloud_like_reference(std::uint64_t seed, double reach) {
    reference::Parameters parameters = thick_cloth();
    parameters.pinned = {{3, 3}, {9, 1}, {0, 0}};
    Sheet<Real> sheet(description_of(parameters));
    reference::Simulator<Real> expected(parameters);
    sim::SplitMix64 random(seed);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 x = uniform_point(random, -reach, reach);
        sheet.place(i, x);
        expected.masses[i].x = reference::rounded<Real>({x.x, x.y, x.z});
    }
    const std::size_t pairs = sim::resolve_self_collision(sheet.model, sheet.state, sheet.work);
    expected.collide_with_itself();
    REQUIRE(pairs == expected.acted.self_contacts);
    REQUIRE(pairs > 0);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const reference::Vector<Real> want = expected.masses[i].x;
        REQUIRE(sheet.state.position.x[i] == want.x);
        REQUIRE(sheet.state.position.y[i] == want.y);
        REQUIRE(sheet.state.position.z[i] == want.z);
    }
}

} // namespace

TEST_CASE("Two near points in the same cell end up further apart, the first by its whole push") {
    Sheet<double> sheet = two_points({0.1, 0.1, 0.1}, {0.1, 0.16, 0.1});
    REQUIRE(resolve(sheet) == 2);
    // The first moves by the missing 0.04 m over 5 substeps; the second then lacks 0.1 - 0.068 m.
    REQUIRE_THAT(sheet.position(0).y, WithinRel(0.1 - 0.04 / 5, 1e-12));
    REQUIRE_THAT(sheet.position(1).y, WithinRel(0.16 + 0.032 / 5, 1e-12));
    for (const std::size_t i : {0u, 1u}) {
        REQUIRE(sheet.position(i).x == 0.1);
        REQUIRE(sheet.position(i).z == 0.1);
        REQUIRE_FALSE(sheet.previous(i) == sheet.position(i)); // a push is a velocity, too
    }
}

TEST_CASE("Random near pairs in one cell always end up further apart") {
    sim::SplitMix64 random(9);
    for (int i = 0; i < 500; ++i) {
        Sheet<double> sheet = two_points(uniform_point(random, -0.3, 0), uniform_point(random, -0.3, 0));
        const double before = apart(sheet);
        const std::size_t pairs = resolve(sheet);
        const double after = apart(sheet);
        if (before < 2 * thickness) {
            REQUIRE(pairs == 2);
            REQUIRE(after > before);
            REQUIRE(after < 2 * thickness);
        } else {
            REQUIRE(pairs == 0);
            REQUIRE(after == before);
        }
    }
}

TEST_CASE("Near points in different cells do nothing") {
    for (const auto& [a, b] : {std::pair<sim::Vec3, sim::Vec3>{{0.299, 0.1, 0.1}, {0.301, 0.1, 0.1}},
                               {{0.1, 0.299, 0.1}, {0.1, 0.301, 0.1}},
                               {{0.1, 0.1, -0.001}, {0.1, 0.1, 0.001}},
                               {{-0.001, 0.1, 0.1}, {0.001, 0.1, 0.1}}}) {
        Sheet<double> sheet = two_points(a, b);
        REQUIRE(resolve(sheet) == 0);
        REQUIRE(sheet.position(0) == a);
        REQUIRE(sheet.position(1) == b);
    }
    Sheet<double> sheet = two_points({0.301, 0.1, -0.001}, {0.303, 0.1, -0.003});
    REQUIRE(resolve(sheet) == 2); // and as near, on one side of the border
}

TEST_CASE("Coincident points do nothing") {
    Sheet<double> sheet = two_points({0.1, 0.2, 0.05}, {0.1, 0.2, 0.05});
    REQUIRE(resolve(sheet) == 0);
    REQUIRE(sheet.position(0) == sim::Vec3{0.1, 0.2, 0.05});
    REQUIRE(sheet.position(1) == sim::Vec3{0.1, 0.2, 0.05});
}

TEST_CASE("The mean of several pushes moves a point") {
    Sheet<double> sheet = two_points({0.1, 0.1, 0.1}, {0.1, 0.16, 0.1});
    sheet.place(2, {0.16, 0.1, 0.1});
    resolve(sheet);
    REQUIRE_THAT(sheet.position(0).x, WithinRel(0.1 - 0.04 / 2 / 5, 1e-12));
    REQUIRE_THAT(sheet.position(0).y, WithinRel(0.1 - 0.04 / 2 / 5, 1e-12));
}

TEST_CASE("Points in cells that share a hash slot are pushed by their own cell only, once") {
    const double reach = GENERATE(0.05, 0.3, 0.8); // 8, 8 and 216 cells for 100 points and 128 slots
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        require_cloud_like_reference<double>(seed, reach);
        require_cloud_like_reference<float>(seed, reach);
    }
}

TEST_CASE("A folded cloth in free fall equals the reference to the last bit for 200 steps") {
    reference::Parameters parameters = thick_cloth();
    parameters.pinned = {{9, 9}};
    parameters.ks = 200;
    Sheet<double> sheet(description_of(parameters));
    reference::Simulator<double> expected(parameters);
    for (int row = 0; row < 10; ++row) {
        for (int column = 0; column < 10; ++column) { // hangs in two layers 20 mm apart, and below the origin
            const double z = row < 5 ? 0.01 : -0.01, y = -0.1 * (row < 5 ? row : 9 - row);
            const std::size_t i = sheet.at(column, row);
            sheet.place(i, {0.11 * column, y, z});
            expected.masses[i].x = expected.masses[i].previous = {0.11 * column, y, z};
        }
    }
    std::size_t pairs = 0;
    for (int n = 0; n < 200; ++n) {
        pairs += sheet.step().self_contacts;
        expected.step();
    }
    REQUIRE(pairs > 1000);
    for (std::size_t i = 0; i < sheet.points(); ++i)
        REQUIRE(sheet.position(i) == vec3(expected.masses[i].x));
}
