// Gravity and further uniform accelerations.
#pragma once

#include <algorithm>

#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

/// Sets every force, in N, to mass times the sum of the uniform accelerations: the first stage of a force evaluation.
template <class Real>
void set_gravity_forces(const Model<Real>& model, Vec3Array<Real>& force) {
    std::fill(force.x.begin(), force.x.end(), model.mass * model.gx);
    std::fill(force.y.begin(), force.y.end(), model.mass * model.gy);
    std::fill(force.z.begin(), force.z.end(), model.mass * model.gz);
}

/// The potential energy in those accelerations in J, zero at the origin.
template <class Real>
double gravity_energy(const Model<Real>& model, const Vec3Array<Real>& position) {
    double energy = 0;
    for (std::size_t i = 0; i < position.size(); ++i)
        energy -= static_cast<double>(model.gx) * static_cast<double>(position.x[i]) +
                  static_cast<double>(model.gy) * static_cast<double>(position.y[i]) +
                  static_cast<double>(model.gz) * static_cast<double>(position.z[i]);
    return energy * static_cast<double>(model.mass);
}

} // namespace clothlab::sim
