// Contact of points with spheres and planes by the model's rules; here the course's (docs/simulation.md, stage 4).
#pragma once

#include "sim/model.h"
#include "sim/state.h"
#include "sim/workspace.h"

namespace clothlab::sim {

/// Contacts found, by what was touched.
struct ColliderContacts {
    std::size_t spheres = 0, planes = 0;
    std::size_t all() const { return spheres + planes; }
    bool operator==(const ColliderContacts&) const = default;
    /// The number for colliders like this one.
    template <class Real>
    std::size_t& of(const SphereModel<Real>&) {
        return spheres;
    }
    template <class Real>
    std::size_t& of(const PlaneModel<Real>&) {
        return planes;
    }
};

/// Moves every free point out of every collider, in scene order.
template <class Real>
ColliderContacts resolve_colliders(const Model<Real>& model, State<Real>& state, Workspace<Real>& work);

extern template ColliderContacts resolve_colliders<float>(const Model<float>&, State<float>&, Workspace<float>&);
extern template ColliderContacts resolve_colliders<double>(const Model<double>&, State<double>&, Workspace<double>&);

} // namespace clothlab::sim
