#include "experiments/accuracy/physical_model.h"

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

#include "experiments/trial.h"

using namespace clothlab;
using namespace clothlab::experiments;
using Catch::Matchers::WithinRel;

TEST_CASE("The physical model has none of the course's rules, and damps as much in a second as the scene did") {
    scene::Scene scene;
    scene.simulation.cloth.damping = 0.7;
    scene.simulation.stepping.substeps = 20;
    scene.simulation.colliders = {sim::Plane{}};
    const PhysicalModel model = physical_model(scene);
    const sim::Description d = with(scene, model.settings).simulation;
    CHECK(d.rules.damping == sim::DampingRule::physical);
    CHECK(d.rules.start == sim::StartRule::physical);
    CHECK(d.rules.limit == sim::LimitRule::off);
    CHECK(d.rules.friction == sim::FrictionRule::physical);
    CHECK(d.rules.plane == sim::PlaneRule::physical);
    CHECK(d.rules.self_collision == sim::SelfCollisionRule::neighbours);
    CHECK_THAT(std::exp(-d.cloth.damping_rate), WithinRel(std::pow(1 - 0.007, 20 * 90), 1e-12));
    CHECK(model.notes.size() == 2);
    // That is all it changes, and there is nothing left to change.
    CHECK(physical_model(with(scene, model.settings)).settings.empty());
}

TEST_CASE("Rules that are not the course's stay as they are, and damping of 100 % is refused") {
    scene::Scene scene;
    scene.simulation.rules = {.damping = sim::DampingRule::physical,
                              .limit = sim::LimitRule::iterated,
                              .self_collision = sim::SelfCollisionRule::none};
    scene.simulation.cloth.damping = 100;
    const sim::Description d = with(scene, physical_model(scene).settings).simulation;
    CHECK(d.cloth.damping_rate == scene.simulation.cloth.damping_rate);
    CHECK(d.rules.limit == sim::LimitRule::iterated);
    CHECK(d.rules.self_collision == sim::SelfCollisionRule::none);
    scene.simulation.rules.damping = sim::DampingRule::cs184;
    CHECK_THROWS_AS(physical_model(scene), Refusal);
}

TEST_CASE("The course's rules are offered one by one where they have a part in the scene") {
    const auto names = [](const scene::Scene& scene) {
        std::vector<std::string> list;
        for (const RuleChange& change : course_rules(scene))
            list.push_back(change.name);
        return list;
    };
    scene::Scene scene;
    CHECK(names(scene) ==
          std::vector<std::string>{"damping=cs184", "start=cs184", "limit=cs184", "self_collision=cs184"});
    scene.simulation.colliders = {sim::Sphere{}};
    scene.simulation.stepping.integrator = sim::IntegratorId::rk4;
    CHECK(names(scene) ==
          std::vector<std::string>{"damping=cs184", "limit=cs184", "friction=cs184", "self_collision=cs184"});
    CHECK(names(with(scene, physical_model(scene).settings)).empty());
}
