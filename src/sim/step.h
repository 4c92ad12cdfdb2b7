// One substep: the stages, called in visible order.
#pragma once

#include "sim/model.h"
#include "sim/state.h"
#include "sim/workspace.h"

namespace clothlab::sim {

/// What a step's contact stages did.
struct StepCounts {
    std::size_t self_contacts = 0; ///< pairs pushed apart, counted from both sides
    std::size_t contacts = 0;      ///< points put out of a collider: of a sphere and of a plane
    std::size_t sphere_contacts = 0, plane_contacts = 0;
    std::size_t shortened_springs = 0; ///< springs that the stretch limit shortened
    std::size_t force_evaluations = 0; ///< of all points' forces
    std::size_t solver_iterations = 0; ///< of the method's linear solver, or its sweeps over springs or points

    StepCounts& operator+=(const StepCounts& other);
};

/// A state of masses at rest at the start positions, as the course's start has it.
template <class Real>
State<Real> initial_state(const Description& description);

/// Makes such a state the start of the model's method, by the model's rule for it.
template <class Real>
void begin(const Model<Real>& model, State<Real>& state, Workspace<Real>& work);

/// Scratch memory, kernels and threads for steps of the model.
template <class Real>
Workspace<Real> make_workspace(const Model<Real>& model, const Execution& execution = {});

template <class Real>
class StepRecorder;

/// Advances the state by model.dt. A recorder is shown the state between the stages.
template <class Real>
StepCounts step(const Model<Real>& model, State<Real>& state, Workspace<Real>& work,
                StepRecorder<Real>* recorder = nullptr);

#define CLOTHLAB_DECLARE(Real)                                                                                         \
    extern template State<Real> initial_state<Real>(const Description&);                                               \
    extern template void begin<Real>(const Model<Real>&, State<Real>&, Workspace<Real>&);                              \
    extern template Workspace<Real> make_workspace<Real>(const Model<Real>&, const Execution&);                        \
    extern template StepCounts step<Real>(const Model<Real>&, State<Real>&, Workspace<Real>&, StepRecorder<Real>*);
CLOTHLAB_DECLARE(float)
CLOTHLAB_DECLARE(double)
#undef CLOTHLAB_DECLARE

} // namespace clothlab::sim
