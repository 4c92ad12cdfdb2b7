// Position based dynamics: M. Mueller, B. Heidelberger, M. Hennix, J. Ratcliff, "Position based dynamics", Journal of
// Visual Communication and Image Representation 18 (2007). After a prediction without springs (algorithm 1, lines 5 to
// 7), each iteration goes through all springs in order and moves both ends until the spring has lost a share k' of its
// error: equations 10 and 11, with k' = 1 - (1 - k)^(1/n), so that n iterations leave 1 - k of the error of a single
// spring (section 3.3). Velocities are then the displacements (lines 12 to 15).
//
// ks is not in this: how stiff the cloth is depends on k, on the number of iterations and on dt.
#include <cmath>

#include "sim/integrators/displacement.h"
#include "sim/integrators/integrator.h"
#include "sim/integrators/spring_rows.h"
#include "sim/stage_timer.h"

namespace clothlab::sim {
namespace {

template <class Real>
struct Points {
    Real *x, *y, *z;
    const Real* free; ///< 1, or 0 for pinned points
};

/// Lessens the error of one spring after the other by a share of it.
template <std::size_t stride, bool same_rest, class Real>
void solve(Points<Real> points, SpringRow s, Real share, const Real* rest_lengths) {
    Real *ax = points.x + s.a, *ay = points.y + s.a, *az = points.z + s.a;
    Real *bx = points.x + s.b, *by = points.y + s.b, *bz = points.z + s.b;
    const Real *free_a = points.free + s.a, *free_b = points.free + s.b;
    const Real* rest = same_rest ? rest_lengths : rest_lengths + s.a;
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
    for (std::size_t n = 0; n < s.count; ++n) {
        const std::size_t i = n * stride;
        const Real dx = bx[i] - ax[i], dy = by[i] - ay[i], dz = bz[i] - az[i];
        const Real length = std::sqrt(dx * dx + dy * dy + dz * dz);
        // Without a length there is no direction, and no free end, no move. (Numbers, since compilers make branches of
        // other choices.)
        const Real has_length = length > 0 ? Real(1) : Real(0);
        const Real ends = free_a[i] + free_b[i], has_end = ends > 0 ? Real(1) : Real(0);
        const Real error = has_length * (length - rest[same_rest ? 0 : i]);
        const Real divisor = (ends + (Real(1) - has_end)) * (length + (Real(1) - has_length));
        const Real move = share * error / divisor;
        const Real move_a = free_a[i] * move, move_b = free_b[i] * move;
        ax[i] += move_a * dx;
        ay[i] += move_a * dy;
        az[i] += move_a * dz;
        bx[i] -= move_b * dx;
        by[i] -= move_b * dy;
        bz[i] -= move_b * dz;
    }
}

template <bool same_rest, class Real>
void sweep(const Model<Real>& model, Points<Real> points, const std::array<Real, stencil_size>& share) {
    for_each_spring_row(model, [&](SpringRow row, auto stride) {
        solve<stride(), same_rest>(points, row, share[row.s], model.grid->rest[row.s].data());
    });
}

} // namespace

template <class Real>
void pbd(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    Vec3Array<Real>& wind = work.arrays[0];
    {
        const StageTimer timer(work, Stage::forces);
        set_wind(model, state, work, wind);
    }
    const StageTimer timer(work, Stage::integrate);
    predict(model, explicit_prediction(model), wind, state);

    std::array<Real, stencil_size> share{}; // k'
    for (std::size_t s = 0; s < stencil_size; ++s) {
        const bool bending = spring_stencil[s].kind == SpringKind::bending;
        const double k = (bending ? bending_share : 1) * static_cast<double>(model.pbd_stiffness);
        share[s] = static_cast<Real>(1 - std::pow(1 - k, 1.0 / model.iterations));
    }
    AlignedVector<Real>& free = work.arrays[1].x;
    std::fill(free.begin(), free.end(), Real(1));
    for (const std::uint32_t pin : model.pins)
        free[pin] = 0;
    const Points<Real> points{state.position.x.data(), state.position.y.data(), state.position.z.data(), free.data()};
    for (int iteration = 0; iteration < model.iterations; ++iteration) {
        if (model.grid->rest_mask == 0)
            sweep<true>(model, points, share);
        else
            sweep<false>(model, points, share);
    }
    velocities_from_displacements(model, state);
    counts.solver_iterations = static_cast<std::size_t>(model.iterations);
}

const IntegratorTraits pbd_traits{
    .title = "Position based dynamics",
    .help =
        "Moves points until springs fit. Never blows up, and looks well, but does not simulate the springs: ks and the "
        "density do nothing, and the cloth grows stiffer with more iterations and with shorter steps.",
    .family = Family::position_based,
    .order = 0,
    .limit_formula = "none",
    .limit = [](double) { return no_limit; },
    .cost = "iterations sweeps over the springs",
    .source = "M. Mueller, B. Heidelberger, M. Hennix, J. Ratcliff, \"Position based dynamics\", Journal of Visual "
              "Communication and Image Representation 18 (2007), section 3",
    .velocity = true,
    .arrays = 2,
    .options = uses_iterations | uses_pbd_stiffness};

CLOTHLAB_DEFINE_INTEGRATOR(pbd)

} // namespace clothlab::sim
