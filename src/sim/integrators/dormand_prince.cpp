// Dormand-Prince 5(4) with step control: J. R. Dormand, P. J. Prince, "A family of embedded Runge-Kutta formulae",
// Journal of Computational and Applied Mathematics 6 (1980), table 2; the control is that of E. Hairer, S. P. Norsett,
// G. Wanner, "Solving Ordinary Differential Equations I", section II.4. A step of the simulation is divided into as
// many of its own as the tolerance asks for. A deviation: the error is the largest of any coordinate, not a mean, so
// that one point in trouble counts; and a step of a thousandth of dt is taken whatever its error, so that a run that
// blows up goes on.
#include <algorithm>
#include <cmath>

#include "sim/forces/forces.h"
#include "sim/integrators/combine.h"
#include "sim/integrators/integrator.h"
#include "sim/integrators/runge_kutta_limit.h"
#include "sim/stage_timer.h"

namespace clothlab::sim {
namespace {

constexpr int stages = 7;
constexpr double c[stages] = {0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1};
constexpr double a[stages][stages - 1] = {{},
                                          {1.0 / 5},
                                          {3.0 / 40, 9.0 / 40},
                                          {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                          {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                          {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                                          {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
/// Weights of the fifth less those of the fourth order solution.
constexpr double e[stages] = {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

/// x + h times the first `count` of the stages, weighted.
template <class Real>
void weighted(Vec3Array<Real>& out, const Vec3Array<Real>& x, double h, const double* weights, int count,
              const Vec3Array<Real>* stage) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Real* o = out.axes()[axis];
        const Real* from = x.axes()[axis];
        std::copy(from, from + x.size(), o);
        for (int s = 0; s < count; ++s) {
            const Real factor = static_cast<Real>(h * weights[s]);
            if (factor == 0)
                continue;
            const Real* k = stage[s].axes()[axis];
            for (std::size_t i = 0; i < x.size(); ++i)
                o[i] += factor * k[i];
        }
    }
}

/// The largest coordinate of the error estimate.
template <class Real>
double error(double h, const Vec3Array<Real>* stage) {
    double largest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < stage[0].size(); ++i) {
            double sum = 0;
            for (int s = 0; s < stages; ++s)
                sum += e[s] * static_cast<double>(stage[s].axes()[axis][i]);
            const double size = std::abs(h * sum);
            if (!(size <= largest)) // also where it is not a number
                largest = size;
        }
    return largest;
}

} // namespace

template <class Real>
void dormand_prince(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    Vec3Array<Real>*slope_v = work.arrays.data(), *slope_x = slope_v + stages, &x_next = slope_x[stages],
    &v_next = slope_x[stages + 1];
    // In m, and for velocities in m per step.
    const double allowed = model.tolerance * static_cast<double>(model.grid->shortest);
    const double dt = model.dt, least = 1e-3 * dt;
    state.previous = state.position;
    Vec3Array<Real>&x = state.position, &v = state.velocity;
    double done = 0, h = state.solver_step > 0 && model.tolerance > 0 ? state.solver_step : dt;
    accelerations(model, x, &v, state.time, work, slope_v[0]);
    counts.force_evaluations = 1;
    while (done < dt) {
        const double rest = dt - done;
        // Two halves rather than a long step and a tiny one.
        const double step = h >= rest ? rest : h > 0.5 * rest ? 0.5 * rest : h;
        slope_x[0] = v;
        for (int s = 1; s < stages; ++s) {
            weighted(x_next, x, step, a[s], s, slope_x);
            weighted(slope_x[s], v, step, a[s], s, slope_v);
            accelerations(model, x_next, &slope_x[s], state.time + done + c[s] * step, work, slope_v[s]);
        }
        counts.force_evaluations += stages - 1;
        // The last stage is the fifth order solution itself.
        const double size = model.tolerance > 0 ? std::max(error(step, slope_x), step * error(step, slope_v)) : 0;
        const double ratio = model.tolerance > 0 ? size / allowed : 0;
        const bool accepted = ratio <= 1 || step <= least || !std::isfinite(ratio);
        const double wanted = std::isfinite(ratio) ? 0.9 * std::pow(std::max(ratio, 1e-10), -0.2) : 1;
        const StageTimer timer(work, Stage::integrate);
        if (accepted) {
            v_next = slope_x[stages - 1];
            std::swap(x, x_next);
            std::swap(v, v_next);
            std::swap(slope_v[0], slope_v[stages - 1]);
            done = step == rest ? dt : done + step;
        }
        if (step == h || !accepted || wanted < 1) // a step cut short says nothing against longer ones
            h = std::max(step * std::clamp(wanted, 0.2, 5.0), least);
    }
    state.solver_step = h;
    scale(v, model.course_keep);
}

const IntegratorTraits dormand_prince_traits{
    .title = "Dormand-Prince 5(4)",
    .help = "Fifth order with step control: divides a step until its own estimate of the error is within the tolerance "
            "(0: one step, no control). For reference solutions.",
    .family = Family::explicit_method,
    .order = 5,
    .limit_formula = "0.997 undamped, for one step; the control divides it where needed",
    .limit =
        [](double d) {
            return runge_kutta_limit(
                [](double y) { return 1 - y * y / 2 + std::pow(y, 4) / 24 - std::pow(y, 6) / 600; },
                [](double y) { return y - y * y * y / 6 + std::pow(y, 5) / 120; }, d);
        },
    .cost = "6 force evaluations a step of its own, and one more",
    .source = "J. R. Dormand, P. J. Prince, Journal of Computational and Applied Mathematics 6 (1980), table 2",
    .velocity = true,
    .arrays = 2 * stages + 2,
    .options = uses_tolerance,
    .divides_steps = true};

CLOTHLAB_DEFINE_INTEGRATOR(dormand_prince)

} // namespace clothlab::sim
