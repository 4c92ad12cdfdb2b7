// Self-collision by the course's cells: where the cloth is folded.
#pragma once

#include "sim/model.h"
#include "sim/state.h"
#include "sim/workspace.h"

namespace clothlab::sim {

/// Applies the rule to all points, by the kernels, to the bits of the plain loops. Points of one cell push only each
/// other, and cells do not change during the stage: so cells may be gone through in any order, or at the same time, as
/// long as the points within each keep theirs. Returns the number of pushes.
template <class Real>
std::size_t resolve_in_cells(const Model<Real>& model, State<Real>& state, Workspace<Real>& work);

/// Sizes the memory that resolve_in_cells needs beside what the list of pairs has.
template <class Real>
void prepare_cells(const Grid<Real>& grid, SelfCollisionWork<Real>& work);

extern template void prepare_cells<float>(const Grid<float>&, SelfCollisionWork<float>&);
extern template void prepare_cells<double>(const Grid<double>&, SelfCollisionWork<double>&);
extern template std::size_t resolve_in_cells<float>(const Model<float>&, State<float>&, Workspace<float>&);
extern template std::size_t resolve_in_cells<double>(const Model<double>&, State<double>&, Workspace<double>&);

} // namespace clothlab::sim
