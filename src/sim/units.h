// The simulation computes in SI units throughout. The course's file format and interface show some quantities in other
// units; these are the only places where one becomes the other.
#pragma once

namespace clothlab::sim {

/// kg/m² to the course interface's g/cm².
constexpr double grams_per_cm2(double kilograms_per_m2) {
    return kilograms_per_m2 / 10.0;
}
/// Percent to a fraction of one.
constexpr double fraction(double percent) {
    return percent / 100.0;
}

} // namespace clothlab::sim
