// Contact of points with spheres and planes where friction or planes follow the physical rule (docs/simulation.md).
#pragma once

#include "sim/collision/colliders.h"
#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

/// Moves every free point out of every collider, in scene order: planes by `rules.plane`, friction by `rules.friction`,
/// each either way.
template <class Real>
ColliderContacts resolve_physical_contacts(const Model<Real>& model, State<Real>& state);

extern template ColliderContacts resolve_physical_contacts<float>(const Model<float>&, State<float>&);
extern template ColliderContacts resolve_physical_contacts<double>(const Model<double>&, State<double>&);

} // namespace clothlab::sim
