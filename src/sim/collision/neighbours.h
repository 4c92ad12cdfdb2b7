// Self-collision of points with all points near them, whatever cell those are in (docs/simulation.md).
#pragma once

#include "sim/collision/self_collision_work.h"
#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

/// Puts every pair of points that is nearer than twice the thickness that far apart, one pair after the other; but for
/// pairs that are no further apart in the flat cloth. Returns the number of pairs moved, counted from both sides.
template <class Real>
std::size_t resolve_neighbours(const Model<Real>& model, State<Real>& state, SelfCollisionWork<Real>& work);

#define CLOTHLAB_DECLARE(Real)                                                                                         \
    extern template std::size_t resolve_neighbours<Real>(const Model<Real>&, State<Real>&, SelfCollisionWork<Real>&);
CLOTHLAB_DECLARE(float)
CLOTHLAB_DECLARE(double)
#undef CLOTHLAB_DECLARE

} // namespace clothlab::sim
