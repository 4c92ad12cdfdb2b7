// What is proved to be free to drop is free to drop, to the last bit; and nothing else is.
#include <algorithm>
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>

#include "experiments/needs/proofs.h"
#include "needs_scenes.h"

using namespace clothlab;
using namespace clothlab::experiments;
using namespace clothlab::experiments::needs;
using namespace clothlab::test;

namespace {

constexpr std::uint64_t frames = 20;

Deeds deeds_of(const sim::Description& description) {
    const auto simulation = sim::Simulation::create(description);
    Deeds deeds;
    while (simulation->frame() < frames)
        deeds.add(simulation->step());
    return deeds;
}

/// The alternatives that are proved to change nothing. Each is tried as well, and so are all of them at once.
std::vector<std::string> proved(const scene::Scene& scene) {
    const Deeds deeds = deeds_of(scene.simulation);
    const std::uint64_t hash = hash_after(scene.simulation, frames);
    std::vector<Alternative> free;
    std::vector<std::string> names;
    for (const Alternative& one : alternatives(scene, {}))
        if (const auto why = proof(one, scene.simulation, deeds)) {
            INFO(one.what << ": " << *why);
            REQUIRE(hash_after(with(scene, one.settings).simulation, frames) == hash);
            free.push_back(one);
            names.push_back(one.what);
        }
    REQUIRE(hash_after(with(scene, together(free)).simulation, frames) == hash);
    return names;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

TEST_CASE("A cloth that touches nothing needs no self-collision, and that is proved", "[needs]") {
    scene::Scene scene = hanging_cloth();
    for (const auto rule :
         {sim::SelfCollisionRule::cs184, sim::SelfCollisionRule::neighbours, sim::SelfCollisionRule::triangles})
        for (const auto integrator : {sim::IntegratorId::course_verlet, sim::IntegratorId::velocity_verlet,
                                      sim::IntegratorId::rk4, sim::IntegratorId::bdf2, sim::IntegratorId::xpbd}) {
            scene.simulation.rules.self_collision = rule;
            scene.simulation.stepping.integrator = integrator;
            REQUIRE(has(proved(scene), "no self-collision"));
        }
}

TEST_CASE("A stretch limit that shortens nothing and colliders that nothing touches are free to drop", "[needs]") {
    scene::Scene scene = hanging_cloth();
    scene.simulation.cloth.density = 5; // light, and so hardly stretched
    scene.simulation.stepping.substeps = 40;
    scene.simulation.colliders = {sim::Sphere{{5, 5, 5}, 0.5, 0.3}, sim::Plane{{0, -3, 0}, {0, 1, 0}, 0.5},
                                  sim::Sphere{{-5, 5, 5}, 0.5, 0}};
    for (const auto limit : {sim::LimitRule::cs184, sim::LimitRule::iterated})
        for (const auto precision : {sim::Precision::single_precision, sim::Precision::double_precision}) {
            scene.simulation.rules.limit = limit;
            scene.simulation.stepping.precision = precision;
            const std::vector<std::string> names = proved(scene);
            for (const std::string name :
                 {"no self-collision", "no stretch limit", "no friction", "without the sphere at (5, 5, 5) m",
                  "without the plane at (0, -3, 0) m", "without the sphere at (-5, 5, 5) m"}) {
                INFO(name);
                REQUIRE(has(names, name));
            }
            REQUIRE(names.size() == 6); // springs, damping and substeps do something in every step
        }
}

TEST_CASE("What did something in a run is not proved to be free, and is not", "[needs]") {
    const scene::Scene scene = falling_cloth();
    const Deeds deeds = deeds_of(scene.simulation);
    REQUIRE((deeds.self_contacts > 0 && deeds.sphere_contacts > 0 && deeds.plane_contacts > 0));
    const std::uint64_t hash = hash_after(scene.simulation, frames);
    int looked_at = 0;
    for (const Alternative& one : alternatives(scene, {})) {
        if (one.part != Part::self_collision && one.part != Part::collider && one.part != Part::friction)
            continue;
        INFO(one.what);
        REQUIRE_FALSE(proof(one, scene.simulation, deeds));
        REQUIRE(hash_after(with(scene, one.settings).simulation, frames) != hash);
        ++looked_at;
    }
    REQUIRE(looked_at == 4);
}

TEST_CASE("Only what leaves a stage out is proved: a cheaper rule may do what the dearer one did not", "[needs]") {
    scene::Scene scene = hanging_cloth();
    scene.simulation.rules.self_collision = sim::SelfCollisionRule::triangles;
    const Deeds deeds = deeds_of(scene.simulation);
    REQUIRE(deeds.self_contacts == 0);
    for (const Alternative& one : alternatives(scene, {}))
        if (one.part == Part::self_collision)
            REQUIRE(proof(one, scene.simulation, deeds).has_value() == one.omission);
}

TEST_CASE("An untouched sphere is not proved to be free where another one was touched", "[needs]") {
    scene::Scene scene = falling_cloth();
    scene.simulation.colliders.emplace_back(sim::Sphere{{9, 9, 9}, 0.1, 0});
    REQUIRE_FALSE(has(proved(scene), "without the sphere at (9, 9, 9) m")); // they are counted together
}
