// All forces of a state together, as methods ask for them.
#pragma once

#include <type_traits>

#include "sim/model.h"
#include "sim/state.h"
#include "sim/workspace.h"

namespace clothlab::sim {

/// Sets work.force to all forces of a state of course Verlet, in N: gravity, springs and the physical wind, with
/// velocities (position - previous) / dt.
template <class Real>
void evaluate_forces(const Model<Real>& model, const State<Real>& state, Workspace<Real>& work);

/// Sets `out` to gravity and the spring forces, in N.
template <class Real>
void evaluate_conservative_forces(const Model<Real>& model, const Vec3Array<Real>& position, Workspace<Real>& work,
                                  Vec3Array<Real>& out);

/// Adds the forces of the wind, of either kind, in N, at a time in s. `out` holds all other forces before.
template <class Real>
void add_wind(const Model<Real>& model, const Vec3Array<Real>& position, const Vec3Array<Real>& velocity, double time,
              Vec3Array<Real>& out);

/// Sets `out` to the accelerations of all points in m/s², zero for pinned ones: gravity, springs and wind.
template <class Real>
void undamped_accelerations(const Model<Real>& model, const Vec3Array<Real>& position, const Vec3Array<Real>& velocity,
                            double time, Workspace<Real>& work, Vec3Array<Real>& out);

/// Sets `out` to the accelerations of all points in m/s², zero for pinned ones: gravity, springs, and, when there are
/// velocities, the wind and the physical rule's damping -c v.
template <class Real>
void accelerations(const Model<Real>& model, const Vec3Array<Real>& position,
                   const std::type_identity_t<Vec3Array<Real>>* velocity, double time, Workspace<Real>& work,
                   Vec3Array<Real>& out);

#define CLOTHLAB_DECLARE(Real)                                                                                         \
    extern template void evaluate_forces<Real>(const Model<Real>&, const State<Real>&, Workspace<Real>&);              \
    extern template void evaluate_conservative_forces<Real>(const Model<Real>&, const Vec3Array<Real>&,                \
                                                            Workspace<Real>&, Vec3Array<Real>&);                       \
    extern template void add_wind<Real>(const Model<Real>&, const Vec3Array<Real>&, const Vec3Array<Real>&, double,    \
                                        Vec3Array<Real>&);                                                             \
    extern template void undamped_accelerations<Real>(const Model<Real>&, const Vec3Array<Real>&,                      \
                                                      const Vec3Array<Real>&, double, Workspace<Real>&,                \
                                                      Vec3Array<Real>&);                                               \
    extern template void accelerations<Real>(const Model<Real>&, const Vec3Array<Real>&, const Vec3Array<Real>*,       \
                                             double, Workspace<Real>&, Vec3Array<Real>&);
CLOTHLAB_DECLARE(float)
CLOTHLAB_DECLARE(double)
#undef CLOTHLAB_DECLARE

} // namespace clothlab::sim
