// What `experiment needs` tries to leave out of a model.
#include <algorithm>
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <set>

#include "experiments/needs/alternatives.h"
#include "needs_scenes.h"

using namespace clothlab;
using namespace clothlab::experiments;
using namespace clothlab::experiments::needs;
using namespace clothlab::test;

namespace {

std::set<Part> parts_of(const scene::Scene& scene) {
    std::set<Part> parts;
    for (const Alternative& one : alternatives(scene, {}))
        parts.insert(one.part);
    return parts;
}

const Alternative& find(const std::vector<Alternative>& list, const std::string& what) {
    const auto found = std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.what == what; });
    INFO(what);
    REQUIRE(found != list.end());
    return *found;
}

/// Everything there is, by the dearest rules.
scene::Scene rich_scene() {
    scene::Scene scene = falling_cloth();
    scene.simulation.wind.kind = sim::WindKind::physical;
    scene.simulation.rules.self_collision = sim::SelfCollisionRule::triangles;
    scene.simulation.rules.limit = sim::LimitRule::iterated;
    scene.simulation.stepping.integrator = sim::IntegratorId::xpbd;
    scene.simulation.stepping.spring_damping = 1;
    return scene;
}

} // namespace

TEST_CASE("What a scene has not is not left out of it", "[needs]") {
    const std::set<Part> hanging = parts_of(hanging_cloth());
    for (const Part part : {Part::wind, Part::friction, Part::collider, Part::solver})
        REQUIRE_FALSE(hanging.contains(part));
    const std::set<Part> rich = parts_of(rich_scene());
    for (int part = 0; part <= static_cast<int>(Part::solver); ++part)
        REQUIRE(rich.contains(static_cast<Part>(part)));

    scene::Scene bare = hanging_cloth();
    bare.simulation.stepping.precision = sim::Precision::single_precision;
    bare.simulation.stepping.substeps = 1;
    bare.simulation.cloth.damping = 0;
    bare.simulation.cloth.enable_bending = false;
    bare.simulation.rules.self_collision = sim::SelfCollisionRule::none;
    bare.simulation.rules.limit = sim::LimitRule::off;
    const std::set<Part> left = parts_of(bare);
    REQUIRE(left == std::set<Part>{Part::springs, Part::resolution, Part::method});
    for (const Alternative& one : alternatives(bare, {}))
        REQUIRE(one.what != "no bending springs");
}

TEST_CASE("Every alternative is another model that can be run, and each is there once", "[needs]") {
    for (const scene::Scene& scene : {hanging_cloth(), falling_cloth(), rich_scene()}) {
        std::vector<sim::Description> seen{scene.simulation};
        std::set<std::string> names;
        for (const Alternative& one : alternatives(scene, {})) {
            INFO(one.what);
            const scene::Scene changed = with(scene, one.settings);
            REQUIRE(std::find(seen.begin(), seen.end(), changed.simulation) == seen.end());
            REQUIRE_NOTHROW(sim::Simulation::create(changed.simulation));
            REQUIRE(names.insert(one.what).second);
            seen.push_back(changed.simulation);
        }
    }
}

TEST_CASE("Every other method is tried, with the same substeps and with fewer", "[needs]") {
    const scene::Scene scene = hanging_cloth();
    std::set<std::pair<sim::IntegratorId, int>> tried;
    for (const Alternative& one : alternatives(scene, {}))
        if (one.part == Part::method) {
            const sim::Stepping stepping = with(scene, one.settings).simulation.stepping;
            tried.insert({stepping.integrator, stepping.substeps});
        }
    for (const sim::IntegratorInfo& method : sim::integrators())
        for (const int substeps : {8, 4, 2, 1})
            REQUIRE(tried.contains({method.id, substeps}) == (method.id != scene.simulation.stepping.integrator));
}

