// Backward Euler, its equations solved by Newton's method: x' = x + dt v', v' = v + dt a(x', v').
// The step as a minimisation: sim/implicit/backward_step.h. Wind is taken as it is at the beginning of the step.
#include "sim/forces/forces.h"
#include "sim/implicit/backward_step.h"
#include "sim/integrators/combine.h"
#include "sim/integrators/implicit.h"
#include "sim/integrators/integrator.h"

namespace clothlab::sim {

template <class Real>
void backward_euler(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    auto& solver = BackwardSolver<Real>::of(model, work);
    Vec3Array<Real>&x = work.arrays[0], &wind = work.arrays[1];
    const BackwardStep<Real> step{.gamma = model.dt,
                                  .position = &state.position,
                                  .velocity = &state.velocity,
                                  .further_forces = wind_forces(model, state, work, wind)};
    combine(x, state.position, Term<Real>{static_cast<Real>(model.dt), &state.velocity});
    solver.newton(model, step, x, work, counts);
    BackwardSolver<Real>::velocity(model, step, x, state.velocity);
    state.previous = state.position;
    std::swap(state.position, x);
    scale(state.velocity, model.course_keep);
}

const IntegratorTraits backward_euler_traits{
    .title = "Backward Euler",
    .help =
        "Stable at any step, and as damped as it is stable: fine motion dies out within a few large steps. Solved to "
        "the tolerance by Newton's method.",
    .family = Family::implicit_method,
    .order = 1,
    .limit_formula = "none",
    .limit = [](double) { return no_limit; },
    .cost = "some Newton iterations, each a force evaluation and a linear solve",
    .source = "S. Martin, B. Thomaszewski, E. Grinspun, M. Gross, SIGGRAPH 2011, section 4, for the step as a "
              "minimisation",
    .velocity = true,
    .arrays = 2,
    .options = uses_tolerance};

CLOTHLAB_DEFINE_INTEGRATOR(backward_euler)

} // namespace clothlab::sim
