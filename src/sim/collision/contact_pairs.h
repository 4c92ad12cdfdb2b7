// The course's self-collision rule, pair by pair: where little of the cloth touches itself.
#pragma once

#include "sim/collision/self_collision_work.h"
#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

/// Applies the rule to the first work.pair_count of work.pairs, to the bits of the plain loops: the points in index
/// order, each with its partners in index order, where they are by then. Returns the number of pushes.
template <class Real>
std::size_t resolve_pairs(const Model<Real>& model, State<Real>& state, SelfCollisionWork<Real>& work);

extern template std::size_t resolve_pairs<float>(const Model<float>&, State<float>&, SelfCollisionWork<float>&);
extern template std::size_t resolve_pairs<double>(const Model<double>&, State<double>&, SelfCollisionWork<double>&);

} // namespace clothlab::sim
