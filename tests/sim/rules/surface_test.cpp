// Self-collision by neighbours and by triangles.
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "sim/collision/closest.h"
#include "sim/collision/self_collision.h"
#include "sim/intersections.h"
#include "support/effort.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using sim::SelfCollisionRule;

namespace {

sim::Description cloth(int columns, int rows, SelfCollisionRule rule, double thickness) {
    sim::Description description = bare_cloth(columns, rows);
    description.rules.self_collision = rule;
    description.cloth.thickness = thickness;
    return description;
}

template <class Real>
std::size_t resolve(Sheet<Real>& sheet) {
    return sim::resolve_self_collision(sheet.model, sheet.state, sheet.work);
}

template <class Real>
sim::Vec3 middle(const Sheet<Real>& sheet) {
    sim::Vec3 sum;
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 x = sheet.position(i);
        sum = {sum.x + x.x, sum.y + x.y, sum.z + x.z};
    }
    const auto n = static_cast<double>(sheet.points());
    return {sum.x / n, sum.y / n, sum.z / n};
}

double distance(const Sheet<double>& sheet, std::size_t i, std::size_t q) {
    return norm(minus(sheet.position(i), sheet.position(q)));
}

/// A sheet whose points lie hundreds of metres apart, rows 0 to 2 below y = 0 and the others above.
Sheet<double> far_apart(SelfCollisionRule rule, double thickness, std::vector<sim::GridPoint> pinned = {}) {
    sim::Description description = cloth(6, 6, rule, thickness);
    description.cloth.pinned = std::move(pinned);
    Sheet<double> sheet(description);
    sim::SplitMix64 random(3);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        sim::Vec3 x = uniform_point(random, 100, 1000);
        x.y = i < 18 ? -x.y : x.y;
        sheet.place(i, x);
    }
    return sheet;
}

/// A cloth folded in two layers 120 mm apart: the lower one, rows 0 to 7, is pinned, and so is the crease; the rest of
/// the upper one falls on it.
Sheet<double> folded(SelfCollisionRule rule, double thickness) {
    sim::Description description = cloth(8, 16, rule, thickness);
    description.cloth.height = 2;
    description.cloth.damping = 1;
    description.cloth.ks = 500;
    description.stepping.gravity = {0, -9.8, 0};
    for (int row = 0; row < 9; ++row)
        for (int column = 0; column < 8; ++column)
            description.cloth.pinned.push_back({column, row});
    Sheet<double> sheet(description);
    for (int row = 0; row < 16; ++row)
        for (int column = 0; column < 8; ++column) {
            const double x = column / 7.0, z = (row < 8 ? row : 15 - row) / 7.5;
            // The upper layer is a little smaller, so that few points fall on points and none beside the lower layer.
            sheet.place(sheet.at(column, row),
                        row < 8 ? sim::Vec3{x, 0, z} : sim::Vec3{0.04 + 0.92 * x, 0.12, 0.06 + 0.9 * z});
        }
    return sheet;
}

double lowest_of_upper_layer(const Sheet<double>& sheet) {
    double low = 1;
    for (std::size_t i = 64; i < sheet.points(); ++i)
        low = std::min(low, sheet.position(i).y);
    return low;
}

std::size_t intersections(const Sheet<double>& sheet) {
    std::vector<float> positions;
    for (std::size_t i = 0; i < sheet.points(); ++i)
        for (const double v : {sheet.position(i).x, sheet.position(i).y, sheet.position(i).z})
            positions.push_back(static_cast<float>(v));
    return sim::count_intersections(sheet.model.grid->columns, sheet.model.grid->rows, positions);
}

} // namespace

