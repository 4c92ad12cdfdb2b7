// What a stability experiment varies, as people write it.
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

#include "experiments/stability/axis.h"
#include "experiments/trial.h"
#include "scene/io.h"

using namespace clothlab;
using namespace clothlab::experiments;
using Catch::Matchers::WithinRel;

namespace {

VariedAxis axis(const std::string& text) {
    return read_axis(text, 9, scene::Scene{});
}

} // namespace

TEST_CASE("A range has its ends, its number of values, and equal steps or equal ratios") {
    const VariedAxis linear = axis("cloth.ks=1000:3000:5");
    REQUIRE(linear.values.size() == 5);
    REQUIRE(linear.values.front().at == 1000);
    REQUIRE(linear.values[1].at == 1500);
    REQUIRE(linear.values.back().settings == Settings{"cloth.ks=3000"});
    REQUIRE(linear.border(1) == 1250);
    REQUIRE(linear.border(0) == 750);
    REQUIRE(linear.border(5) == 3250);
    const VariedAxis logarithmic = axis("ks=1e3:1e5:3log");
    REQUIRE(logarithmic.quantity.key == "cloth.ks");
    REQUIRE_THAT(logarithmic.values[1].at, WithinRel(1e4, 1e-12));
    REQUIRE_THAT(logarithmic.border(1), WithinRel(std::sqrt(1e3 * 1e4), 1e-12));
    REQUIRE(axis("cloth.density=10:100").values.size() == 9);
    REQUIRE(axis("cloth.density=10:100log").log);
}

TEST_CASE("Whole numbers are each taken once") {
    std::vector<double> values;
    for (const AxisValue& value : axis("substeps=2:6").values)
        values.push_back(value.at);
    REQUIRE(values == std::vector<double>{2, 3, 4, 5, 6});
}

TEST_CASE("Names stand for several parameters: springs for three switches, grid for both sides and the pins") {
    const VariedAxis springs = axis("springs=all,structural+shear,bending");
    REQUIRE(springs.categorical);
    REQUIRE(springs.values[1].settings ==
            Settings{"cloth.enable_structural=true", "cloth.enable_shearing=true", "cloth.enable_bending=false"});
    REQUIRE(axis("springs").values.size() == 7);
    scene::Scene scene;
    scene.simulation.cloth.pinned = {{0, 0}, {49, 0}, {25, 49}};
    const VariedAxis grid = read_axis("grid=5:9", 5, scene);
    const sim::Cloth cloth = with(scene, grid.values.back().settings).simulation.cloth;
    REQUIRE(cloth.num_width_points == 9);
    REQUIRE(cloth.num_height_points == 9);
    REQUIRE(cloth.pinned == std::vector<sim::GridPoint>{{0, 0}, {8, 0}, {4, 8}});
}

TEST_CASE("Damping is the one that the scene's rule reads, and the other is refused") {
    scene::Scene scene;
    REQUIRE(quantity_of("damping", scene).key == "cloth.damping");
    REQUIRE_THROWS_AS(quantity_of("cloth.damping_rate", scene), Refusal);
    scene.simulation.rules.damping = sim::DampingRule::physical;
    REQUIRE(quantity_of("damping", scene).key == "cloth.damping_rate");
    REQUIRE_THROWS_AS(quantity_of("cloth.damping", scene), Refusal);
}

TEST_CASE("What cannot be varied is refused, with a sentence") {
    for (const char* text :
         {"cloth.kss=1:2", "cloth.ks", "cloth.ks=5:1", "cloth.ks=1:2:1", "cloth.ks=1:2:2.5", "cloth.ks=0:2:5log",
          "cloth.ks=a:b", "cloth.ks=1:nan", "cloth.ks=1,2", "method=verlet", "springs=none", "springs=all",
          "look.ambient=0:1", "simulation.substeps=3:3.2", "simulation.gravity=0:1", "", "=1:2", "cloth.ks=1:2:3:4"}) {
        INFO(text);
        REQUIRE_THROWS_AS(axis(text), Refusal);
    }
    REQUIRE_THROWS_AS(axis("cloth.ks=-5:5"), scene::SceneError);
    REQUIRE_THROWS_AS(axis("substeps=0:5"), scene::SceneError);
}
