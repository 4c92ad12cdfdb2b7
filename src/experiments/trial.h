// What all experiments do with a scene: change it, run it, and compare the shapes that it takes.
#pragma once

#include <cstdint>
#include <vector>

#include "experiments/findings.h"
#include "scene/scene.h"
#include "sim/simulation.h"

namespace clothlab::experiments {

/// The scene with other parameters. Throws scene::SceneError, which names the setting.
scene::Scene with(const scene::Scene& scene, const Settings& settings);

/// Where the points of a cloth are, in m, row by row.
struct Shape {
    int columns = 0, rows = 0;
    std::vector<sim::Vec3> points;
};
Shape shape_of(const sim::Simulation& simulation);
/// The same shape on another grid: interpolated bilinearly where it has no points. Throws std::invalid_argument for a
/// shape without points.
Shape resampled(const Shape& shape, int columns, int rows);

/// How far apart the points of two shapes of one cloth are, in m.
struct Distance {
    double rms = 0, largest = 0;
};
/// At the points of the grid with fewer of them; the other is interpolated bilinearly where it has none. Not finite
/// where a position is not. Throws std::invalid_argument for shapes without points.
Distance distance(const Shape& a, const Shape& b);

double mean_height(const Shape& shape);  ///< m, of all points
double drape_height(const Shape& shape); ///< m, from the lowest to the highest point

/// Steps a simulation through so many whole frames; false when it stops at a divergence, which is found only where the
/// simulation is watched.
bool run_frames(sim::Simulation& simulation, std::uint64_t frames);

} // namespace clothlab::experiments
