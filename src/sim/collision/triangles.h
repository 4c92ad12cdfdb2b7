// Self-collision of the cloth's surface: points against triangles and edges against edges (docs/simulation.md).
#pragma once

#include "sim/collision/block_tree.h"
#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

/// Puts every point and triangle, and every two edges, that are nearer than twice the thickness that far apart, one
/// pair after the other; but for pairs with corners that are the same or neighbours in the grid, and those that are no
/// further apart in the flat cloth. The tree is of the model's grid. Returns the number of pairs moved, counted from
/// both sides.
template <class Real>
std::size_t resolve_triangles(const Model<Real>& model, State<Real>& state, BlockTree<Real>& tree);

extern template std::size_t resolve_triangles<float>(const Model<float>&, State<float>&, BlockTree<float>&);
extern template std::size_t resolve_triangles<double>(const Model<double>&, State<double>&, BlockTree<double>&);

} // namespace clothlab::sim
