// BDF2, the backward differentiation formula of second order: E. Hairer, G. Wanner, "Solving Ordinary Differential
// Equations II", section V.1; for cloth, K.-J. Choi, H.-S. Ko, "Stable but responsive cloth", SIGGRAPH 2002, section 4:
//     x' = (4 x - x_before)/3 + 2/3 dt v',   v' = (4 v - v_before)/3 + 2/3 dt a(x', v')
// which is backward Euler from other places with another step. The first step, and the one after a change of dt or of
// the method, is backward Euler's own.
#include "sim/implicit/backward_step.h"
#include "sim/integrators/combine.h"
#include "sim/integrators/implicit.h"
#include "sim/integrators/integrator.h"

namespace clothlab::sim {

template <class Real>
void bdf2(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    auto& solver = BackwardSolver<Real>::of(model, work);
    Vec3Array<Real>&x = work.arrays[0], &from_x = work.arrays[1], &from_v = work.arrays[2], &wind = work.arrays[3];
    const bool looks_back = state.history > 0;
    const Real third = looks_back ? Real(1) / Real(3) : Real(0);
    combine(from_x, state.position, Term<Real>{third, &state.position}, Term<Real>{-third, &state.previous});
    combine(from_v, state.velocity, Term<Real>{third, &state.velocity}, Term<Real>{-third, &state.previous_velocity});
    for (const std::uint32_t pin : model.pins) { // a third of a position and back again may be a bit off
        from_x.x[pin] = state.position.x[pin];
        from_x.y[pin] = state.position.y[pin];
        from_x.z[pin] = state.position.z[pin];
    }
    const BackwardStep<Real> step{.gamma = looks_back ? model.dt * 2 / 3 : model.dt,
                                  .position = &from_x,
                                  .velocity = &from_v,
                                  .further_forces = wind_forces(model, state, work, wind)};
    combine(x, state.position, Term<Real>{static_cast<Real>(model.dt), &state.velocity});
    solver.newton(model, step, x, work, counts);
    std::swap(state.previous_velocity, state.velocity);
    BackwardSolver<Real>::velocity(model, step, x, state.velocity);
    state.previous = state.position;
    std::swap(state.position, x);
    scale(state.velocity, model.course_keep);
    state.history = 1;
}

const IntegratorTraits bdf2_traits{
    .title = "BDF2",
    .help = "Second order and stable at any step; damps what is too fine for the step, and far less of the rest than "
            "backward "
            "Euler. Looks one step back, which a contact makes a little wrong.",
    .family = Family::implicit_method,
    .order = 2,
    .limit_formula = "none",
    .limit = [](double) { return no_limit; },
    .cost = "some Newton iterations, each a force evaluation and a linear solve",
    .source = "E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, section V.1; K.-J. Choi, H.-S. Ko, "
              "SIGGRAPH 2002, section 4",
    .velocity = true,
    .history = true,
    .arrays = 4,
    .options = uses_tolerance};

CLOTHLAB_DEFINE_INTEGRATOR(bdf2)

} // namespace clothlab::sim
