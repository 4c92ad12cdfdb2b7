// The classical fourth order Runge-Kutta method: W. Kutta, Zeitschrift fuer Mathematik und Physik 46 (1901).
#include "sim/forces/forces.h"
#include "sim/integrators/combine.h"
#include "sim/integrators/integrator.h"
#include "sim/integrators/runge_kutta_limit.h"
#include "sim/stage_timer.h"

namespace clothlab::sim {

template <class Real>
void rk4(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    const Real dt = static_cast<Real>(model.dt), half = Real(0.5) * dt;
    auto& w = work.arrays;
    const Vec3Array<Real>&x1 = state.position, &v1 = state.velocity;
    Vec3Array<Real>&a1 = w[0], &a2 = w[1], &a3 = w[2], &a4 = w[3], &v2 = w[4], &v3 = w[5], &v4 = w[6], &x = w[7];
    accelerations(model, x1, &v1, state.time, work, a1);
    combine(x, x1, Term<Real>{half, &v1});
    combine(v2, v1, Term<Real>{half, &a1});
    accelerations(model, x, &v2, state.time + 0.5 * model.dt, work, a2);
    combine(x, x1, Term<Real>{half, &v2});
    combine(v3, v1, Term<Real>{half, &a2});
    accelerations(model, x, &v3, state.time + 0.5 * model.dt, work, a3);
    combine(x, x1, Term<Real>{dt, &v3});
    combine(v4, v1, Term<Real>{dt, &a3});
    accelerations(model, x, &v4, state.time + model.dt, work, a4);
    counts.force_evaluations = 4;
    const StageTimer timer(work, Stage::integrate);
    const Real sixth = dt / Real(6), third = dt / Real(3);
    state.previous = state.position;
    combine(state.position, state.position, Term<Real>{sixth, &state.velocity}, Term<Real>{third, &v2},
            Term<Real>{third, &v3}, Term<Real>{sixth, &v4});
    combine(state.velocity, state.velocity, Term<Real>{sixth, &a1}, Term<Real>{third, &a2}, Term<Real>{third, &a3},
            Term<Real>{sixth, &a4});
    scale(state.velocity, model.course_keep);
}

const IntegratorTraits rk4_traits{
    .title = "Runge-Kutta 4",
    .help = "Fourth order: by far the most accurate for smooth motion, at four times the cost, with a limit only 1.4 "
            "times that of Verlet.",
    .family = Family::explicit_method,
    .order = 4,
    .limit_formula = "2 sqrt(2) undamped",
    .limit =
        [](double d) {
            return runge_kutta_limit([](double y) { return 1 - y * y / 2 + y * y * y * y / 24; },
                                     [](double y) { return y - y * y * y / 6; }, d);
        },
    .cost = "4 force evaluations",
    .source = "W. Kutta, Zeitschrift fuer Mathematik und Physik 46 (1901)",
    .velocity = true,
    .arrays = 8};

CLOTHLAB_DEFINE_INTEGRATOR(rk4)

} // namespace clothlab::sim
