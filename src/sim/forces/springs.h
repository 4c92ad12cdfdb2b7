// Linear springs: force k (|d| - rest) along d, energy k/2 (|d| - rest)².
#pragma once

#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

/// Adds the force of every enabled spring to both of its ends, in N, in spring order. A spring of length zero has no
/// direction and pulls nowhere.
template <class Real>
void add_spring_forces(const Model<Real>& model, const Vec3Array<Real>& position, Vec3Array<Real>& force);

/// The energy of all enabled springs in J, summed in double precision.
template <class Real>
double spring_energy(const Model<Real>& model, const Vec3Array<Real>& position);

#define CLOTHLAB_DECLARE(Real)                                                                                         \
    extern template void add_spring_forces<Real>(const Model<Real>&, const Vec3Array<Real>&, Vec3Array<Real>&);        \
    extern template double spring_energy<Real>(const Model<Real>&, const Vec3Array<Real>&);
CLOTHLAB_DECLARE(float)
CLOTHLAB_DECLARE(double)
#undef CLOTHLAB_DECLARE

} // namespace clothlab::sim
