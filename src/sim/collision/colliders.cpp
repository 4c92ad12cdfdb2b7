#include "sim/collision/colliders.h"

#include <cmath>
#include <utility>

#include "sim/collision/physical_contacts.h"

namespace clothlab::sim {
namespace {

/// Friction: of the way from the last position to the contact point, the point keeps the share `slide`.
template <class Real>
void place(State<Real>& state, std::size_t i, Real slide, Real tx, Real ty, Real tz) {
    Vec3Array<Real>&x = state.position, &p = state.previous;
    x.x[i] = p.x[i] + slide * (tx - p.x[i]);
    x.y[i] = p.y[i] + slide * (ty - p.y[i]);
    x.z[i] = p.z[i] + slide * (tz - p.z[i]);
}

template <class Real>
bool collide(const SphereModel<Real>& s, State<Real>& state, std::size_t i) {
    const Vec3Array<Real>& x = state.position;
    const Real dx = x.x[i] - s.x, dy = x.y[i] - s.y, dz = x.z[i] - s.z;
    const Real distance = std::sqrt(dx * dx + dy * dy + dz * dz);
    if (!(distance <= s.radius) || distance == 0)
        return false;
    const Real scale = s.radius / distance;
    place(state, i, s.slide, s.x + scale * dx, s.y + scale * dy, s.z + scale * dz);
    return true;
}

template <class Real>
bool collide(const PlaneModel<Real>& s, State<Real>& state, std::size_t i) {
    const Vec3Array<Real>&x = state.position, &p = state.previous;
    const Real after = (x.x[i] - s.px) * s.nx + (x.y[i] - s.py) * s.ny + (x.z[i] - s.pz) * s.nz;
    const Real before = (p.x[i] - s.px) * s.nx + (p.y[i] - s.py) * s.ny + (p.z[i] - s.pz) * s.nz;
    const bool from_above = before >= 0;
    if (from_above ? !(after <= 0) : !(after >= 0))
        return false;
    const Real e = static_cast<Real>(from_above ? plane_offset : -plane_offset);
    place(state, i, s.slide, (x.x[i] - after * s.nx) + e * s.nx, (x.y[i] - after * s.ny) + e * s.ny,
          (x.z[i] - after * s.nz) + e * s.nz);
    return true;
}

template <class Real>
std::size_t contacts_by(const Kernels<Real>& kernels, const ContactArguments<Real>& points,
                        const SphereModel<Real>& sphere) {
    return kernels.sphere(points, sphere);
}
template <class Real>
std::size_t contacts_by(const Kernels<Real>& kernels, const ContactArguments<Real>& points,
                        const PlaneModel<Real>& plane) {
    return kernels.plane(points, plane);
}

template <class Real>
ColliderContacts resolve_by_kernels(const Model<Real>& model, State<Real>& state, Workspace<Real>& work) {
    const int ranges = for_ranges(model, work, [&](int index, std::size_t begin, std::size_t end) {
        const ContactArguments<Real> points{state.position.axes(), std::as_const(state.previous).axes(), begin, end,
                                            model.pins.empty() ? nullptr : model.pinned.data()};
        ColliderContacts contacts;
        for (const auto& collider : model.colliders)
            std::visit([&](const auto& shape) { contacts.of(shape) += contacts_by(*work.kernels, points, shape); },
                       collider);
        const auto own = 2 * static_cast<std::size_t>(index);
        work.counts[own] = contacts.spheres;
        work.counts[own + 1] = contacts.planes;
    });
    ColliderContacts all;
    for (std::size_t i = 0; i < static_cast<std::size_t>(ranges); ++i) {
        all.spheres += work.counts[2 * i];
        all.planes += work.counts[2 * i + 1];
    }
    return all;
}

} // namespace

template <class Real>
ColliderContacts resolve_colliders(const Model<Real>& model, State<Real>& state, Workspace<Real>& work) {
    if (model.rules.friction != FrictionRule::cs184 || model.rules.plane != PlaneRule::cs184)
        return resolve_physical_contacts(model, state);
    if (work.kernels)
        return resolve_by_kernels(model, state, work);
    ColliderContacts contacts;
    // Points do not depend on each other here, so going through the colliders outside gives the same bits as inside.
    for (const auto& collider : model.colliders) {
        std::visit(
            [&](const auto& shape) {
                std::size_t& count = contacts.of(shape);
                for (std::size_t i = 0; i < state.position.size(); ++i)
                    if (!model.pinned[i])
                        count += collide(shape, state, i) ? 1u : 0u;
            },
            collider);
    }
    return contacts;
}

template ColliderContacts resolve_colliders<float>(const Model<float>&, State<float>&, Workspace<float>&);
template ColliderContacts resolve_colliders<double>(const Model<double>&, State<double>&, Workspace<double>&);

} // namespace clothlab::sim
