// Closest points of triangles and segments: C. Ericson, "Real-time collision detection" (2005).
#pragma once

#include <algorithm>
#include <array>

#include "sim/triple.h"

namespace clothlab::sim {

/// Barycentric weights of the point of triangle abc that is closest to p (section 5.1.5). Not numbers where the
/// triangle is a line or p or a corner is not finite.
template <class Real>
std::array<Real, 3> closest_on_triangle(Triple<Real> p, Triple<Real> a, Triple<Real> b, Triple<Real> c) {
    const Triple<Real> ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const Real d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0)
        return {1, 0, 0};
    const Real d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3)
        return {0, 1, 0};
    const Real vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        const Real v = d1 / (d1 - d3);
        return {1 - v, v, 0};
    }
    const Real d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6)
        return {0, 0, 1};
    const Real vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        const Real w = d2 / (d2 - d6);
        return {1 - w, 0, w};
    }
    const Real va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const Real w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0, 1 - w, w};
    }
    const Real sum = va + vb + vc;
    return {va / sum, vb / sum, vc / sum};
}

/// The shares of the ways from p1 to q1 and from p2 to q2 where those segments are closest (section 5.1.9). Where they
/// are parallel, one of the many.
template <class Real>
std::array<Real, 2> closest_on_segments(Triple<Real> p1, Triple<Real> q1, Triple<Real> p2, Triple<Real> q2) {
    const auto clamp = [](Real v) { return std::clamp(v, Real(0), Real(1)); };
    const Triple<Real> d1 = q1 - p1, d2 = q2 - p2, r = p1 - p2;
    const Real a = dot(d1, d1), e = dot(d2, d2), f = dot(d2, r);
    if (a == 0)
        return {0, e == 0 ? Real(0) : clamp(f / e)};
    const Real c = dot(d1, r);
    if (e == 0)
        return {clamp(-c / a), 0};
    const Real b = dot(d1, d2), denominator = a * e - b * b;
    const Real s = denominator > 0 ? clamp((b * f - c * e) / denominator) : Real(0);
    const Real t = (b * s + f) / e;
    if (t < 0)
        return {clamp(-c / a), 0};
    if (t > 1)
        return {clamp((b - c) / a), 1};
    return {s, t};
}

} // namespace clothlab::sim
