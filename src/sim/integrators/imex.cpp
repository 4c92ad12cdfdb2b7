// An implicit-explicit Runge-Kutta method: springs implicit, gravity, wind and damping explicit. ARS(2,2,2) of U. M.
// Ascher, S. J. Ruuth, R. J. Spiteri, "Implicit-explicit Runge-Kutta methods for time-dependent partial differential
// equations", Applied Numerical Mathematics 25 (1997), section 2.6: second order, its implicit part L-stable. With g =
// 1 - 1/sqrt(2) and d = 1 - 1/(2 g), y = (x, v), S the springs' part of y' and E the rest:
//     y1 = y + dt g S(y1) + dt g E(y)
//     y' = y + dt ((1 - g) S(y1) + g S(y')) + dt (d E(y) + (1 - d) E(y1))
// Both stages are steps of backward Euler of length g dt from other places (sim/implicit/backward_step.h).
#include <cmath>

#include "sim/forces/forces.h"
#include "sim/implicit/backward_step.h"
#include "sim/integrators/combine.h"
#include "sim/integrators/integrator.h"

namespace clothlab::sim {
namespace {

/// Accelerations without the springs': all forces less theirs.
template <class Real>
void explicit_part(const Model<Real>& model, const Vec3Array<Real>& x, const Vec3Array<Real>& v, double time,
                   Workspace<Real>& work, Vec3Array<Real>& out) {
    const std::array<Real, 3> g{model.gx, model.gy, model.gz};
    if (model.wind.kind == WindKind::none) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Real* a = out.axes()[axis];
            const Real c = static_cast<Real>(model.damping_rate);
            for (std::size_t i = 0; i < out.size(); ++i)
                a[i] = g[axis] - c * v.axes()[axis][i];
        }
    } else { // the course's air resistance depends on all forces
        accelerations(model, x, &v, time, work, out);
        evaluate_conservative_forces(model, x, work, work.force);
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < out.size(); ++i)
                out.axes()[axis][i] += g[axis] - work.force.axes()[axis][i] / model.mass;
    }
    for (const std::uint32_t pin : model.pins)
        out.x[pin] = out.y[pin] = out.z[pin] = 0;
}

} // namespace

template <class Real>
void imex(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    const double dt = model.dt, g = 1 - 1 / std::sqrt(2.0), d = 1 - 1 / (2 * g);
    const auto times_dt = [&](double share) { return static_cast<Real>(share * dt); };
    auto& w = work.arrays;
    Vec3Array<Real>&e0 = w[0], &e1 = w[1], &s1 = w[2], &x1 = w[3], &v1 = w[4], &from_x = w[5], &from_v = w[6],
    &x2 = w[7];
    auto& solver = BackwardSolver<Real>::of(model, work);
    const BackwardStep<Real> stage{.gamma = g * dt,
                                   .position = &from_x,
                                   .velocity = &from_v,
                                   .further_forces = nullptr,
                                   .with_gravity = false,
                                   .with_damping = false};

    explicit_part(model, state.position, state.velocity, state.time, work, e0);
    from_x = state.position;
    combine(from_v, state.velocity, Term<Real>{times_dt(g), &e0});
    combine(x1, from_x, Term<Real>{times_dt(g), &from_v});
    solver.newton(model, stage, x1, work, counts);
    BackwardSolver<Real>::velocity(model, stage, x1, v1);
    // What the springs did in the stage: S(y1) = (v1 - v^) / (g dt).
    combine(s1, v1, Term<Real>{Real(-1), &from_v});
    scale(s1, Real(1) / times_dt(g));

    explicit_part(model, x1, v1, state.time + g * dt, work, e1);
    combine(from_x, state.position, Term<Real>{times_dt(1 - g), &v1});
    combine(from_v, state.velocity, Term<Real>{times_dt(1 - g), &s1}, Term<Real>{times_dt(d), &e0},
            Term<Real>{times_dt(1 - d), &e1});
    combine(x2, from_x, Term<Real>{times_dt(g), &from_v});
    solver.newton(model, stage, x2, work, counts);
    BackwardSolver<Real>::velocity(model, stage, x2, state.velocity);
    state.previous = state.position;
    std::swap(state.position, x2);
    scale(state.velocity, model.course_keep);
}

const IntegratorTraits imex_traits{
    .title = "IMEX Runge-Kutta",
    .help = "Second order: springs implicit, gravity, wind and damping explicit, so that what is not stiff is not "
            "damped. No "
            "limit from the springs; strong wind has one.",
    .family = Family::implicit_method,
    .order = 2,
    .limit_formula = "none for springs",
    .limit = [](double) { return no_limit; },
    .cost = "twice some Newton iterations, each a force evaluation and a linear solve",
    .source = "U. M. Ascher, S. J. Ruuth, R. J. Spiteri, Applied Numerical Mathematics 25 (1997), section 2.6",
    .velocity = true,
    .arrays = 8,
    .options = uses_tolerance};

CLOTHLAB_DEFINE_INTEGRATOR(imex)

} // namespace clothlab::sim
