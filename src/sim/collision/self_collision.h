// Self-collision by the model's rule; here the course's: points in the same cell push each other twice the thickness
// apart (docs/simulation.md, stage 3).
#pragma once

#include "sim/model.h"
#include "sim/state.h"
#include "sim/workspace.h"

namespace clothlab::sim {

/// Moves every free point by the mean of the pushes it gets, divided by the substeps, in index order; or what the rule
/// says instead (neighbours.h, triangles.h). Returns the number of pairs found, counted from both sides.
template <class Real>
std::size_t resolve_self_collision(const Model<Real>& model, State<Real>& state, Workspace<Real>& work);

/// Sizes the stage's memory for a model; part of prepare().
template <class Real>
void prepare_self_collision(const Model<Real>& model, Workspace<Real>& work);

extern template std::size_t resolve_self_collision<float>(const Model<float>&, State<float>&, Workspace<float>&);
extern template std::size_t resolve_self_collision<double>(const Model<double>&, State<double>&, Workspace<double>&);
extern template void prepare_self_collision<float>(const Model<float>&, Workspace<float>&);
extern template void prepare_self_collision<double>(const Model<double>&, Workspace<double>&);

} // namespace clothlab::sim
