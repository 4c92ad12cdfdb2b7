// Wind: the formula of one course solution, and a physical one with drag and lift of every triangle. Both are written
// out in docs/simulation.md.
#pragma once

#include "sim/model.h"
#include "sim/state.h"
#include "sim/triple.h"

namespace clothlab::sim {

/// The course's wind at a position (m), in the course's own unit, an acceleration. `t` is the length of a step or the
/// simulated time, both in s.
template <class Real>
Triple<Real> course_wind(Triple<Real> position, Real t);

/// The course's air resistance 0.5 |a| |v| v, of an acceleration (m/s²) and a velocity (m/s).
template <class Real>
Triple<Real> course_air_resistance(Triple<Real> acceleration, Triple<Real> velocity);

/// The air's velocity in m/s at a time in s: the wind's velocity with its gusts.
Vec3 air_velocity(const Wind& wind, double time);

/// Adds drag and lift of every triangle to its corners, in N; velocities are (position - previous) / dt.
template <class Real>
void add_wind_forces(const Model<Real>& model, const State<Real>& state, Vec3Array<Real>& force);
/// The same with velocities in m/s, at a time in s.
template <class Real>
void add_wind_forces(const Model<Real>& model, const Vec3Array<Real>& position, const Vec3Array<Real>& velocity,
                     double time, Vec3Array<Real>& force);

/// Adds the course's wind as a force in N, mass times -0.7 (wind + air resistance), which is what its Verlet step makes
/// of it. `force` holds all other forces before: the resistance depends on them.
template <class Real>
void add_course_wind_forces(const Model<Real>& model, const Vec3Array<Real>& position, const Vec3Array<Real>& velocity,
                            double time, Vec3Array<Real>& force);

#define CLOTHLAB_DECLARE(Real)                                                                                         \
    extern template Triple<Real> course_wind<Real>(Triple<Real>, Real);                                                \
    extern template Triple<Real> course_air_resistance<Real>(Triple<Real>, Triple<Real>);                              \
    extern template void add_wind_forces<Real>(const Model<Real>&, const State<Real>&, Vec3Array<Real>&);              \
    extern template void add_wind_forces<Real>(const Model<Real>&, const Vec3Array<Real>&, const Vec3Array<Real>&,     \
                                               double, Vec3Array<Real>&);                                              \
    extern template void add_course_wind_forces<Real>(const Model<Real>&, const Vec3Array<Real>&,                      \
                                                      const Vec3Array<Real>&, double, Vec3Array<Real>&);
CLOTHLAB_DECLARE(float)
CLOTHLAB_DECLARE(double)
#undef CLOTHLAB_DECLARE

} // namespace clothlab::sim
