// Tiny scenes for `experiment needs`, and a cost that is the same every time.
#pragma once

#include <cmath>

#include "experiments/needs/needs.h"
#include "sim/integrators/integrator.h"

namespace clothlab::test {

/// A cloth of 8 x 8 points that hangs by two corners and touches nothing.
inline scene::Scene hanging_cloth() {
    scene::Scene scene;
    scene.name = "hanging";
    sim::Description& d = scene.simulation;
    d.cloth.num_width_points = 8;
    d.cloth.num_height_points = 8;
    d.cloth.thickness = 0.01;
    d.cloth.ks = 3000;
    d.cloth.pinned = {{0, 0}, {7, 0}};
    d.stepping.precision = sim::Precision::double_precision;
    d.stepping.frames_per_second = 60;
    d.stepping.substeps = 8;
    return scene;
}

/// One that falls on a sphere and a plane, and folds over.
inline scene::Scene falling_cloth() {
    scene::Scene scene = hanging_cloth();
    scene.name = "falling";
    scene.simulation.cloth.pinned.clear();
    scene.simulation.cloth.offset = {0, -0.72, 0};
    scene.simulation.cloth.thickness = 0.08;
    scene.simulation.colliders = {sim::Sphere{{0.5, 0.1, 0.5}, 0.12, 0.3}, sim::Plane{{0, 0, 0}, {0, 1, 0}, 0.5}};
    return scene;
}

/// Work in some unit: nothing that a machine would do, but every part of a model costs something.
inline double work(const sim::Description& model) {
    const sim::Cloth& cloth = model.cloth;
    double per_point = 1 + cloth.enable_structural + cloth.enable_shearing + cloth.enable_bending;
    per_point += model.rules.self_collision != sim::SelfCollisionRule::none ? 2 : 0;
    per_point += model.rules.limit != sim::LimitRule::off ? 1 : 0;
    per_point += static_cast<double>(model.colliders.size());
    per_point += model.wind.kind != sim::WindKind::none ? 2 : 0;
    if (sim::traits(model.stepping.integrator).family == sim::Family::implicit_method)
        per_point *= 5;
    if (model.stepping.precision == sim::Precision::single_precision)
        per_point *= 0.7;
    return per_point * cloth.num_width_points * cloth.num_height_points * model.stepping.substeps;
}

inline experiments::needs::Config needs_of(const scene::Scene& scene, double tolerance) {
    experiments::needs::Config config;
    config.scene = scene;
    config.source = scene.name;
    config.frames = 24;
    config.tolerance = tolerance;
    config.known_cost = work;
    config.kept = {"simulation.integrator"}; // sixteen methods take their time
    return config;
}

inline std::uint64_t hash_after(const sim::Description& description, std::uint64_t frames) {
    const auto simulation = sim::Simulation::create(description);
    experiments::run_frames(*simulation, frames);
    return simulation->hash();
}

} // namespace clothlab::test
