// Self-collision by the course's cells: where the cloth is folded.
#pragma once

#include "sim/model.h"
#include "sim/state.h"
#include "sim/workspace.h"

namespace clothlab::sim {

/// Sorts all points by the hash bucket of their cell.
template <class Real>
void sort_into_cells(const Model<Real>& model, const Vec3Array<Real>& position, Workspace<Real>& work);

/// Sets work.self_collision.pairs as find_pairs does, from the sorted points. False where there are many.
template <class Real>
bool find_pairs_in_cells(const Model<Real>& model, State<Real>& state, Workspace<Real>& work);

/// Applies the rule to all sorted points, to the bits of the plain loops. Points of one cell push only each other, and
/// cells do not change during the stage: so cells may be gone through in any order, or at the same time, as long as the
/// points within each keep theirs. Returns the number of pushes.
template <class Real>
std::size_t resolve_in_cells(const Model<Real>& model, State<Real>& state, Workspace<Real>& work);

#define CLOTHLAB_DECLARE(Real)                                                                                         \
    extern template void sort_into_cells<Real>(const Model<Real>&, const Vec3Array<Real>&, Workspace<Real>&);          \
    extern template bool find_pairs_in_cells<Real>(const Model<Real>&, State<Real>&, Workspace<Real>&);                \
    extern template std::size_t resolve_in_cells<Real>(const Model<Real>&, State<Real>&, Workspace<Real>&);
CLOTHLAB_DECLARE(float)
CLOTHLAB_DECLARE(double)
#undef CLOTHLAB_DECLARE

} // namespace clothlab::sim
