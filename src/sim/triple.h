// Three coordinates in one precision, with the little arithmetic that plain loops need.
#pragma once

#include <cmath>
#include <cstddef>

#include "sim/aligned.h"

namespace clothlab::sim {

template <class Real>
struct Triple {
    Real x, y, z;
};

template <class Real>
Triple<Real> operator-(Triple<Real> a, Triple<Real> b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
Real dot(Triple<Real> a, Triple<Real> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
Real norm(Triple<Real> a) {
    return std::sqrt(dot(a, a));
}
/// a + s b
template <class Real>
Triple<Real> along(Triple<Real> a, Real s, Triple<Real> b) {
    return {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

template <class Real>
Triple<Real> at(const Vec3Array<Real>& array, std::size_t i) {
    return {array.x[i], array.y[i], array.z[i]};
}
template <class Real>
void put(Vec3Array<Real>& array, std::size_t i, Triple<Real> v) {
    array.x[i] = v.x;
    array.y[i] = v.y;
    array.z[i] = v.z;
}

} // namespace clothlab::sim
