// The fastest oscillation of a cloth about the pose that it starts in, and what a run's steps make of it.
#pragma once

#include <optional>
#include <vector>

#include "sim/description.h"

namespace clothlab::experiments {

/// The shape of the springs' Hessian's eigenvector with the largest eigenvalue at the start pose, its largest
/// displacement 1, by power iteration (A. Householder, "The theory of matrices in numerical analysis", 1964,
/// section 7.2) of the Hessian less 0.4 times the eigenvalue found so far. Nothing where that does not converge: where
/// several modes are nearly as fast as each other.
std::optional<std::vector<sim::Vec3>> fastest_mode(const sim::Description& description);

/// What a step multiplies an oscillation by: the larger modulus of the roots of z² = s z - p, where s and p fit
/// x(n+1) = s x(n) - p x(n-1) to a series best (least squares). Ends the fit where the series has grown a thousandfold.
/// A series of less than four numbers, or of zeros, has 1.
double growth_per_step(const std::vector<double>& series);

} // namespace clothlab::experiments