TEST_CASE("Neighbours: two near points anywhere end up twice the thickness apart, around the middle they had") {
    sim::SplitMix64 random(1);
    for (int n = 0; n < 300; ++n) {
        Sheet<double> sheet = far_apart(SelfCollisionRule::neighbours, 0.05);
        const sim::Vec3 x = uniform_point(random, -0.5, 0.5), d = uniform_point(random, -0.057, 0.057);
        sheet.place(2, x);
        sheet.place(33, {x.x + d.x, x.y + d.y, x.z + d.z});
        REQUIRE(resolve(sheet) == 2);
        REQUIRE_THAT(distance(sheet, 2, 33), WithinRel(0.1, 1e-12));
        const sim::Vec3 a = sheet.position(2), b = sheet.position(33);
        REQUIRE_THAT(a.x + b.x - 2 * x.x - d.x, WithinAbs(0, 1e-14));
        REQUIRE_THAT(a.y + b.y - 2 * x.y - d.y, WithinAbs(0, 1e-14));
        REQUIRE_THAT(a.z + b.z - 2 * x.z - d.z, WithinAbs(0, 1e-14));
    }
}

TEST_CASE("Neighbours: of a pair with a pinned point the other moves all the way, and two pinned ones stay") {
    for (const bool both : {false, true}) {
        std::vector<sim::GridPoint> pinned{{2, 0}};
        if (both)
            pinned.push_back({3, 5});
        Sheet<double> sheet = far_apart(SelfCollisionRule::neighbours, 0.05, pinned);
        sheet.place(2, {0, 0, 0});
        sheet.place(33, {0, 0.02, 0});
        REQUIRE(resolve(sheet) == (both ? 0 : 2));
        REQUIRE(sheet.position(2) == sim::Vec3{0, 0, 0});
        REQUIRE_THAT(sheet.position(33).y, WithinRel(both ? 0.02 : 0.1, 1e-12));
    }
}

TEST_CASE("Neighbours: repeated, it leaves no two points of a random cloud nearer than twice the thickness") {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        Sheet<double> sheet(cloth(10, 10, SelfCollisionRule::neighbours, 0.03)); // 0.11 m between its points at rest
        sim::SplitMix64 random(seed);
        for (std::size_t i = 0; i < sheet.points(); ++i)
            sheet.place(i, uniform_point(random, -0.25, 0.25));
        const sim::Vec3 before = middle(sheet);
        REQUIRE(resolve(sheet) > 20);
        for (int n = 0; n < 300; ++n)
            resolve(sheet);
        for (std::size_t i = 0; i < sheet.points(); ++i)
            for (std::size_t q = 0; q < i; ++q)
                REQUIRE(distance(sheet, i, q) > 0.06 * (1 - 1e-6));
        REQUIRE(norm(minus(middle(sheet), before)) < 1e-14); // momentum is conserved
    }
}

TEST_CASE("A flat sheet is moved neither by neighbours nor by triangles, however thick it is") {
    const auto rule = GENERATE(SelfCollisionRule::neighbours, SelfCollisionRule::triangles);
    for (const double thickness : {0.0095, 0.0102, 0.03}) {
        const auto require_still = [&](auto sheet) {
            const auto before = sheet.state;
            INFO("thickness " << thickness);
            REQUIRE(resolve(sheet) == 0);
            REQUIRE(sheet.state == before);
        };
        sim::Description description = cloth(20, 30, rule, thickness);
        description.cloth.width = 19.0 / 49;
        description.cloth.height = 29.0 / 49; // 20.4 mm between points, as the default cloth has
        require_still(Sheet<double>(description));
        require_still(Sheet<float>(description));
        description.cloth.orientation = sim::Orientation::vertical;
        require_still(Sheet<double>(description));
    }
}