TEST_CASE("Fewer substeps lose as much of the motion in a frame to the course's damping", "[needs]") {
    scene::Scene scene = hanging_cloth();
    const auto kept_in_a_frame = [](const sim::Description& d) {
        return std::pow(1 - d.cloth.damping / 100, d.stepping.substeps);
    };
    for (const Alternative& one : alternatives(scene, {}))
        if (one.part == Part::substeps || one.part == Part::method)
            REQUIRE_THAT(kept_in_a_frame(with(scene, one.settings).simulation),
                         Catch::Matchers::WithinRel(kept_in_a_frame(scene.simulation), 1e-12));
    scene.simulation.rules.damping = sim::DampingRule::physical;
    for (const Alternative& one : alternatives(scene, {}))
        REQUIRE(with(scene, one.settings).simulation.cloth.damping == scene.simulation.cloth.damping);
}

TEST_CASE("On a coarser grid, pins stay where they belong", "[needs]") {
    const scene::Scene scene = hanging_cloth();
    int grids = 0;
    for (const Alternative& one : alternatives(scene, {})) {
        if (one.part != Part::resolution)
            continue;
        const sim::Cloth cloth = with(scene, one.settings).simulation.cloth;
        REQUIRE(cloth.num_width_points < 8);
        REQUIRE(cloth.pinned == std::vector<sim::GridPoint>{{0, 0}, {cloth.num_width_points - 1, 0}});
        ++grids;
    }
    REQUIRE(grids == 3);
}

TEST_CASE("What is to be kept is not touched, key by key and in whole sections", "[needs]") {
    const scene::Scene scene = rich_scene();
    const std::vector<std::string> kept{"cloth.enable_bending", "cloth.damping", "colliders", "wind",
                                        "simulation.precision"};
    for (const Alternative& one : alternatives(scene, kept)) {
        INFO(one.what);
        const sim::Description d = with(scene, one.settings).simulation;
        REQUIRE(d.cloth.enable_bending);
        REQUIRE(d.cloth.damping == scene.simulation.cloth.damping);
        REQUIRE(d.colliders == scene.simulation.colliders);
        REQUIRE(d.wind == scene.simulation.wind);
        REQUIRE(d.stepping.precision == scene.simulation.stepping.precision);
    }
}

TEST_CASE("Several colliders leave together, whatever their numbers", "[needs]") {
    scene::Scene scene = falling_cloth();
    scene.simulation.colliders.emplace_back(sim::Sphere{{9, 9, 9}, 0.1, 0.2});
    std::vector<Alternative> all = alternatives(scene, {});
    std::vector<Alternative> some{find(all, "no friction"), find(all, "without the sphere at (0.5, 0.1, 0.5) m"),
                                  find(all, "without the sphere at (9, 9, 9) m"), find(all, "no stretch limit")};
    const sim::Description left = with(scene, together(some)).simulation;
    sim::Plane smooth = std::get<sim::Plane>(scene.simulation.colliders[1]);
    smooth.friction = 0;
    REQUIRE(left.colliders == std::vector<sim::Collider>{smooth});
    REQUIRE(left.rules.limit == sim::LimitRule::off);
    // One after the other, each in the model that the one before left.
    const Settings first = find(all, "without the sphere at (0.5, 0.1, 0.5) m").settings;
    const scene::Scene once = with(scene, first);
    const Settings second = find(alternatives(once, {}), "without the plane at (0, 0, 0) m").settings;
    REQUIRE(first == second);
    REQUIRE(with(scene, joined(first, second)).simulation.colliders ==
            std::vector<sim::Collider>{scene.simulation.colliders[2]});
}

TEST_CASE("A model is told in words by what differs", "[needs]") {
    const scene::Scene full = rich_scene();
    const scene::Scene model =
        with(full, {"simulation.substeps=5", "simulation.integrator=velocity-verlet", "cloth.enable_bending=false",
                    "wind.lift=0", "colliders.0=none", "rules.limit=off", "simulation.precision=single"});
    const std::string words = in_words(model, full);
    REQUIRE(words.starts_with("5 substeps of Velocity Verlet, "));
    for (const std::string part :
         {"single precision", "no bending springs", "no lift", "without 1 collider", "no stretch limit"}) {
        INFO(part << " in " << words);
        REQUIRE(words.find(part) != std::string::npos);
    }
    REQUIRE(words.find("damping") == std::string::npos);
    REQUIRE(words.find("self-collision") == std::string::npos);
}
