// Velocity Verlet (kick, drift, kick): W. C. Swope, H. C. Andersen, P. H. Berens, K. R. Wilson, Journal of Chemical
// Physics 76 (1982), equations A.5 and A.6:
//     v(t + dt/2) = v + a dt/2,  x(t + dt) = x + dt v(t + dt/2),  v(t + dt) = v(t + dt/2) + a(t + dt) dt/2
// With the physical rule's damping each half kick is the exact solution of v' = a - c v for constant a.
#include <cmath>

#include "sim/forces/forces.h"
#include "sim/integrators/combine.h"
#include "sim/integrators/integrator.h"
#include "sim/stage_timer.h"

namespace clothlab::sim {

template <class Real>
void velocity_verlet(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    const Real dt = static_cast<Real>(model.dt);
    const double decay = 0.5 * model.damping_rate * model.dt;
    const Real half_keep = static_cast<Real>(std::exp(-decay));
    const Real half_share = decay == 0 ? Real(1) : static_cast<Real>(-std::expm1(-decay) / decay);
    const Real kick = Real(0.5) * dt * half_share;
    Vec3Array<Real>& a = work.arrays[0];
    // The second kick's accelerations are the next step's first, unless contacts move points in between or air does
    // not stand still.
    const bool reuse = work.force_of_step == state.steps && state.steps > 0 && model.wind.kind == WindKind::none;
    if (!reuse)
        undamped_accelerations(model, state.position, state.velocity, state.time, work, a);
    state.previous = state.position;
    scale(state.velocity, model.course_keep);
    scale(state.velocity, half_keep);
    combine(state.velocity, state.velocity, Term<Real>{kick, &a});
    combine(state.position, state.position, Term<Real>{dt, &state.velocity});
    undamped_accelerations(model, state.position, state.velocity, state.time + model.dt, work, a);
    const StageTimer timer(work, Stage::integrate);
    scale(state.velocity, half_keep);
    combine(state.velocity, state.velocity, Term<Real>{kick, &a});
    work.force_of_step = state.steps + 1;
    counts.force_evaluations = reuse ? 1 : 2;
}

const IntegratorTraits velocity_verlet_traits{
    .title = "Velocity Verlet",
    .help = "Verlet with velocities known at the same times as positions: second order from any start, and no drift of "
            "the energy.",
    .family = Family::explicit_method,
    .order = 2,
    // A step has the trace (2 - d) (1 - y²/2) and the determinant 1 - d: unlike course Verlet's limit, this one stays.
    .limit_formula = "2",
    .limit = [](double) { return 2.0; },
    .cost = "1 force evaluation, 2 after a contact or in wind",
    .source =
        "W. C. Swope, H. C. Andersen, P. H. Berens, K. R. Wilson, Journal of Chemical Physics 76 (1982), A.5 and A.6",
    .velocity = true,
    .arrays = 1};

CLOTHLAB_DEFINE_INTEGRATOR(velocity_verlet)

} // namespace clothlab::sim
