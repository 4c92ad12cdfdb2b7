// Position based dynamics with compliance: M. Macklin, M. Mueller, N. Chentanez, "XPBD: position-based simulation of
// compliant constrained dynamics", Motion in Games 2016. Each spring has the constraint C = |b - a| - rest, the
// compliance 1/k and a multiplier lambda, zero at the start of each step, which an iteration changes by (equation 18)
//     dlambda = -(C + alpha lambda) / (w_a + w_b + alpha),   alpha = 1 / (k dt²),   w inverse masses,
// and with it the ends by w dlambda grad C (equation 17). One spring that does not turn is solved at once, and its step
// is that of backward Euler. With many iterations every spring has the force -lambda / dt² that backward Euler gives
// it, but each part of it acts along the direction that the spring had when that part was found, so that where springs
// turn, the sum is backward Euler's only up to a share that falls with dt². (It is the residual g of the paper's
// equation 8, which is taken to be zero.) With one iteration and more substeps it is the method of M. Macklin et al.,
// "Small steps in physics simulation", Symposium on Computer Animation 2019.
// With a damping beta in N s/m of the springs' lengths it is (equation 26)
//     dlambda = -(C + alpha lambda + g grad C (x - x_n)) / ((1 + g) (w_a + w_b) + alpha),   g = beta / (k dt)
//
// Everything is multiplied by k dt², so that k = 0 divides by nothing.
#include <array>
#include <cmath>
#include <utility>

#include "sim/integrators/displacement.h"
#include "sim/integrators/integrator.h"
#include "sim/integrators/spring_rows.h"
#include "sim/stage_timer.h"

namespace clothlab::sim {
namespace {

template <class Real>
struct Points {
    Real *x, *y, *z;
    const Real* w;                     ///< inverse masses, 1/kg
    std::array<const Real*, 3> before; ///< a step earlier
};

/// A kind of springs.
template <class Real>
struct Kind {
    Real stiffness;           ///< k dt², kg
    Real damping;             ///< beta dt, kg
    const Real* rest_lengths; ///< m, by the owner of the spring, or one for all
    Real* multipliers;        ///< by owner
};

/// One spring after the other.
template <std::size_t stride, bool same_rest, bool damped, class Real>
void solve(Points<Real> points, SpringRow s, Kind<Real> kind) {
    const Real stiffness = kind.stiffness, damping = damped ? kind.damping : Real(0);
    Real *ax = points.x + s.a, *ay = points.y + s.a, *az = points.z + s.a;
    Real *bx = points.x + s.b, *by = points.y + s.b, *bz = points.z + s.b;
    const Real *wa = points.w + s.a, *wb = points.w + s.b,
               *rest = same_rest ? kind.rest_lengths : kind.rest_lengths + s.a;
    Real* lambda = kind.multipliers + s.a;
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
    for (std::size_t n = 0; n < s.count; ++n) {
        const std::size_t i = n * stride;
        const Real dx = bx[i] - ax[i], dy = by[i] - ay[i], dz = bz[i] - az[i];
        const Real length = std::sqrt(dx * dx + dy * dy + dz * dz);
        Real error = stiffness * (length - rest[same_rest ? 0 : i]) + lambda[i];
        // Without a length there is no direction, and no force. (Numbers, since compilers make branches of other
        // choices.)
        const Real has_length = length > 0 ? Real(1) : Real(0);
        if constexpr (damped) {
            const auto& [x, y, z] = points.before;
            const std::size_t a = s.a + i, b = s.b + i;
            const Real along = dx * (dx - (x[b] - x[a])) + dy * (dy - (y[b] - y[a])) + dz * (dz - (z[b] - z[a]));
            error += damping * along / (length + (Real(1) - has_length));
        }
        const Real dlambda = has_length * -error / (Real(1) + (stiffness + damping) * (wa[i] + wb[i]));
        const Real move = dlambda / (length + (Real(1) - has_length));
        lambda[i] += dlambda;
        const Real move_a = wa[i] * move, move_b = wb[i] * move;
        ax[i] -= move_a * dx;
        ay[i] -= move_a * dy;
        az[i] -= move_a * dz;
        bx[i] += move_b * dx;
        by[i] += move_b * dy;
        bz[i] += move_b * dz;
    }
}

template <bool same_rest, bool damped, class Real>
void sweep(const Model<Real>& model, Points<Real> points, const std::array<Real*, stencil_size>& lambda) {
    // Under the physical rule a force of the step, a spring's as much as gravity's, moves a point by that share of dt².
    const Real dt = static_cast<Real>(model.dt), damping_dt = model.force_share * dt, dt2 = model.force_share * dt * dt;
    for_each_spring_row(model, [&](SpringRow row, auto stride) {
        const bool bending = spring_stencil[row.s].kind == SpringKind::bending;
        const Real share = bending ? static_cast<Real>(bending_share) : Real(1);
        const Kind<Real> kind{model.spring_constant(row.s) * dt2, share * model.spring_damping * damping_dt,
                              model.grid->rest[row.s].data(), lambda[row.s]};
        solve<stride(), same_rest, damped>(points, row, kind);
    });
}

} // namespace

template <class Real>
void xpbd(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    Vec3Array<Real>&first = work.arrays[0], &second = work.arrays[1], &wind = first;
    {
        const StageTimer timer(work, Stage::forces);
        set_wind(model, state, work, wind);
    }
    const StageTimer timer(work, Stage::integrate);
    predict(model, explicit_prediction(model), wind, state);

    const std::array<Real*, stencil_size> lambda{first.x.data(),  first.y.data(),  first.z.data(),
                                                 second.x.data(), second.y.data(), second.z.data()};
    for (Real* multipliers : lambda)
        std::fill(multipliers, multipliers + state.position.size(), Real(0));
    AlignedVector<Real>& inverse_mass = work.arrays[2].x;
    std::fill(inverse_mass.begin(), inverse_mass.end(), Real(1) / model.mass);
    for (const std::uint32_t pin : model.pins)
        inverse_mass[pin] = 0;

    const Points<Real> points{state.position.x.data(), state.position.y.data(), state.position.z.data(),
                              inverse_mass.data(), std::as_const(state.previous).axes()};
    const bool same_rest = model.grid->rest_mask == 0, damped = model.spring_damping > 0;
    const auto sweep_all = same_rest ? (damped ? sweep<true, true, Real> : sweep<true, false, Real>)
                                     : (damped ? sweep<false, true, Real> : sweep<false, false, Real>);
    for (int iteration = 0; iteration < model.iterations; ++iteration)
        sweep_all(model, points, lambda);
    velocities_from_displacements(model, state);
    counts.solver_iterations = static_cast<std::size_t>(model.iterations);
}

const IntegratorTraits xpbd_traits{
    .title = "XPBD",
    .help =
        "Position based dynamics with the springs' own stiffness: never blows up, and is nearly backward Euler as far "
        "as its iterations reach; too few leave stiff cloth too soft. Small steps: 1 iteration and more substeps.",
    .family = Family::position_based,
    .order = 1,
    .limit_formula = "none",
    .limit = [](double) { return no_limit; },
    .cost = "iterations sweeps over the springs",
    .source = "M. Macklin, M. Mueller, N. Chentanez, \"XPBD\", Motion in Games 2016, equations 17, 18 and 26; small "
              "steps: M. "
              "Macklin et al., Symposium on Computer Animation 2019",
    .velocity = true,
    .arrays = 3,
    .options = uses_iterations | uses_spring_damping};

CLOTHLAB_DEFINE_INTEGRATOR(xpbd)

} // namespace clothlab::sim
