// The course's stretch limit: X. Provot, "Deformation constraints in a mass-spring model to describe rigid cloth
// behavior", Graphics Interface 1995, section 4, as one Gauss-Seidel sweep.
#pragma once

#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

/// Shortens every spring that is longer than 1.1 times its rest length, in spring order, by moving its free ends.
/// Returns the number of springs shortened.
template <class Real>
std::size_t limit_stretch(const Model<Real>& model, State<Real>& state);

extern template std::size_t limit_stretch<float>(const Model<float>&, State<float>&);
extern template std::size_t limit_stretch<double>(const Model<double>&, State<double>&);

} // namespace clothlab::sim
