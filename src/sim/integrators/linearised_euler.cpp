// Backward Euler, linearised once about the present positions: D. Baraff, A. Witkin, "Large steps in cloth simulation",
// SIGGRAPH 1998, section 3. One iteration of Newton's method from there, and so one linear solve a step; on springs
// that stay straight it is backward Euler itself. The solver begins where the points would go if they kept their
// velocities.
#include "sim/implicit/backward_step.h"
#include "sim/integrators/combine.h"
#include "sim/integrators/implicit.h"
#include "sim/integrators/integrator.h"

namespace clothlab::sim {

template <class Real>
void linearised_euler(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    auto& solver = BackwardSolver<Real>::of(model, work);
    Vec3Array<Real>&x = work.arrays[0], &wind = work.arrays[1], &guess = work.arrays[2];
    const BackwardStep<Real> step{.gamma = model.dt,
                                  .position = &state.position,
                                  .velocity = &state.velocity,
                                  .further_forces = wind_forces(model, state, work, wind)};
    combine(guess, state.position, Term<Real>{static_cast<Real>(model.dt), &state.velocity});
    x = state.position;
    solver.linearised(model, step, x, &guess, work, counts);
    BackwardSolver<Real>::velocity(model, step, x, state.velocity);
    state.previous = state.position;
    std::swap(state.position, x);
    scale(state.velocity, model.course_keep);
}

const IntegratorTraits linearised_euler_traits{.title = "Backward Euler, linearised",
                                               .help = "The method of Baraff and Witkin: one linear solve a step, "
                                                       "solved to the tolerance. As stable as backward Euler "
                                                       "as long as the cloth does not turn far within a step.",
                                               .family = Family::implicit_method,
                                               .order = 1,
                                               .limit_formula = "none",
                                               .limit = [](double) { return no_limit; },
                                               .cost = "1 force evaluation and a linear solve",
                                               .source = "D. Baraff, A. Witkin, SIGGRAPH 1998, section 3",
                                               .velocity = true,
                                               .arrays = 3,
                                               .options = uses_tolerance};

CLOTHLAB_DEFINE_INTEGRATOR(linearised_euler)

} // namespace clothlab::sim
