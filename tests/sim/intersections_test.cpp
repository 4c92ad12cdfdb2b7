// Where the cloth passes through itself, against a count over all pairs with another triangle test.
#include "sim/intersections.h"

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "sim/grid.h"
#include "sim/simulation.h"
#include "support/effort.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

using Index = std::uint32_t;

sim::Vec3 at(const std::vector<float>& positions, Index i) {
    return {static_cast<double>(positions[3 * i]), static_cast<double>(positions[3 * i + 1]),
            static_cast<double>(positions[3 * i + 2])};
}

sim::Vec3 cross(sim::Vec3 a, sim::Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// T. Möller, B. Trumbore, "Fast, minimum storage ray/triangle intersection", Journal of Graphics Tools 2 (1997).
bool passes_through(sim::Vec3 p, sim::Vec3 q, sim::Vec3 a, sim::Vec3 b, sim::Vec3 c) {
    const sim::Vec3 direction = minus(q, p), e1 = minus(b, a), e2 = minus(c, a), s = minus(p, a);
    const sim::Vec3 h = cross(direction, e2), k = cross(s, e1);
    const double determinant = dot(e1, h);
    if (determinant == 0)
        return false;
    const double u = dot(s, h) / determinant, v = dot(direction, k) / determinant, t = dot(e2, k) / determinant;
    return u > 0 && v > 0 && u + v < 1 && t > 0 && t < 1;
}

std::size_t brute_force(int columns, int rows, const std::vector<float>& positions) {
    std::vector<std::array<Index, 3>> triangles;
    std::set<std::array<Index, 2>> edges;
    sim::for_each_triangle(columns, rows, [&](Index a, Index b, Index c) {
        triangles.push_back({a, b, c});
        for (const auto& [p, q] : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
            edges.insert({std::min(p, q), std::max(p, q)});
    });
    std::size_t count = 0;
    for (const auto& [p, q] : edges) {
        for (const auto& [a, b, c] : triangles) {
            if (p == a || p == b || p == c || q == a || q == b || q == c)
                continue;
            if (passes_through(at(positions, p), at(positions, q), at(positions, a), at(positions, b),
                               at(positions, c)))
                ++count;
        }
    }
    return count;
}

std::vector<float> flat(int columns, int rows) {
    std::vector<float> positions;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            for (const double v : {0.1 * column, 1.0, 0.1 * row})
                positions.push_back(static_cast<float>(v));
    return positions;
}

/// The right half folded back over the left, at a slant so that it dips through it, and a little jittered.
std::vector<float> folded(int columns, int rows, std::uint64_t seed) {
    std::vector<float> positions;
    sim::SplitMix64 random(seed);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const int half = columns / 2;
            const double x = column < half ? column : 2 * half - column - 0.37;
            const double y = column < half ? 0 : 0.25 * (1.5 * half - column) + 0.05 * row;
            const sim::Vec3 r = uniform_point(random, -0.01, 0.01);
            for (const double v : {0.1 * x + r.x, 0.1 * y + r.y, 0.1 * row + r.z})
                positions.push_back(static_cast<float>(v));
        }
    }
    return positions;
}

/// Rolled up about one axis and folded in waves along the other, so that many layers cross.
std::vector<float> crumpled(int columns, int rows, std::uint64_t seed, double scale) {
    std::vector<float> positions;
    sim::SplitMix64 random(seed);
    const double turn = uniform(random, 0.25, 0.6), wave = uniform(random, 0.25, 0.6);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double a = turn * column, b = wave * row;
            const sim::Vec3 r = uniform_point(random, -0.1, 0.1);
            for (const double v : {std::sin(a) + r.x, std::cos(1.1 * a) * std::sin(b) + r.y, std::sin(1.3 * b) + r.z})
                positions.push_back(static_cast<float>(scale * v));
        }
    }
    return positions;
}

} // namespace

