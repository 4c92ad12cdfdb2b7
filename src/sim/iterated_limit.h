// The stretch limit held to the end: X. Provot's deformation constraints (stretch_limit.h), swept over until they hold.
#pragma once

#include <cstddef>

#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

/// Sweeps that a step takes at the most. Where they do not suffice, or where pins are too far apart for any number to,
/// springs stay longer than the limit; the next step goes on from there.
inline constexpr int most_limit_sweeps = 100;

/// Shortens springs longer than (1.1 + model.tolerance) times their rest length to 1.1 times, in Gauss-Seidel sweeps
/// that go through the points forth and back by turns, until a sweep finds none. What the rounding of the coordinates
/// may make of a length is allowed for on top. Returns the number of springs shortened, counted anew in each sweep.
template <class Real>
std::size_t limit_stretch_iterated(const Model<Real>& model, State<Real>& state);

extern template std::size_t limit_stretch_iterated<float>(const Model<float>&, State<float>&);
extern template std::size_t limit_stretch_iterated<double>(const Model<double>&, State<double>&);

} // namespace clothlab::sim
