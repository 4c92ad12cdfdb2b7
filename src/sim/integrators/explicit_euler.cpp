// Explicit (forward) Euler: x' = x + dt v, v' = v + dt a(x, v). L. Euler, Institutiones calculi integralis I (1768),
// section 650. On an oscillator it grows by sqrt(1 + (omega dt)²) in every step, however small: here to be seen
// failing.
#include <cmath>

#include "sim/forces/forces.h"
#include "sim/integrators/combine.h"
#include "sim/integrators/integrator.h"
#include "sim/stage_timer.h"

namespace clothlab::sim {

template <class Real>
void explicit_euler(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    const Real dt = static_cast<Real>(model.dt);
    Vec3Array<Real>& a = work.arrays[0];
    accelerations(model, state.position, &state.velocity, state.time, work, a);
    counts.force_evaluations = 1;
    const StageTimer timer(work, Stage::integrate);
    state.previous = state.position;
    combine(state.position, state.position, Term<Real>{dt, &state.velocity});
    combine(state.velocity, state.velocity, Term<Real>{dt, &a});
    scale(state.velocity, model.course_keep);
}

const IntegratorTraits explicit_euler_traits{
    .title = "Explicit Euler",
    .help = "The simplest method, and the classic mistake: every oscillation grows, whatever the step.",
    .family = Family::explicit_method,
    .order = 1,
    // A step's determinant is (1 - d) (1 + y²).
    .limit_formula = "sqrt(d / (1 - d)): 0 undamped",
    .limit = [](double d) { return std::sqrt(d / (1 - d)); },
    .cost = "1 force evaluation",
    .source = "L. Euler, Institutiones calculi integralis I (1768), section 650",
    .velocity = true,
    .arrays = 1};

CLOTHLAB_DEFINE_INTEGRATOR(explicit_euler)

} // namespace clothlab::sim