TEST_CASE("A flat cloth does not pass through itself") {
    REQUIRE(sim::count_intersections(12, 9, flat(12, 9)) == 0);
    for (const auto orientation : {sim::Orientation::horizontal, sim::Orientation::vertical}) {
        sim::Description description;
        description.cloth.orientation = orientation;
        sim::Snapshot snapshot;
        sim::Simulation::create(description)->capture(snapshot);
        REQUIRE(sim::count_intersections(snapshot.columns, snapshot.rows, snapshot.positions) == 0);
    }
}

TEST_CASE("A cloth whose one half is folded through the other has as many intersections as brute force finds") {
    for (const auto& [columns, rows] : {std::pair{12, 9}, {9, 14}, {20, 20}}) {
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            const std::vector<float> positions = folded(columns, rows, seed);
            const std::size_t expected = brute_force(columns, rows, positions);
            REQUIRE(expected > 5);
            REQUIRE(sim::count_intersections(columns, rows, positions) == expected);
        }
    }
}

TEST_CASE("Random clouds have as many intersections as brute force finds, at any scale and with stray points") {
    for (const double scale : {1e-6, 1.0, 1e12}) {
        for (std::uint64_t seed = 0; seed < 5; ++seed) {
            sim::SplitMix64 random(seed);
            std::vector<float> positions;
            for (int i = 0; i < 7 * 6 * 3; ++i)
                positions.push_back(static_cast<float>(uniform(random, -scale, scale)));
            for (int i = 0; i < 3; ++i)
                positions[static_cast<std::size_t>(i)] *= 1000;
            const std::size_t expected = brute_force(7, 6, positions);
            REQUIRE(expected > 100);
            REQUIRE(sim::count_intersections(7, 6, positions) == expected);
        }
    }
}

TEST_CASE("Crumpled sheets of any proportions have as many intersections as brute force finds, with holes too") {
    const double scale = GENERATE(1e-30, 1.0, 1e30);
    for (const auto& [columns, rows] : {std::pair{2, 90}, {90, 2}, {3, 61}, {33, 17}, {16, 35}}) {
        for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(attempts(2)); ++seed) {
            std::vector<float> positions = crumpled(columns, rows, seed, scale);
            const std::size_t whole = brute_force(columns, rows, positions);
            REQUIRE(whole > 20);
            REQUIRE(sim::count_intersections(columns, rows, positions) == whole);
            for (std::size_t i = seed; i < positions.size(); i += 50)
                positions[i] = std::numeric_limits<float>::quiet_NaN();
            const std::size_t left = brute_force(columns, rows, positions);
            REQUIRE(left < whole);
            REQUIRE(sim::count_intersections(columns, rows, positions) == left);
        }
    }
}

TEST_CASE("Positions that are not finite take part in no intersection") {
    std::vector<float> positions = folded(12, 9, 1);
    const std::size_t all = sim::count_intersections(12, 9, positions);
    positions[3 * 40 + 1] = GENERATE(std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity());
    const std::size_t fewer = sim::count_intersections(12, 9, positions);
    REQUIRE(fewer == brute_force(12, 9, positions));
    REQUIRE(fewer <= all);
    for (float& v : positions)
        v = std::numeric_limits<float>::quiet_NaN();
    REQUIRE(sim::count_intersections(12, 9, positions) == 0);
}

TEST_CASE("A cloth of which no triangle is finite but an edge is has no intersection") {
    std::vector<float> positions = flat(2, 2);
    positions[3] = std::numeric_limits<float>::quiet_NaN(); // the upper right point, a corner of both triangles
    REQUIRE(sim::count_intersections(2, 2, positions) == 0);
}

TEST_CASE("All points in one place have no intersection, and many take no time for all pairs") {
    for (const int side : {10, 500}) {
        const auto values = static_cast<std::size_t>(3 * side * side);
        REQUIRE(sim::count_intersections(side, side, std::vector<float>(values, 0.25f)) == 0);
    }
}
