// Which points the self-collision can concern in a step, found by proof: what is not on the list is out of reach.
#pragma once

#include "sim/model.h"
#include "sim/state.h"
#include "sim/workspace.h"

namespace clothlab::sim {

/// Sets work.self_collision.active to points that include all that the rule could move or that could push one.
///
/// Pairs of neighbours in the grid are tested in every step, a vector at a time. All other pairs are on a list with a
/// skin (L. Verlet, Physical Review 159 (1967), section II.B): it holds those that were nearer than the reach plus the
/// skin when it was made, and is made anew when points have moved against each other by more than the skin. That is
/// measured by the box around all displacements, so that a cloth that falls or flies as a whole keeps its list. The
/// list is empty as long as the cloth is not folded: the stage then ends here.
template <class Real>
void find_active_points(const Model<Real>& model, const Vec3Array<Real>& position, Workspace<Real>& work);

/// Into how many cells at most the list's pairs are sorted.
constexpr std::size_t most_cells(std::size_t points) {
    return 2 * points;
}

extern template void find_active_points<float>(const Model<float>&, const Vec3Array<float>&, Workspace<float>&);
extern template void find_active_points<double>(const Model<double>&, const Vec3Array<double>&, Workspace<double>&);

} // namespace clothlab::sim