TEST_CASE("A point before the middle of a coarse triangle is caught by triangles, but not by neighbours") {
    for (const auto rule : {SelfCollisionRule::neighbours, SelfCollisionRule::triangles}) {
        Sheet<double> sheet = far_apart(rule, 0.05);
        const std::size_t a = sheet.at(0, 0), b = sheet.at(1, 0), c = sheet.at(0, 1), p = sheet.at(5, 5);
        sheet.place(a, {0, 0, 0});
        sheet.place(b, {1, 0, 0});
        sheet.place(c, {0, 0, 1});
        sheet.place(p, {0.25, 0.02, 0.5});
        if (rule == SelfCollisionRule::neighbours) {
            REQUIRE(resolve(sheet) == 0);
            continue;
        }
        REQUIRE(resolve(sheet) == 2);
        // Barycentric weights 1/4, 1/4, 1/2: the missing 0.08 m are shared out as w / (1 + 1/16 + 1/16 + 1/4).
        const double push = 0.08 / 1.375;
        CHECK_THAT(sheet.position(p).y, WithinRel(0.02 + push, 1e-12));
        CHECK_THAT(sheet.position(a).y, WithinRel(-push / 4, 1e-12));
        CHECK_THAT(sheet.position(b).y, WithinRel(-push / 4, 1e-12));
        CHECK_THAT(sheet.position(c).y, WithinRel(-push / 2, 1e-12));
        CHECK_THAT(sheet.position(p).x, WithinRel(0.25, 1e-12));
    }
}

TEST_CASE("Triangles: two edges that cross at a distance end up twice the thickness apart, by their shares") {
    for (const bool pinned : {false, true}) {
        Sheet<double> sheet =
            far_apart(SelfCollisionRule::triangles, 0.05,
                      pinned ? std::vector<sim::GridPoint>{{0, 0}, {1, 0}} : std::vector<sim::GridPoint>{});
        const std::size_t a = sheet.at(0, 0), b = sheet.at(1, 0), c = sheet.at(4, 5), d = sheet.at(5, 5);
        sheet.place(a, {0, 0, 0});
        sheet.place(b, {1, 0, 0});
        sheet.place(c, {0.25, 0.02, -0.5});
        sheet.place(d, {0.25, 0.02, 0.5});
        REQUIRE(resolve(sheet) == 2);
        // Shares 3/4 and 1/4 of one edge, halves of the other.
        const double push = 0.08 / (0.5 + (pinned ? 0 : 0.625));
        CHECK_THAT(sheet.position(a).y, WithinAbs(pinned ? 0 : -0.75 * push, 1e-14));
        CHECK_THAT(sheet.position(b).y, WithinAbs(pinned ? 0 : -0.25 * push, 1e-14));
        CHECK_THAT(sheet.position(c).y, WithinRel(0.02 + push / 2, 1e-12));
        CHECK_THAT(sheet.position(d).y, WithinRel(0.02 + push / 2, 1e-12));
    }
}

TEST_CASE("Triangles: a crumpled cloth is moved without a change of its momentum") {
    Sheet<double> sheet(cloth(12, 12, SelfCollisionRule::triangles, 0.02));
    sim::SplitMix64 random(2);
    for (std::size_t i = 0; i < sheet.points(); ++i)
        sheet.place(i, uniform_point(random, -0.3, 0.3));
    const sim::Vec3 before = middle(sheet);
    REQUIRE(resolve(sheet) > 1000);
    REQUIRE(norm(minus(middle(sheet), before)) < 1e-13);
}

TEST_CASE("Where all but a far corner is pinned, no push is larger than twice what is missing") {
    Sheet<double> sheet = far_apart(SelfCollisionRule::triangles, 0.05, {{0, 0}, {1, 0}, {5, 5}});
    sheet.place(sheet.at(0, 0), {0, 0, 0});
    sheet.place(sheet.at(1, 0), {1, 0, 0});
    sheet.place(sheet.at(0, 1), {0.5, 0, 1});
    sheet.place(sheet.at(5, 5), {0.5, 0.02, 0.001});
    resolve(sheet);
    REQUIRE(norm(minus(sheet.position(sheet.at(0, 1)), {0.5, 0, 1})) < 2 * 0.08);
}

