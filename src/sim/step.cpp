#include "sim/step.h"

#include <stdexcept>

#include "sim/collision/colliders.h"
#include "sim/collision/self_collision.h"
#include "sim/integrators/integrator.h"
#include "sim/stage_timer.h"
#include "sim/stretch_limit.h"

namespace clothlab::sim {

template <class Real>
State<Real> initial_state(const Description& description) {
    State<Real> state;
    state.position = start_positions<Real>(description);
    state.previous = state.position;
    return state;
}

template <class Real>
Workspace<Real> make_workspace(const Model<Real>& model, const Execution& execution) {
    if (!is_supported(execution.instructions))
        throw std::invalid_argument("this machine or build has no such instruction set");
    if (execution.threads < 1 || execution.threads > 1024)
        throw std::invalid_argument("a run needs 1 to 1024 threads");
    Workspace<Real> work;
    work.instructions = resolve(execution.instructions);
    work.kernels = kernels<Real>(work.instructions);
    if (execution.threads > 1 && work.kernels)
        work.pool = std::make_unique<ThreadPool>(execution.threads);
    work.choice = ThreadChoice(work.pool ? work.pool->threads() : 1, execution.fewer_if_faster);
    prepare(model, work);
    return work;
}

template <class Real>
StepCounts step(const Model<Real>& model, State<Real>& state, Workspace<Real>& work) {
    StepCounts counts;
    work.choice.begin_step();
    integrate(model, state, work);
    if (model.rules.self_collision == SelfCollisionRule::cs184) {
        const StageTimer timer(work, Stage::self_collision);
        counts.self_contacts = resolve_self_collision(model, state, work);
    }
    if (!model.colliders.empty()) {
        const StageTimer timer(work, Stage::colliders);
        counts.contacts = resolve_colliders(model, state, work);
    }
    if (model.rules.limit == LimitRule::cs184) {
        const StageTimer timer(work, Stage::limit);
        counts.shortened_springs = limit_stretch(model, state, work);
    }
    work.choice.end_step();
    state.time += model.dt;
    state.steps += 1;
    return counts;
}

#define CLOTHLAB_DEFINE(Real)                                                                                          \
    template State<Real> initial_state<Real>(const Description&);                                                      \
    template Workspace<Real> make_workspace<Real>(const Model<Real>&, const Execution&);                               \
    template StepCounts step<Real>(const Model<Real>&, State<Real>&, Workspace<Real>&);
CLOTHLAB_DEFINE(float)
CLOTHLAB_DEFINE(double)
#undef CLOTHLAB_DEFINE

} // namespace clothlab::sim
