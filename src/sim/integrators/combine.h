// Sums of arrays of vectors, as Runge-Kutta methods need them.
#pragma once

#include <array>
#include <cstddef>

#include "sim/aligned.h"

namespace clothlab::sim {

/// A factor and what it multiplies.
template <class Real>
struct Term {
    Real factor;
    const Vec3Array<Real>* array;
};

/// out = base + sum of the terms, from the left. `out` may be one of the arrays.
template <class Real, std::size_t n>
void combine(Vec3Array<Real>& out, const Vec3Array<Real>& base, const std::array<Term<Real>, n>& terms) {
    const std::size_t points = base.size();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Real* o = out.axes()[axis];
        const Real* b = base.axes()[axis];
        std::array<const Real*, n> t;
        for (std::size_t k = 0; k < n; ++k)
            t[k] = terms[k].array->axes()[axis];
        for (std::size_t i = 0; i < points; ++i) {
            Real sum = b[i];
            for (std::size_t k = 0; k < n; ++k)
                sum += terms[k].factor * t[k][i];
            o[i] = sum;
        }
    }
}

template <class Real, class... Terms>
void combine(Vec3Array<Real>& out, const Vec3Array<Real>& base, Term<Real> first, Terms... rest) {
    combine(out, base, std::array<Term<Real>, 1 + sizeof...(rest)>{first, rest...});
}

/// v *= factor, unless it is 1: the course's damping, once a step.
template <class Real>
void scale(Vec3Array<Real>& v, Real factor) {
    if (factor == 1)
        return;
    for (Real* axis : v.axes())
        for (std::size_t i = 0; i < v.size(); ++i)
            axis[i] *= factor;
}

} // namespace clothlab::sim
