// Numbers for each point: strain, speed, gap and curvature, against poses and motions where they are known.
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "sim/collision/gaps.h"
#include "sim/curvature.h"
#include "sim/simulation.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// A flat sheet, its width times `across` and its height times `along`.
Sheet<double> stretched(const sim::Description& description, double across, double along) {
    Sheet<double> sheet(description);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 p = sheet.position(i);
        sheet.place(i, {across * p.x, p.y, along * p.z});
    }
    return sheet;
}

std::vector<float> strains(const Sheet<double>& sheet) {
    std::vector<float> values;
    sim::point_quantity(sim::PointQuantity::strain, sheet.model, sheet.state, {}, values);
    return values;
}

void require_all(const std::vector<float>& values, double expected, double tolerance) {
    for (const float value : values)
        REQUIRE_THAT(value, WithinAbs(expected, tolerance));
}

/// A surface over columns and rows, each from -1/2 to 1/2.
template <class Surface>
std::vector<float> points_of(int columns, int rows, Surface surface) {
    std::vector<float> positions;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const sim::Vec3 p =
                surface(static_cast<double>(column) / (columns - 1) - 0.5, static_cast<double>(row) / (rows - 1) - 0.5);
            for (const double value : {p.x, p.y, p.z})
                positions.push_back(static_cast<float>(value));
        }
    return positions;
}

/// A strip of 21 x 5 points 0.1 m apart, folded in the middle so that the halves lie `distance` apart, point on point.
std::vector<float> folded(double distance) {
    return points_of(21, 5, [&](double u, double v) {
        return sim::Vec3{std::abs(2 * u), u > 0 ? distance : 0, 0.4 * v};
    });
}
constexpr sim::FlatGrid strip{21, 5, 0.1f, 0.1f};

} // namespace

TEST_CASE("A stretched sheet has its stretch as strain at every point") {
    const sim::Description description = bare_cloth(6, 5);
    require_all(strains(stretched(description, 1, 1)), 0, 1e-12);
    require_all(strains(stretched(description, 1.05, 1)), 0.05, 1e-7);
    require_all(strains(stretched(description, 1.05, 1.02)), 0.05, 1e-7);
    require_all(strains(stretched(description, 0.9, 1.05)), -0.1, 1e-7);
}

TEST_CASE("Springs that do not pull have no strain") {
    sim::Description description = bare_cloth(5, 5);
    description.cloth.enable_structural = false;
    require_all(strains(stretched(description, 1.1, 1)), std::sqrt((1.1 * 1.1 + 1) / 2) - 1, 1e-7);
    description.cloth.enable_shearing = false;
    require_all(strains(stretched(description, 1.1, 1)), 0, 0);
}

TEST_CASE("A spring that is stretched is seen at both of its ends, and at no other point") {
    sim::Description description = bare_cloth(5, 5);
    description.cloth.enable_shearing = false;
    Sheet<double> sheet(description);
    const std::size_t corner = sheet.at(4, 4);
    sim::Vec3 p = sheet.position(corner);
    p.x += 0.25 * 0.08; // 0.25 m is the spacing
    sheet.place(corner, p);
    const std::vector<float> values = strains(sheet);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double below = std::hypot(1, 0.08) - 1;
        const double expected = i == corner || i == sheet.at(3, 4) ? 0.08 : i == sheet.at(4, 3) ? below : 0;
        REQUIRE_THAT(values[i], WithinAbs(expected, 1e-7));
    }
}

TEST_CASE("A falling cloth has the speed g t at every point, a pinned one none") {
    for (const auto method : {sim::IntegratorId::course_verlet, sim::IntegratorId::symplectic_euler}) {
        sim::Description description = bare_cloth(5, 4);
        description.stepping.gravity = {0, -9.8, 0};
        description.stepping.integrator = method;
        const auto simulation = sim::Simulation::create(description);
        for (int i = 0; i < 50; ++i)
            simulation->step();
        sim::Snapshot snapshot;
        simulation->capture(snapshot, {.quantity = sim::PointQuantity::speed});
        REQUIRE(snapshot.quantity_kind == sim::PointQuantity::speed);
        REQUIRE(snapshot.quantity.size() == 20);
        for (const float speed : snapshot.quantity)
            REQUIRE_THAT(speed, WithinRel(9.8 * simulation->time(), 1e-6));
    }
    sim::Description description = bare_cloth(2, 2);
    description.stepping.gravity = {0, -9.8, 0};
    description.cloth.pinned = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    const auto simulation = sim::Simulation::create(description);
    simulation->step();
    sim::Snapshot snapshot;
    simulation->capture(snapshot, {.quantity = sim::PointQuantity::speed});
    require_all(snapshot.quantity, 0, 0);
}

TEST_CASE("A flat cloth is near itself nowhere, however fine its grid") {
    const auto flat = [](double u, double v) { return sim::Vec3{u, 0, v}; };
    std::vector<float> gaps;
    for (const int points : {3, 20, 120}) {
        const float spacing = 1 / static_cast<float>(points - 1);
        sim::point_gaps({points, points, spacing, spacing}, points_of(points, points, flat), 0.01f, gaps);
        require_all(gaps, 0.02, 1e-6);
    }
}

