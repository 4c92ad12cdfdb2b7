// What a refinement of the step tells: with which power of the step the error falls, how exact a reference is, and
// which settings are worth their cost.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace clothlab::experiments {

/// A straight line in log-log: error = const * dt^slope.
struct Slope {
    double slope = 0;
    std::size_t first = 0, last = 0; ///< of the points that it is fitted to, both included
    double decades = 0;              ///< of steps between them
};

/// How far a local slope, from one point to the next, may be off the fitted one for the points to lie on a line.
inline constexpr double straightness = 0.05;
/// A line that is flatter is no convergence, but an error that the step has no part in.
inline constexpr double flattest = 0.5;

/// Fits a line, by least squares in the logarithms, to the longest run (in decades of steps) of at least three
/// consecutive points which lie on one: no local slope is further than `straightness` from the fitted one. That is the
/// asymptotic range: coarser steps do not follow the motion yet, finer ones meet rounding, a solver's tolerance or the
/// reference's own error. The order that a method should have plays no part in it. Steps have to be in descending
/// order; points that are not `usable`, or whose error is not above 0, end a run. Nothing where no line of at least
/// `flattest` is found.
std::optional<Slope> fit_slope(const std::vector<double>& dt, const std::vector<double>& error,
                               const std::vector<bool>& usable);

/// The error of the finest of three solutions with steps h, h/2 and h/4: `coarse` is the difference of the first two,
/// `fine` that of the last two. Richardson's estimate fine / (r - 1) with r = coarse / fine, the rate at which the
/// differences fall, no larger than 2^order; where they fall by less than half, rounding or contacts are most of them,
/// and it is the larger of the two.
double refined_error(double coarse, double fine, int order);

/// Which points no other beats: none is at most as dear and at most as wrong, and less of one of them. Points without
/// a number in both are not on the front; of equal points the first is.
std::vector<bool> pareto_front(const std::vector<double>& cost, const std::vector<double>& error);

} // namespace clothlab::experiments
