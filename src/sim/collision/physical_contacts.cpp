// Coulomb friction in positions: M. Macklin, M. Mueller, N. Chentanez, T.-Y. Kim, "Unified particle physics for
// real-time applications", ACM Transactions on Graphics 33 (2014), section 6.1. The collider does not move and its mass
// is infinite, so the whole correction is the point's; static and kinetic coefficient are the same. Friction is bounded
// by the depth that the contact corrected in the step, which over the steps adds up to the normal impulse.
#include "sim/collision/physical_contacts.h"

#include <cmath>
#include <optional>
#include <variant>

#include "sim/triple.h"

namespace clothlab::sim {
namespace {

template <class Real>
struct Contact {
    Triple<Real> target; ///< m, where the point is put if there is no friction
    Triple<Real> normal; ///< unit
    Real depth;          ///< m, how far along the normal that is
    Triple<Real> from;   ///< m, where the point was a step earlier
};

template <class Real>
std::optional<Contact<Real>> find_contact(const SphereModel<Real>& s, PlaneRule, Triple<Real> x, Triple<Real> p) {
    const Triple<Real> centre{s.x, s.y, s.z}, d = x - centre;
    const Real distance = norm(d);
    if (!(distance <= s.radius) || distance == 0)
        return std::nullopt;
    return Contact<Real>{along(centre, s.radius / distance, d),
                         {d.x / distance, d.y / distance, d.z / distance},
                         s.radius - distance,
                         p};
}

template <class Real>
std::optional<Contact<Real>> find_contact(const PlaneModel<Real>& s, PlaneRule rule, Triple<Real> x, Triple<Real> p) {
    const Triple<Real> point{s.px, s.py, s.pz}, n{s.nx, s.ny, s.nz};
    const Real after = dot(x - point, n), before = dot(p - point, n);
    if (rule == PlaneRule::physical) {
        if (!(after < 0))
            return std::nullopt;
        // What began below did not come from there through the plane: it counts as having been on it.
        return Contact<Real>{along(x, -after, n), n, -after, before < 0 ? along(p, -before, n) : p};
    }
    const bool from_above = before >= 0;
    if (from_above ? !(after <= 0) : !(after >= 0))
        return std::nullopt;
    const Real e = static_cast<Real>(from_above ? plane_offset : -plane_offset);
    return Contact<Real>{along(along(x, -after, n), e, n), n, std::abs(e - after), p};
}

/// Where friction leaves a point. The course's takes a share of the whole way from the last position.
template <class Real>
Triple<Real> course_friction(const Contact<Real>& c, Real slide) {
    return along(c.from, slide, c.target - c.from);
}

template <class Real>
Triple<Real> coulomb_friction(const Contact<Real>& c, Real mu) {
    const Triple<Real> way = c.target - c.from;
    const Real across = dot(way, c.normal);
    const Triple<Real> tangential = along(way, -across, c.normal);
    const Real slip = norm(tangential), most = mu * c.depth;
    if (slip <= most)
        return along(c.from, across, c.normal);
    return slip > 0 ? along(c.target, -(most / slip), tangential) : c.target;
}

} // namespace

template <class Real>
ColliderContacts resolve_physical_contacts(const Model<Real>& model, State<Real>& state) {
    Vec3Array<Real>& x = state.position;
    const Vec3Array<Real>& p = state.previous;
    const bool coulomb = model.rules.friction == FrictionRule::physical;
    ColliderContacts contacts;
    const auto resolve = [&](const auto& shape) {
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (model.pinned[i])
                continue;
            const auto contact = find_contact<Real>(shape, model.rules.plane, at(x, i), at(p, i));
            if (!contact)
                continue;
            put(x, i, coulomb ? coulomb_friction(*contact, shape.friction) : course_friction(*contact, shape.slide));
            ++contacts.of(shape);
        }
    };
    for (const auto& collider : model.colliders)
        std::visit(resolve, collider);
    return contacts;
}

template ColliderContacts resolve_physical_contacts<float>(const Model<float>&, State<float>&);
template ColliderContacts resolve_physical_contacts<double>(const Model<double>&, State<double>&);

} // namespace clothlab::sim
