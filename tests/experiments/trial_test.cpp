#include "experiments/trial.h"

#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "scene/io.h"

using namespace clothlab;
using namespace clothlab::experiments;
using Catch::Approx;

namespace {

/// A grid over a plane that is tilted: bilinear interpolation is exact on it.
Shape tilted(int columns, int rows, double lift = 0) {
    Shape shape{columns, rows, {}};
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const double u = static_cast<double>(c) / (columns - 1), v = static_cast<double>(r) / (rows - 1);
            shape.points.push_back({u, 0.3 * u - 0.2 * v + lift, v});
        }
    return shape;
}

} // namespace

TEST_CASE("Shapes on the same grid are as far apart as their points") {
    Shape a = tilted(4, 3), b = tilted(4, 3);
    b.points[5].y += 0.3;
    b.points[5].x += 0.4;
    const Distance d = distance(a, b);
    CHECK(d.largest == Approx(0.5));
    CHECK(d.rms == Approx(0.5 / std::sqrt(12.0)));
    CHECK(distance(a, a).largest == 0);
}

TEST_CASE("A plane has no distance from itself on a finer grid, in either order") {
    for (const auto& [columns, rows] : {std::pair{3, 5}, {7, 4}, {20, 2}}) {
        CHECK(distance(tilted(5, 5), tilted(columns, rows)).largest < 1e-15);
        CHECK(distance(tilted(columns, rows), tilted(5, 5)).largest < 1e-15);
        CHECK(distance(tilted(5, 5), tilted(columns, rows, 0.25)).rms == Approx(0.25));
    }
}

TEST_CASE("A cloth that has blown up is infinitely far away") {
    Shape a = tilted(3, 3), b = a;
    b.points[4].z = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isinf(distance(a, b).rms));
    CHECK(std::isinf(distance(a, b).largest));
    CHECK_THROWS_AS(distance(a, Shape{}), std::invalid_argument);
}

TEST_CASE("Heights are of the points") {
    CHECK(mean_height(tilted(3, 3, 1)) == Approx(1 + 0.15 - 0.1));
    CHECK(drape_height(tilted(3, 3, 1)) == Approx(0.5));
}

TEST_CASE("Settings make another scene of one, and what they cannot is said with their names") {
    scene::Scene scene;
    const scene::Scene stiff = with(scene, {"cloth.ks=7000", "simulation.substeps=3"});
    CHECK(stiff.simulation.cloth.ks == 7000);
    CHECK(stiff.simulation.stepping.substeps == 3);
    CHECK(scene.simulation.cloth.ks == 5000);
    CHECK_THROWS_AS(with(scene, {"cloth.ks"}), scene::SceneError);
    CHECK_THROWS_AS(with(scene, {"cloth.kz=3"}), scene::SceneError);
    CHECK_THROWS_AS(with(scene, {"cloth.ks=many"}), scene::SceneError);
}