TEST_CASE("Layers that fall through each other without self-collision stay apart with it") {
    const auto run = [](SelfCollisionRule rule, double thickness) {
        Sheet<double> sheet = folded(rule, thickness);
        std::size_t contacts = 0, most = 0;
        for (int n = 0; n < 1500; ++n) {
            contacts += sheet.step().self_contacts;
            if (n % 50 == 0)
                most = std::max(most, intersections(sheet));
        }
        REQUIRE((contacts > 0) == (rule != SelfCollisionRule::none));
        return std::pair{lowest_of_upper_layer(sheet), most};
    };
    const auto [fallen, passed] = run(SelfCollisionRule::none, 0.05);
    CHECK(fallen < -0.03);
    CHECK(passed > 0);
    // Points keep points 0.1 m apart, in a lattice of 0.14 m: they hold each other.
    const auto [height, among] = run(SelfCollisionRule::neighbours, 0.05);
    CHECK(height > 0);
    CHECK(among == 0);
    // Thin as real cloth, only surfaces do.
    const auto [thin_height, thin_among] = run(SelfCollisionRule::triangles, 0.005);
    CHECK(thin_height > 0);
    CHECK(thin_among == 0);
    CHECK(run(SelfCollisionRule::neighbours, 0.005).first < 0);
}

TEST_CASE(
    "Thickness zero, coincident points, no numbers and the smallest grid: nothing crashes and nothing is invented") {
    const auto rule = GENERATE(SelfCollisionRule::neighbours, SelfCollisionRule::triangles);
    const auto size = GENERATE(2, 3, 7);
    const auto check = [&](auto real) {
        using Real = decltype(real);
        for (const double thickness : {0.0, 1e-300, 0.05, 1e3, 1e30}) {
            for (const double value : {0.0, 1e30, 1e300, std::numeric_limits<double>::infinity(),
                                       std::numeric_limits<double>::quiet_NaN()}) {
                Sheet<Real> sheet(cloth(size, size + 1, rule, thickness));
                for (std::size_t i = 0; i < sheet.points(); i += 2)
                    sheet.place(i, {value, 0.5, value});
                resolve(sheet);
                sheet.step();
                for (std::size_t i = 0; i < sheet.points(); ++i)
                    sheet.place(i, {value, value, value}); // all in one place have no direction
                CHECK(resolve(sheet) == 0);
            }
        }
        Sheet<Real> sheet(cloth(size, size + 1, rule, 0.05));
        const sim::Vec3 elsewhere = sheet.position(1);
        sheet.place(0, {std::numeric_limits<double>::quiet_NaN(), 0, 0});
        resolve(sheet);
        CHECK(sheet.position(1) == elsewhere);
    };
    check(0.0);
    check(0.0f);
}

TEST_CASE("The closest points of triangles and segments are no further than any others, and are on them") {
    sim::SplitMix64 random(4);
    const auto point = [&] {
        const sim::Vec3 x = uniform_point(random, -1, 1);
        return sim::Triple<double>{x.x, x.y, x.z};
    };
    const auto mix = [](auto a, auto b, double share) { return sim::along(a, share, b - a); };
    for (int n = 0; n < attempts(2000); ++n) {
        const auto p = point(), a = point(), b = point(), c = point();
        const auto [u, v, w] = sim::closest_on_triangle(p, a, b, c);
        REQUIRE_THAT(u + v + w, WithinAbs(1, 1e-9));
        REQUIRE(std::min({u, v, w}) >= 0);
        const sim::Triple<double> none{0, 0, 0};
        const auto on = sim::along(sim::along(sim::along(none, u, a), v, b), w, c);
        const auto [s, t] = sim::closest_on_segments(p, a, b, c);
        REQUIRE((s >= 0 && s <= 1 && t >= 0 && t <= 1));
        const double between = sim::norm(mix(p, a, s) - mix(b, c, t));
        for (int k = 0; k < 20; ++k) {
            const double first = random.unit(), second = random.unit();
            REQUIRE(sim::norm(p - on) <= sim::norm(p - mix(a, mix(b, c, first), second)) + 1e-9);
            REQUIRE(between <= sim::norm(mix(p, a, first) - mix(b, c, second)) + 1e-9);
            // Nothing is nearer close by, either.
            const double near_s = std::clamp(s + 0.01 * (first - 0.5), 0.0, 1.0);
            const double near_t = std::clamp(t + 0.01 * (second - 0.5), 0.0, 1.0);
            REQUIRE(between <= sim::norm(mix(p, a, near_s) - mix(b, c, near_t)) + 1e-9);
        }
    }
}
