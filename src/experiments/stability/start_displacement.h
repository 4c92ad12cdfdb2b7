// Moving a run's points a little at its start.
#pragma once

#include <vector>

#include "sim/simulation.h"

namespace clothlab::experiments {

/// The shortest spring's rest length in m.
double shortest_spring(const sim::Description& description);

/// Directions and shares of a displacement of every point: at random in the unit cube about 0, zero at pins, always the
/// same for the same grid.
std::vector<sim::Vec3> noise(const sim::Description& description);

/// Moves the points of a run by `size` metres times `shape`; velocities stay. What it keeps of its past moves along.
void displace(sim::Simulation& simulation, double size, const std::vector<sim::Vec3>& shape);

} // namespace clothlab::experiments
