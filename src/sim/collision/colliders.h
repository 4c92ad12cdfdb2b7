// Contact of points with spheres and planes by the model's rules; here the course's (docs/simulation.md, stage 4).
#pragma once

#include "sim/model.h"
#include "sim/state.h"
#include "sim/workspace.h"

namespace clothlab::sim {

/// Moves every free point out of every collider, in scene order. Returns the number of contacts found.
template <class Real>
std::size_t resolve_colliders(const Model<Real>& model, State<Real>& state, Workspace<Real>& work);

extern template std::size_t resolve_colliders<float>(const Model<float>&, State<float>&, Workspace<float>&);
extern template std::size_t resolve_colliders<double>(const Model<double>&, State<double>&, Workspace<double>&);

} // namespace clothlab::sim
