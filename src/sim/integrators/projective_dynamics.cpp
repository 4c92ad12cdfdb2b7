// Projective dynamics: S. Bouaziz, S. Martin, T. Liu, L. Kavan, M. Pauly, "Projective dynamics: fusing constraint
// projections for fast simulation", SIGGRAPH 2014; for springs it is T. Liu, A. W. Bargteil, J. F. O'Brien, L. Kavan,
// "Fast simulation of mass-spring systems", SIGGRAPH Asia 2013. A step of backward Euler,
//     A (x - x_n) - m v_n / dt - F(x) = 0   with   A = m (1 + c dt) / dt²,
// c the physical rule's damping, is solved in turns: the local step gives each spring the vector of its rest length
// along its present direction, the global step finds the positions at which springs to those vectors are in balance, by
// a matrix A I + sum of k that stays the same. Both together are, in the terms of the unknown's change,
//     (A I + sum of k) dx = F(x) + m v_n / dt - A (x - x_n),
// since with the springs' vectors fixed the balance is linear and F is its exact force at x (T. Liu, S. Bouaziz, L.
// Kavan, "Quasi-Newton methods for real-time simulation of hyperelastic materials", ACM TOG 36 (2017)). So the forces
// come from the kernels, and what rounding takes from an iteration the next one sees.
//
// Iterations begin at x_n + what the step is without springs. Gravity is in F; the wind stands still at the start of
// the step.
#include <limits>

#include "sim/integrators/displacement.h"
#include "sim/integrators/global_step.h"
#include "sim/integrators/integrator.h"
#include "sim/stage_timer.h"

namespace clothlab::sim {

template <class Real>
void projective_dynamics(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    const double mass = static_cast<double>(model.mass);
    const double a = mass * (1 + model.damping_rate * model.dt) / (model.dt * model.dt);
    GlobalStep& global = GlobalStep::of(model, a, work);

    Vec3Array<Real>&constant = work.arrays[0], &force = work.arrays[1];
    set_wind(model, state, work, constant);
    predict(model, implicit_prediction(model), constant, state);
    combine(constant, constant, Term<Real>{static_cast<Real>(mass / model.dt), &state.velocity});

    if (!global.usable()) { // there is no solution: not finite, so that the run is reported as diverged at once
        for (Real* axis : state.position.axes())
            std::fill(axis, axis + state.position.size(), std::numeric_limits<Real>::quiet_NaN());
        velocities_from_displacements(model, state);
        return;
    }
    for (int iteration = 0; iteration < model.iterations; ++iteration) {
        {
            const StageTimer timer(work, Stage::forces);
            evaluate_conservative_forces(model, state.position, work, force);
        }
        const StageTimer timer(work, Stage::integrate);
        const auto x = state.position.axes();
        const std::array<const Real*, 3> p{state.previous.x.data(), state.previous.y.data(), state.previous.z.data()};
        const auto f = force.axes(), c = constant.axes();
        const std::size_t points = state.position.size();
        for (std::size_t i = 0; i < points; ++i)
            for (std::size_t axis = 0; axis < 3; ++axis)
                global[i][axis] = static_cast<double>(f[axis][i]) + static_cast<double>(c[axis][i]) -
                                  a * (static_cast<double>(x[axis][i]) - static_cast<double>(p[axis][i]));
        global.solve();
        for (std::size_t i = 0; i < points; ++i)
            if (!model.pinned[i])
                for (std::size_t axis = 0; axis < 3; ++axis)
                    x[axis][i] = static_cast<Real>(static_cast<double>(x[axis][i]) + global[i][axis]);
    }
    velocities_from_displacements(model, state);
    counts.force_evaluations = counts.solver_iterations = static_cast<std::size_t>(model.iterations);
}

const IntegratorTraits projective_dynamics_traits{
    .title = "Projective dynamics",
    .help =
        "Backward Euler by a matrix that is factorised once: the first iterations bring most, later ones little, the "
        "less the stiffer. Every change of ks, step, mass or pins factorises anew: at 512 x 512 points that takes 8 s "
        "and 0.4 GB.",
    .family = Family::implicit_method,
    .order = 1,
    .limit_formula = "none",
    .limit = [](double) { return no_limit; },
    .cost = "per iteration 1 force evaluation and 1 solve with a factor",
    .source = "S. Bouaziz, S. Martin, T. Liu, L. Kavan, M. Pauly, \"Projective dynamics\", SIGGRAPH 2014; for springs "
              "T. Liu, A. "
              "W. Bargteil, J. F. O'Brien, L. Kavan, SIGGRAPH Asia 2013",
    .velocity = true,
    .arrays = 2,
    .options = uses_iterations};

CLOTHLAB_DEFINE_INTEGRATOR(projective_dynamics)

} // namespace clothlab::sim
