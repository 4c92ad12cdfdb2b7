// The one signature of all methods, and the list of them. A method moves the masses by one time step under the forces;
// contacts and the stretch limit follow it in step().
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "sim/model.h"
#include "sim/state.h"
#include "sim/step.h"
#include "sim/workspace.h"

namespace clothlab::sim {

enum class Family : std::uint8_t { explicit_method, implicit_method, position_based };
inline constexpr std::array<std::string_view, 3> family_names{"explicit", "implicit", "position-based"};

/// Parameters of a method besides the step, as bits.
enum MethodOption : unsigned {
    no_options = 0,
    uses_iterations = 1,
    uses_tolerance = 2,
    uses_pbd_stiffness = 4,
    uses_spring_damping = 8,
    uses_acceleration = 16,
    uses_first_guess = 32
};

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

/// What is known of a method before it is run.
struct IntegratorTraits {
    std::string_view title; ///< as people read it
    std::string_view help;  ///< a sentence or two: what it is good for, and what not
    Family family;
    int order; ///< of the error of positions at a fixed time, as a power of dt; 0: it does not converge to the springs'
               ///< motion
    /// The largest y = omega dt at which an oscillator does not grow that loses the share d of its motion in each step,
    /// and is not damped otherwise: as a formula and as a number. Without damping it is 0 for methods that always grow;
    /// it is no_limit for those that never do.
    std::string_view limit_formula;
    double (*limit)(double d);
    std::string_view cost;   ///< of a step
    std::string_view source; ///< the paper, and where in it
    // What its states hold and its steps need.
    bool velocity;        ///< State::velocity; false: velocities are position - previous
    bool history = false; ///< State::previous_velocity
    int arrays = 0;       ///< Workspace::arrays
    unsigned options = no_options;
    /// The physical rule's damping is Model::keep and force_share, not a force: limit is given its share.
    bool exact_damping = false;
    /// With a tolerance above 0 it divides a step where it must: its limit is then that of its own steps, not of dt.
    bool divides_steps = false;
};

struct IntegratorInfo : IntegratorTraits {
    IntegratorId id;
    std::string_view name; ///< as scenes and the command line write it
};

#define CLOTHLAB_INTEGRATOR(id, name)                                                                                  \
    extern const IntegratorTraits id##_traits;                                                                         \
    template <class Real>                                                                                              \
    void id(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts);                  \
    extern template void id<float>(const Model<float>&, State<float>&, Workspace<float>&, StepCounts&);                \
    extern template void id<double>(const Model<double>&, State<double>&, Workspace<double>&, StepCounts&);
#include "sim/integrators/integrators.def"
#undef CLOTHLAB_INTEGRATOR

/// To be written at the end of a method's file.
#define CLOTHLAB_DEFINE_INTEGRATOR(id)                                                                                 \
    template void id<float>(const Model<float>&, State<float>&, Workspace<float>&, StepCounts&);                       \
    template void id<double>(const Model<double>&, State<double>&, Workspace<double>&, StepCounts&);

/// All methods, in the order of IntegratorId.
std::span<const IntegratorInfo> integrators();

inline const IntegratorTraits& traits(IntegratorId id) {
    switch (id) {
#define CLOTHLAB_INTEGRATOR(id, name)                                                                                  \
    case IntegratorId::id:                                                                                             \
        return id##_traits;
#include "sim/integrators/integrators.def"
#undef CLOTHLAB_INTEGRATOR
    }
    return course_verlet_traits;
}

/// Whether states of a model have State::previous_velocity.
template <class Real>
bool keeps_history(const Model<Real>& model) {
    const IntegratorTraits& method = traits(model.integrator);
    return method.history || ((method.options & uses_first_guess) != 0 && model.first_guess == FirstGuess::adaptive);
}

/// Moves the masses by one time step with the model's method: positions, previous positions and velocities.
template <class Real>
void integrate(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    switch (model.integrator) {
#define CLOTHLAB_INTEGRATOR(id, name)                                                                                  \
    case IntegratorId::id:                                                                                             \
        return id(model, state, work, counts);
#include "sim/integrators/integrators.def"
#undef CLOTHLAB_INTEGRATOR
    }
}

/// Makes a state one of the model's method: with velocities or without. Positions and velocities stay what they are, to
/// second order in `dt`, the length in s of the step that the state comes from:
/// v = (x - p) / dt + a dt / 2, and p = x - v dt + a dt² / 2.
template <class Real>
void adopt(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, double dt);

extern template void adopt<float>(const Model<float>&, State<float>&, Workspace<float>&, double);
extern template void adopt<double>(const Model<double>&, State<double>&, Workspace<double>&, double);

} // namespace clothlab::sim
