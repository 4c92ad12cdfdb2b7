#include "sim/step.h"

#include <stdexcept>

#include "sim/collision/colliders.h"
#include "sim/collision/self_collision.h"
#include "sim/forces/forces.h"
#include "sim/integrators/combine.h"
#include "sim/integrators/integrator.h"
#include "sim/iterated_limit.h"
#include "sim/stage_timer.h"
#include "sim/step_recorder.h"
#include "sim/stretch_limit.h"

namespace clothlab::sim {

StepCounts& StepCounts::operator+=(const StepCounts& other) {
    self_contacts += other.self_contacts;
    contacts += other.contacts;
    sphere_contacts += other.sphere_contacts;
    plane_contacts += other.plane_contacts;
    shortened_springs += other.shortened_springs;
    force_evaluations += other.force_evaluations;
    solver_iterations += other.solver_iterations;
    return *this;
}

template <class Real>
State<Real> initial_state(const Description& description) {
    State<Real> state;
    state.position = start_positions<Real>(description);
    state.previous = state.position;
    return state;
}

template <class Real>
void begin(const Model<Real>& model, State<Real>& state, Workspace<Real>& work) {
    if (model.rules.start == StartRule::physical && !traits(model.integrator).velocity) {
        // x(-dt) of a cloth at rest: L. Verlet's scheme is of second order only from there.
        accelerations(model, state.position, nullptr, state.time, work, work.force);
        combine(state.previous, state.position, Term<Real>{static_cast<Real>(0.5 * model.dt * model.dt), &work.force});
    }
    adopt(model, state, work, model.dt);
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

namespace {

/// Whether a stage after the method's can move points.
template <class Real>
bool has_stage(const Model<Real>& model, Stage stage) {
    switch (stage) {
    case Stage::self_collision:
        return model.rules.self_collision != SelfCollisionRule::none && model.thickness > 0;
    case Stage::colliders:
        return !model.colliders.empty();
    case Stage::limit:
        return model.rules.limit != LimitRule::off;
    default:
        return false;
    }
}

/// Whether anything but the method can move points in a step.
template <class Real>
bool has_stages(const Model<Real>& model) {
    return has_stage(model, Stage::self_collision) || has_stage(model, Stage::colliders) ||
           has_stage(model, Stage::limit);
}

/// Gives velocities what the stages did to positions since `from`, as M. Mueller et al. do it ("Position based
/// dynamics", 2007, section 3); it is what Verlet, whose velocities are differences of positions, does by itself.
template <class Real>
void add_displacements(const Model<Real>& model, State<Real>& state, const Vec3Array<Real>& from) {
    const Real dt = static_cast<Real>(model.dt);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Real *x = state.position.axes()[axis], *before = from.axes()[axis];
        Real* v = state.velocity.axes()[axis];
        for (std::size_t i = 0; i < state.position.size(); ++i)
            v[i] += (x[i] - before[i]) / dt;
    }
}

} // namespace

template <class Real>
StepCounts step(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepRecorder<Real>* recorder) {
    StepCounts counts;
    if (recorder)
        recorder->begin(model, state, work);
    work.choice.begin_step();
    integrate(model, state, work, counts);
    const bool keep_velocity = state.velocity.size() != 0 && has_stages(model);
    if (keep_velocity)
        work.before_stages = state.position;
    const auto record = [&](Stage stage) {
        if (!recorder)
            return;
        State<Real> ended = state;
        if (keep_velocity)
            add_displacements(model, ended, work.before_stages);
        recorder->after(stage, stage == Stage::integrate || has_stage(model, stage), model, ended);
    };
    record(Stage::integrate);
    if (model.rules.self_collision != SelfCollisionRule::none) {
        const StageTimer timer(work, Stage::self_collision);
        counts.self_contacts = resolve_self_collision(model, state, work);
    }
    record(Stage::self_collision);
    if (!model.colliders.empty()) {
        const StageTimer timer(work, Stage::colliders);
        const ColliderContacts contacts = resolve_colliders(model, state, work);
        counts.contacts = contacts.all();
        counts.sphere_contacts = contacts.spheres;
        counts.plane_contacts = contacts.planes;
    }
    record(Stage::colliders);
    if (model.rules.limit != LimitRule::off) {
        const StageTimer timer(work, Stage::limit);
        counts.shortened_springs = model.rules.limit == LimitRule::iterated ? limit_stretch_iterated(model, state)
                                                                            : limit_stretch(model, state, work);
    }
    record(Stage::limit);
    const bool moved = counts.self_contacts + counts.contacts + counts.shortened_springs != 0;
    if (moved)
        work.force_of_step = 0;
    if (keep_velocity && moved)
        add_displacements(model, state, work.before_stages);
    work.choice.end_step();
    state.time += model.dt;
    state.steps += 1;
    if (recorder)
        recorder->end(counts);
    return counts;
}

#define CLOTHLAB_DEFINE(Real)                                                                                          \
    template State<Real> initial_state<Real>(const Description&);                                                      \
    template void begin<Real>(const Model<Real>&, State<Real>&, Workspace<Real>&);                                     \
    template Workspace<Real> make_workspace<Real>(const Model<Real>&, const Execution&);                               \
    template StepCounts step<Real>(const Model<Real>&, State<Real>&, Workspace<Real>&, StepRecorder<Real>*);
CLOTHLAB_DEFINE(float)
CLOTHLAB_DEFINE(double)
#undef CLOTHLAB_DEFINE

} // namespace clothlab::sim
