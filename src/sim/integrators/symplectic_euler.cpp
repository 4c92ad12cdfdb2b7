// Symplectic Euler: v' = v + dt a(x), x' = x + dt v'. E. Hairer, C. Lubich, G. Wanner, "Geometric numerical integration
// illustrated by the Stoermer-Verlet method", Acta Numerica 12 (2003), section 1.2. Positions are those of Verlet from
// another start, so its limit is Verlet's too.
#include <algorithm>
#include <cmath>

#include "sim/forces/forces.h"
#include "sim/integrators/combine.h"
#include "sim/integrators/integrator.h"
#include "sim/stage_timer.h"

namespace clothlab::sim {

template <class Real>
void symplectic_euler(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    const Real dt = static_cast<Real>(model.dt);
    Vec3Array<Real>& a = work.arrays[0];
    undamped_accelerations(model, state.position, state.velocity, state.time, work, a);
    counts.force_evaluations = 1;
    const StageTimer timer(work, Stage::integrate);
    state.previous = state.position;
    scale(state.velocity, model.keep);
    combine(state.velocity, state.velocity, Term<Real>{model.force_share * dt, &a});
    combine(state.position, state.position, Term<Real>{dt, &state.velocity});
}

const IntegratorTraits symplectic_euler_traits{
    .title = "Symplectic Euler",
    .help =
        "Explicit Euler with the new velocity in the position's update: as cheap, and stable where Verlet is. Energy "
        "swings but does not drift.",
    .family = Family::explicit_method,
    .order = 1,
    .limit_formula = "2 sqrt(1 - d/2)",
    .limit = [](double d) { return 2 * std::sqrt(std::max(0.0, 1 - d / 2)); },
    .cost = "1 force evaluation",
    .source = "E. Hairer, C. Lubich, G. Wanner, Acta Numerica 12 (2003), section 1.2",
    .velocity = true,
    .arrays = 1,
    .exact_damping = true};

CLOTHLAB_DEFINE_INTEGRATOR(symplectic_euler)

} // namespace clothlab::sim
