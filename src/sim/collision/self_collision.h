// Self-collision by the course's rule: points in the same cell push each other twice the thickness apart
// (docs/simulation.md, stage 3).
#pragma once

#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

/// Moves every free point by the mean of the pushes it gets, divided by the substeps, in index order. Returns the
/// number of pairs found, counted from both sides.
template <class Real>
std::size_t resolve_self_collision(const Model<Real>& model, State<Real>& state, Workspace<Real>& work);

extern template std::size_t resolve_self_collision<float>(const Model<float>&, State<float>&, Workspace<float>&);
extern template std::size_t resolve_self_collision<double>(const Model<double>&, State<double>&, Workspace<double>&);

} // namespace clothlab::sim
