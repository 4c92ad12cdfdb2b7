// The implicit midpoint rule: x' = x + dt (v + v')/2, v' = v + dt a((x + x')/2, (v + v')/2). E. Hairer, C. Lubich, G.
// Wanner, "Geometric Numerical Integration", section II.1.1. The midpoint is where backward Euler gets in half a step,
// and the step goes as far again: it neither damps nor excites a linear oscillation. Wind is that of the step's
// beginning.
#include "sim/implicit/backward_step.h"
#include "sim/integrators/combine.h"
#include "sim/integrators/implicit.h"
#include "sim/integrators/integrator.h"

namespace clothlab::sim {

template <class Real>
void implicit_midpoint(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    auto& solver = BackwardSolver<Real>::of(model, work);
    Vec3Array<Real>&x = work.arrays[0], &v = work.arrays[1], &wind = work.arrays[2];
    const BackwardStep<Real> half{.gamma = 0.5 * model.dt,
                                  .position = &state.position,
                                  .velocity = &state.velocity,
                                  .further_forces = wind_forces(model, state, work, wind)};
    combine(x, state.position, Term<Real>{static_cast<Real>(half.gamma), &state.velocity});
    solver.newton(model, half, x, work, counts);
    BackwardSolver<Real>::velocity(model, half, x, v);
    state.previous = state.position;
    const Real dt = static_cast<Real>(model.dt);
    combine(state.position, state.position, Term<Real>{dt, &v});
    // v' = v + 2 (v_mid - v)
    combine(state.velocity, v, Term<Real>{Real(1), &v}, Term<Real>{Real(-1), &state.velocity});
    scale(state.velocity, model.course_keep);
}

const IntegratorTraits implicit_midpoint_traits{
    .title = "Implicit midpoint",
    .help = "Second order, stable at any step, and no damping of its own: a quadratic energy is conserved exactly, so "
            "what is "
            "too fine for the step goes on ringing.",
    .family = Family::implicit_method,
    .order = 2,
    .limit_formula = "none",
    .limit = [](double) { return no_limit; },
    .cost = "some Newton iterations, each a force evaluation and a linear solve",
    .source = "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, section II.1.1",
    .velocity = true,
    .arrays = 3,
    .options = uses_tolerance};

CLOTHLAB_DEFINE_INTEGRATOR(implicit_midpoint)

} // namespace clothlab::sim
