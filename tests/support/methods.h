// What theory says of every method on the undamped oscillator x'' = -omega² x, as a function of y = omega dt, and what
// of that is known of a method that is not named here: its traits alone.
#pragma once

#include <cmath>
#include <complex>
#include <optional>
#include <string_view>

#include "sim/integrators/integrator.h"
#include "support/sheet.h"

namespace clothlab::test {

using Complex = std::complex<double>;

/// coefficient * y^power, to leading order as y goes to 0.
struct Law {
    double coefficient;
    int power;
};

/// One step multiplies the oscillation exp(i omega t) by `factor(y)`. Its logarithm is i y (1 + frequency error) +
/// growth.
struct ExactMethod {
    std::string_view name;
    Complex (*factor)(double y);
    Law frequency_error;
    Law growth; ///< of the amplitude in one step; negative: damping. Coefficient 0: none at any y
};

/// The roots follow from inserting x'' = -omega² x into each method's formula: E. Hairer, G. Wanner, "Solving Ordinary
/// Differential Equations II", section IV.3 (stability functions), section V.1 for BDF2.
inline constexpr ExactMethod exact_methods[] = {
#define CLOTHLAB_VERLET                                                                                                \
    [](double y) { return Complex(1 - y * y / 2, y * std::sqrt(1 - y * y / 4)); }, {1.0 / 24, 2}, {                    \
        0, 2                                                                                                           \
    }
    {"course-verlet", CLOTHLAB_VERLET},
    {"velocity-verlet", CLOTHLAB_VERLET},
    {"symplectic-euler", CLOTHLAB_VERLET},
#undef CLOTHLAB_VERLET
    {"explicit-euler", [](double y) { return Complex(1, y); }, {-1.0 / 3, 2}, {0.5, 2}},
    {"heun", [](double y) { return Complex(1 - y * y / 2, y); }, {1.0 / 6, 2}, {1.0 / 8, 4}},
    {"rk4",
     [](double y) { return Complex(1 - y * y / 2 + std::pow(y, 4) / 24, y - y * y * y / 6); },
     {-1.0 / 120, 4},
     {-1.0 / 144, 6}},
    {"dormand-prince",
     [](double y) {
         return Complex(1 - y * y / 2 + std::pow(y, 4) / 24 - std::pow(y, 6) / 600,
                        y - y * y * y / 6 + std::pow(y, 5) / 120);
     },
     {1.0 / 2100, 6},
     {-1.0 / 3600, 6}},
#define CLOTHLAB_BACKWARD_EULER                                                                                        \
    [](double y) { return 1.0 / Complex(1, -y); }, {-1.0 / 3, 2}, {                                                    \
        -0.5, 2                                                                                                        \
    }
    {"backward-euler", CLOTHLAB_BACKWARD_EULER},
    // On a linear spring one Newton step is all of them, and every solver of the same equations finds the same.
    {"linearised-euler", CLOTHLAB_BACKWARD_EULER},
    {"xpbd", CLOTHLAB_BACKWARD_EULER},
    {"projective-dynamics", CLOTHLAB_BACKWARD_EULER},
    {"vertex-block-descent", CLOTHLAB_BACKWARD_EULER},
#undef CLOTHLAB_BACKWARD_EULER
    {"imex", // (1 + (1 - 2g) z)/(1 - g z)² with g = 1 - 1/sqrt(2), z = iy: frequency (2 + 2 sqrt(2)) g³/3, growth g^4/2
     [](double y) {
         const double g = 1 - 1 / std::sqrt(2.0);
         return Complex(1, (1 - 2 * g) * y) / (Complex(1, -g * y) * Complex(1, -g * y));
     },
     {-0.0404401145, 2},
     {-0.0036796564, 4}},
    {"implicit-midpoint", [](double y) { return Complex(1, y / 2) / Complex(1, -y / 2); }, {-1.0 / 12, 2}, {0, 2}},
    {"bdf2",
     [](double y) { return (2.0 + std::sqrt(Complex(1, 2 * y))) / Complex(3, -2 * y); },
     {-1.0 / 3, 2},
     {-0.25, 4}},
};

inline const ExactMethod* exact(std::string_view name) {
    for (const ExactMethod& method : exact_methods)
        if (method.name == name)
            return &method;
    return nullptr;
}

inline const sim::IntegratorInfo& method_of(sim::IntegratorId id) {
    return sim::integrators()[static_cast<std::size_t>(id)];
}

/// Makes a method compute as exactly as it can: no step control, solvers to the last digits.
inline void solve_exactly(sim::Description& description, const sim::IntegratorInfo& method) {
    description.stepping.integrator = method.id;
    description.stepping.tolerance = method.family == sim::Family::explicit_method ? 0 : 1e-13;
    description.stepping.iterations = 40;
}

/// Whether an oscillation of a method neither grows without bound at omega dt = y nor is known to be of no spring.
inline bool stable(const sim::IntegratorTraits& method, double y) {
    return method.limit(0) >= y;
}

} // namespace clothlab::test
