// Where a run is predicted to become unstable: where omega dt of the fastest mode of the start pose, by Lanczos'
// method, crosses the method's limit, by formula (sim/stability.h).
#pragma once

#include <functional>
#include <vector>

#include "sim/description.h"

namespace clothlab::experiments {

/// omega dt over its limit at the start pose: above 1, unstable. 0 for methods without a limit, infinity for those that
/// always grow and for cloth that pushes. Throws Refusal for descriptions without meaning.
double limit_ratio(const sim::Description& description);

/// Where a ratio crosses 1, as a function of a parameter, by bisection and, between finite values, by regula falsi with
/// the Illinois rule (M. Dowell, P. Jarratt, BIT 11 (1971)) on its logarithm: to 1e-6 of the value, or, of whole
/// numbers, between those next to each other and interpolated. One crossing is found between any two of the ascending
/// `values` that are on different sides.
std::vector<double> crossings(const std::function<double(double)>& ratio, const std::vector<double>& values, bool log,
                              bool whole);

} // namespace clothlab::experiments
