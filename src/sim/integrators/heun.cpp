// Heun's method (RK2, explicit trapezoidal rule): K. Heun, Zeitschrift fuer Mathematik und Physik 45 (1900).
// On an oscillator it grows by 1 + (omega dt)^4/8 in every step: slowly, but at any step.
#include <cmath>

#include "sim/forces/forces.h"
#include "sim/integrators/combine.h"
#include "sim/integrators/integrator.h"
#include "sim/stage_timer.h"

namespace clothlab::sim {

template <class Real>
void heun(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    const Real dt = static_cast<Real>(model.dt), half = Real(0.5) * dt;
    Vec3Array<Real>&a1 = work.arrays[0], &a2 = work.arrays[1], &x2 = work.arrays[2], &v2 = work.arrays[3];
    accelerations(model, state.position, &state.velocity, state.time, work, a1);
    combine(x2, state.position, Term<Real>{dt, &state.velocity});
    combine(v2, state.velocity, Term<Real>{dt, &a1});
    accelerations(model, x2, &v2, state.time + model.dt, work, a2);
    counts.force_evaluations = 2;
    const StageTimer timer(work, Stage::integrate);
    state.previous = state.position;
    combine(state.position, state.position, Term<Real>{half, &state.velocity}, Term<Real>{half, &v2});
    combine(state.velocity, state.velocity, Term<Real>{half, &a1}, Term<Real>{half, &a2});
    scale(state.velocity, model.course_keep);
}

const IntegratorTraits heun_traits{
    .title = "Heun (RK2)",
    .help = "Second order, but without a stable step for undamped springs: oscillations grow by (omega dt)^4/8 a step.",
    .family = Family::explicit_method,
    .order = 2,
    // A step's determinant is (1 - d) (1 + y⁴/4).
    .limit_formula = "(4 d / (1 - d))^(1/4): 0 undamped",
    .limit = [](double d) { return std::pow(4 * d / (1 - d), 0.25); },
    .cost = "2 force evaluations",
    .source = "K. Heun, Zeitschrift fuer Mathematik und Physik 45 (1900)",
    .velocity = true,
    .arrays = 4};

CLOTHLAB_DEFINE_INTEGRATOR(heun)

} // namespace clothlab::sim
