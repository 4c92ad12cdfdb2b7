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
#include "sim/stage_timer.h"

namespace clothlab::sim {

template <class Real>
void pbd(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    Vec3Array<Real>& wind = work.arrays[0];
    {
        const StageTimer timer(work, Stage::forces);
        set_wind(model, state, work, wind);
    }
    const StageTimer timer(work, Stage::integrate);
    predict(model, explicit_prediction(model), wind, state);

    const Grid<Real>& grid = *model.grid;
    std::array<Real, stencil_size> share{}; // k'
    for (std::size_t s = 0; s < stencil_size; ++s) {
        const bool bending = spring_stencil[s].kind == SpringKind::bending;
        const double k = (bending ? bending_share : 1) * static_cast<double>(model.pbd_stiffness);
        share[s] = static_cast<Real>(1 - std::pow(1 - k, 1.0 / model.iterations));
    }
    Real *x = state.position.x.data(), *y = state.position.y.data(), *z = state.position.z.data();
    const std::uint8_t* pinned = model.pinned.data();
    for (int iteration = 0; iteration < model.iterations; ++iteration)
        for_each_spring(grid.columns, grid.rows, [&](std::uint32_t a, std::uint32_t b, std::size_t s) {
            const int free = 2 - pinned[a] - pinned[b];
            if (!model.pulls(s) || free == 0)
                return;
            const Real dx = x[b] - x[a], dy = y[b] - y[a], dz = z[b] - z[a];
            const Real length = std::sqrt(dx * dx + dy * dy + dz * dz);
            if (!(length > 0)) // no direction
                return;
            const Real move = share[s] * (length - grid.rest_length(s, a)) / (static_cast<Real>(free) * length);
            if (!pinned[a]) {
                x[a] += move * dx;
                y[a] += move * dy;
                z[a] += move * dz;
            }
            if (!pinned[b]) {
                x[b] -= move * dx;
                y[b] -= move * dy;
                z[b] -= move * dz;
            }
        });
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
    .cost = "iterations sweeps over the springs, one after the other",
    .source = "M. Mueller, B. Heidelberger, M. Hennix, J. Ratcliff, \"Position based dynamics\", Journal of Visual "
              "Communication and Image Representation 18 (2007), section 3",
    .velocity = true,
    .arrays = 1,
    .options = uses_iterations | uses_pbd_stiffness};

CLOTHLAB_DEFINE_INTEGRATOR(pbd)

} // namespace clothlab::sim
