// Contact with spheres and planes, for a vector of points at a time; the formulas are those of collision/colliders.cpp.
#if defined(CLOTHLAB_SIM_KERNELS_CONTACTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLOTHLAB_SIM_KERNELS_CONTACTS_INL_H
#undef CLOTHLAB_SIM_KERNELS_CONTACTS_INL_H
#else
#define CLOTHLAB_SIM_KERNELS_CONTACTS_INL_H
#endif

#include "sim/kernels/vectors-inl.h"
#include "sim/model.h"

HWY_BEFORE_NAMESPACE();
namespace clothlab::sim::HWY_NAMESPACE {

template <class Real>
HWY_INLINE LaneMask<Real> free_lanes(const std::uint8_t* pinned, std::ptrdiff_t i, std::ptrdiff_t end) {
    const Tag<Real> d;
    HWY_ALIGN Real free[HWY_LANES(Real)];
    for (std::ptrdiff_t l = 0; l < lanes<Real>; ++l)
        free[l] = i + l < end && pinned[i + l] == 0 ? Real(1) : Real(0);
    return hn::Gt(hn::Load(d, free), hn::Zero(d));
}

/// Calls hit(x, p, target) for each vector, which says where points touch and sets their target; those that are free
/// are put there with friction. Returns how many.
template <class Real, class Hit>
HWY_INLINE std::size_t contacts(const ContactArguments<Real>& a, Real slide, Hit hit) {
    const Tag<Real> d;
    const auto slides = hn::Set(d, slide);
    const auto end = static_cast<std::ptrdiff_t>(a.end);
    std::size_t count = 0;
    for (auto i = static_cast<std::ptrdiff_t>(a.begin); i < end; i += lanes<Real>) {
        const Lane3<Real> x = load3(a.x, i), p = load3(a.previous, i);
        Lane3<Real> target;
        LaneMask<Real> touching = hn::And(hit(x, p, target), lanes_before<Real>(end - i));
        if (HWY_LIKELY(hn::AllFalse(d, touching)))
            continue;
        if (a.pinned)
            touching = hn::And(touching, free_lanes<Real>(a.pinned, i, end));
        const Lane3<Real> placed = add3(p, scale3<Real>(slides, subtract3(target, p)));
        store3(choose3<Real>(touching, placed, x), a.x, i);
        count += hn::CountTrue(d, touching);
    }
    return count;
}

template <class Real>
std::size_t sphere_contacts(const ContactArguments<Real>& a, const SphereModel<Real>& s) {
    const Tag<Real> d;
    const Lane3<Real> origin = set3(s.x, s.y, s.z);
    const auto radius = hn::Set(d, s.radius);
    return contacts(a, s.slide, [&](const Lane3<Real>& x, const Lane3<Real>&, Lane3<Real>& target) HWY_ATTR {
        const Lane3<Real> v = subtract3(x, origin);
        const auto distance = hn::Sqrt(dot3(v, v));
        target = add3(origin, scale3<Real>(hn::Div(radius, distance), v));
        return hn::And(hn::Le(distance, radius), hn::Gt(distance, hn::Zero(d)));
    });
}

template <class Real>
std::size_t plane_contacts(const ContactArguments<Real>& a, const PlaneModel<Real>& s) {
    const Tag<Real> d;
    const Lane3<Real> point = set3(s.px, s.py, s.pz), normal = set3(s.nx, s.ny, s.nz);
    const auto above = hn::Set(d, static_cast<Real>(plane_offset)),
               below = hn::Set(d, static_cast<Real>(-plane_offset));
    return contacts(a, s.slide, [&](const Lane3<Real>& x, const Lane3<Real>& p, Lane3<Real>& target) HWY_ATTR {
        const auto zero = hn::Zero(d);
        const auto after = dot3(subtract3(x, point), normal), before = dot3(subtract3(p, point), normal);
        const auto from_above = hn::Ge(before, zero);
        target = add3(subtract3(x, scale3<Real>(after, normal)),
                      scale3<Real>(hn::IfThenElse(from_above, above, below), normal));
        return hn::Or(hn::And(from_above, hn::Le(after, zero)), hn::AndNot(from_above, hn::Ge(after, zero)));
    });
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
