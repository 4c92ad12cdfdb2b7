// How far a state is from the stability limit of the model's method.
//
// Small motions about a pose x are oscillations m u'' = -K(x) u, K the Hessian of the springs' energy. A method stays
// bounded as long as omega dt of the fastest of them is below its limit (IntegratorTraits::limit); contacts and the
// stretch limit are not part of it.
#pragma once

#include <limits>

#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

/// All numbers are of the present pose and of the model's method; where a parameter is "largest" or "smallest", all
/// others stay as they are. Infinity: without a limit; for substeps_min: no number is enough.
struct StabilityMargin {
    double omega = 0;        ///< rad/s, of the fastest mode: an estimate that is not below it
    double omega_bound = 0;  ///< rad/s, certainly not below it, and cheap: row sums of |K|/m
    double omega_dt = 0;     ///< as the method takes it: omega dt, with exactly integrated damping a little less
    double limit = 0;        ///< largest omega_dt at which the method does not grow
    double dt_max = 0;       ///< s
    double ks_max = 0;       ///< N/m
    double density_min = 0;  ///< kg/m²
    double substeps_min = 1; ///< per frame, a whole number
    /// Whether small motions stay bounded. With a negative mass they never do, whatever dt: springs push, and omega is
    /// set to infinity.
    bool stable() const { return omega < std::numeric_limits<double>::infinity() && omega_dt <= limit; }
    bool operator==(const StabilityMargin&) const = default;
};

/// The margin of a pose. Computed in double precision by Lanczos' method; allocates. Positions that are not finite have
/// an infinite omega.
template <class Real>
StabilityMargin stability_margin(const Model<Real>& model, const Vec3Array<Real>& position);
template <class Real>
StabilityMargin stability_margin(const Model<Real>& model, const State<Real>& state) {
    return stability_margin(model, state.position);
}

extern template StabilityMargin stability_margin<float>(const Model<float>&, const Vec3Array<float>&);
extern template StabilityMargin stability_margin<double>(const Model<double>&, const Vec3Array<double>&);

} // namespace clothlab::sim
