#include "sim/step.h"

#include <bit>

#include "sim/collision/colliders.h"
#include "sim/collision/self_collision.h"
#include "sim/integrators/integrator.h"
#include "sim/stage_timer.h"
#include "sim/stretch_limit.h"

namespace clothlab::sim {

template <class Real>
State<Real> initial_state(const Model<Real>& model) {
    State<Real> state;
    state.position = model.grid->start;
    state.previous = model.grid->start;
    return state;
}

template <class Real>
Workspace<Real> make_workspace(const Model<Real>& model) {
    const std::size_t points = model.grid->points();
    Workspace<Real> work;
    work.force.resize(points);
    work.cell.resize(points);
    work.cells.first.resize(std::bit_ceil(points));
    work.cells.next.resize(points);
    return work;
}

template <class Real>
StepCounts step(const Model<Real>& model, State<Real>& state, Workspace<Real>& work) {
    StepCounts counts;
    integrate(model, state, work);
    if (model.rules.self_collision == SelfCollisionRule::cs184) {
        const StageTimer timer(work, Stage::self_collision);
        counts.self_contacts = resolve_self_collision(model, state, work);
    }
    if (!model.colliders.empty()) {
        const StageTimer timer(work, Stage::colliders);
        counts.contacts = resolve_colliders(model, state);
    }
    if (model.rules.limit == LimitRule::cs184) {
        const StageTimer timer(work, Stage::limit);
        counts.shortened_springs = limit_stretch(model, state);
    }
    state.time += model.dt;
    state.steps += 1;
    return counts;
}

#define CLOTHLAB_DEFINE(Real)                                                                                          \
    template State<Real> initial_state<Real>(const Model<Real>&);                                                      \
    template Workspace<Real> make_workspace<Real>(const Model<Real>&);                                                 \
    template StepCounts step<Real>(const Model<Real>&, State<Real>&, Workspace<Real>&);
CLOTHLAB_DEFINE(float)
CLOTHLAB_DEFINE(double)
#undef CLOTHLAB_DEFINE

} // namespace clothlab::sim
