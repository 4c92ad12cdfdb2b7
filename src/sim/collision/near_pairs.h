// Which pairs of points can touch each other in a step, found by proof: all others are out of reach.
#pragma once

#include "sim/model.h"
#include "sim/state.h"
#include "sim/workspace.h"

namespace clothlab::sim {

/// Sets the first ones of work.self_collision.pairs, and their number, to all pairs that the rule could concern: near
/// enough at the beginning of the stage to touch in the course of it, and in the same cell. False, without pairs, where
/// this way of finding them does not pay or the positions are not finite.
///
/// Pairs of neighbours in the grid are tested in every step, a vector at a time. All other pairs are on a list with a
/// skin (L. Verlet, Physical Review 159 (1967), section II.B): it holds those that were nearer than the reach plus the
/// skin when it was made, and is made anew when points have moved against each other by more than the skin. That is
/// measured by the box around all displacements, so that a cloth that falls or flies as a whole keeps its list. The
/// list is empty as long as the cloth is not folded. Where folds make it long, or motion makes it short-lived, it is
/// left for some time, and resolve_in_cells does the work.
template <class Real>
bool find_pairs(const Model<Real>& model, const Vec3Array<Real>& position, Workspace<Real>& work);

/// The farthest that the stage can move a point, in m: once, by the mean of its missing distances over the substeps.
template <class Real>
double farthest_push(const Model<Real>& model);

/// The distance from which on two points of a stage's beginning cannot touch in it, in m, when no point is moved
/// farther than `push` and no coordinate is larger than the bound, by which positions are rounded. Of two points one
/// has not been moved yet when they are looked at.
template <class Real>
double reach_of(const Model<Real>& model, double push, double coordinate_bound);

/// More pairs of neighbours than these are better pushed apart cell by cell.
constexpr std::size_t most_pairs(std::size_t points) {
    return points + 64;
}
/// A list longer than this costs more than it saves.
constexpr std::size_t most_far_pairs(std::size_t points) {
    return points + 64;
}
/// Into how many cells at most points are sorted to make the list.
constexpr std::size_t most_cells(std::size_t points) {
    return 2 * points + 64;
}

#define CLOTHLAB_DECLARE(Real)                                                                                         \
    extern template bool find_pairs<Real>(const Model<Real>&, const Vec3Array<Real>&, Workspace<Real>&);               \
    extern template double farthest_push<Real>(const Model<Real>&);                                                    \
    extern template double reach_of<Real>(const Model<Real>&, double, double);
CLOTHLAB_DECLARE(float)
CLOTHLAB_DECLARE(double)
#undef CLOTHLAB_DECLARE

} // namespace clothlab::sim