TEST_CASE("Layers that face each other have their distance less twice the thickness as gap") {
    std::vector<float> gaps;
    const float thickness = 0.02f;
    for (const double distance : {0.07, 0.05, 0.04, 0.01, 0.0}) {
        sim::point_gaps(strip, folded(distance), thickness, gaps);
        for (std::size_t i = 0; i < gaps.size(); ++i) {
            // Points at the crease, columns 9 to 11, are near each other in the flat cloth, too.
            const std::size_t column = i % 21;
            if (column < 9 || column > 11)
                REQUIRE_THAT(gaps[i], WithinAbs(distance - 0.04, 1e-6));
        }
    }
    sim::point_gaps(strip, folded(0.2), thickness, gaps); // beyond the reach of four thicknesses
    require_all(gaps, 0.04, 1e-6);
}

TEST_CASE("Gaps are those of all pairs compared, in a crumpled cloth as in one of which some points have flown off") {
    sim::SplitMix64 random(3);
    const sim::FlatGrid grid{24, 17, 0.05f, 0.06f};
    std::vector<float> positions, gaps;
    for (int i = 0; i < 3 * 24 * 17; ++i)
        positions.push_back(static_cast<float>(uniform(random, -0.2, 0.2)));
    for (const float flown : {0.f, 1e20f, std::numeric_limits<float>::quiet_NaN()}) {
        if (flown != 0)
            positions[100] = positions[301] = flown;
        sim::point_gaps(grid, positions, 0.02f, gaps);
        int touching = 0;
        for (std::size_t i = 0; i < gaps.size(); ++i) {
            double expected = 0.08;
            for (std::size_t k = 0; k < gaps.size(); ++k) {
                const double across = 0.05 * (static_cast<double>(i % 24) - static_cast<double>(k % 24)),
                             along = 0.06 * (static_cast<double>(i / 24) - static_cast<double>(k / 24));
                double square = 0;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    square += std::pow(double{positions[3 * i + axis]} - double{positions[3 * k + axis]}, 2);
                if (std::hypot(across, along) > 0.0801 && square < expected * expected)
                    expected = std::sqrt(square);
            }
            REQUIRE_THAT(gaps[i], WithinAbs(expected - 0.04, 1e-6));
            touching += expected < 0.04 ? 1 : 0;
        }
        REQUIRE(touching > 50);
    }
}

TEST_CASE("The curvature of a cylinder is half, that of a sphere all of its inverse radius, and a plane has none") {
    const double r = 0.4;
    std::vector<float> curvatures;
    sim::point_curvatures(30, 20,
                          points_of(30, 20,
                                    [](double u, double v) {
                                        return sim::Vec3{u, 2 * u + v, v};
                                    }),
                          curvatures);
    require_all(curvatures, 0, 2e-3); // rounding of 1e-7 m in cells of 0.05 m
    const auto cylinder = [&](double u, double v) { return sim::Vec3{r * std::sin(2 * u), r * std::cos(2 * u), v}; };
    sim::point_curvatures(30, 20, points_of(30, 20, cylinder), curvatures);
    require_all(curvatures, 0.5 / r, 0.01 / r);
    const auto sphere = [&](double u, double v) {
        return sim::Vec3{r * std::sin(u) * std::cos(v), r * std::sin(v), r * std::cos(u) * std::cos(v)};
    };
    sim::point_curvatures(30, 20, points_of(30, 20, sphere), curvatures);
    require_all(curvatures, 1 / r, 0.03 / r);
}

TEST_CASE("Quantities are numbers where positions are none") {
    sim::Description description = bare_cloth(5, 5);
    Sheet<double> sheet(description);
    sheet.place(7, {0, std::numeric_limits<double>::quiet_NaN(), 0});
    sheet.place(20, {std::numeric_limits<double>::infinity(), 0, 0});
    std::vector<float> positions, values;
    for (std::size_t i = 0; i < sheet.points(); ++i)
        for (const double v : {sheet.position(i).x, sheet.position(i).y, sheet.position(i).z})
            positions.push_back(static_cast<float>(v));
    for (const auto which : {sim::PointQuantity::strain, sim::PointQuantity::speed, sim::PointQuantity::gap,
                             sim::PointQuantity::curvature}) {
        sim::point_quantity(which, sheet.model, sheet.state, positions, values);
        REQUIRE(values.size() == 25);
        for (const float value : values)
            REQUIRE(std::isfinite(value));
    }
}

TEST_CASE("A snapshot has the quantity that was asked for, and none else") {
    const auto simulation = sim::Simulation::create(bare_cloth(5, 5));
    sim::Snapshot snapshot;
    simulation->capture(snapshot);
    REQUIRE(snapshot.quantity_kind == sim::PointQuantity::none);
    REQUIRE(snapshot.quantity.empty());
    simulation->capture(snapshot, {.quantity = sim::PointQuantity::gap});
    REQUIRE(snapshot.quantity.size() == 25);
    simulation->capture(snapshot);
    REQUIRE(snapshot.quantity.empty());
}

TEST_CASE("A simulation alone is at no distance from itself") {
    const auto simulation = sim::Simulation::create(bare_cloth(5, 4));
    simulation->step();
    sim::Snapshot snapshot;
    simulation->capture(snapshot, {.quantity = sim::PointQuantity::distance});
    REQUIRE(snapshot.quantity_kind == sim::PointQuantity::distance);
    REQUIRE(snapshot.quantity == std::vector<float>(20, 0.f));
}

TEST_CASE("Point quantities are found by name") {
    REQUIRE(sim::find_point_quantity("distance") == sim::PointQuantity::distance);
    REQUIRE(sim::find_point_quantity("curvature") == sim::PointQuantity::curvature);
    REQUIRE(sim::find_point_quantity("none") == sim::PointQuantity::none);
    REQUIRE_FALSE(sim::find_point_quantity("Strain"));
}
