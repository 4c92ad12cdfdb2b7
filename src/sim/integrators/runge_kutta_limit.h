// The stability limit of an explicit Runge-Kutta method under the course's damping, which takes the share d of the
// velocity after each step.
#pragma once

#include <cmath>

namespace clothlab::sim {

/// The largest y = omega dt up to which an oscillator stays bounded, for a method that without damping multiplies
/// x + i v / omega by p(y) - i q(y) in a step. With it a step has the trace (2 - d) p and the determinant
/// D = (1 - d) (p² + q²), and its roots are within the unit circle while D <= 1 and |trace| <= 1 + D: E. Hairer, G.
/// Wanner, "Solving Ordinary Differential Equations II", section IV.2 for p and q; E. I. Jury's conditions for the
/// rest.
template <class Real, class Imaginary>
double runge_kutta_limit(Real p, Imaginary q, double d) {
    const auto bounded = [&](double y) {
        constexpr double rounding = 1e-14;
        const double real = p(y), determinant = (1 - d) * (real * real + q(y) * q(y));
        return determinant <= 1 + rounding && (2 - d) * std::abs(real) <= 1 + determinant + rounding;
    };
    constexpr double stride = 1e-3; // the region has no gaps as fine as that
    double low = 0;
    while (bounded(low + stride))
        low += stride;
    double high = low + stride;
    for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (low + high);
        (bounded(middle) ? low : high) = middle;
    }
    return low;
}

} // namespace clothlab::sim
