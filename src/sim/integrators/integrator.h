// The one signature of all methods, and the list of them. A method moves the masses by one time step under the forces;
// contacts and the stretch limit follow it in step().
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "sim/model.h"
#include "sim/state.h"
#include "sim/workspace.h"

namespace clothlab::sim {

#define CLOTHLAB_INTEGRATOR(id, name, title, help)                                                                     \
    template <class Real>                                                                                              \
    void id(const Model<Real>& model, State<Real>& state, Workspace<Real>& work);                                      \
    extern template void id<float>(const Model<float>&, State<float>&, Workspace<float>&);                             \
    extern template void id<double>(const Model<double>&, State<double>&, Workspace<double>&);
#include "sim/integrators/integrators.def"
#undef CLOTHLAB_INTEGRATOR

struct IntegratorInfo {
    IntegratorId id;
    std::string_view name;  ///< as scenes and the command line write it
    std::string_view title; ///< as people read it
    std::string_view help;
};

/// All methods, in the order of IntegratorId.
std::span<const IntegratorInfo> integrators();

/// Moves the masses by one time step with the model's method.
template <class Real>
void integrate(const Model<Real>& model, State<Real>& state, Workspace<Real>& work) {
    switch (model.integrator) {
#define CLOTHLAB_INTEGRATOR(id, name, title, help)                                                                     \
    case IntegratorId::id:                                                                                             \
        return id(model, state, work);
#include "sim/integrators/integrators.def"
#undef CLOTHLAB_INTEGRATOR
    }
}

/// Sets work.force to all forces of a state, in N: gravity, springs and the physical wind.
template <class Real>
void evaluate_forces(const Model<Real>& model, const State<Real>& state, Workspace<Real>& work);

extern template void evaluate_forces<float>(const Model<float>&, const State<float>&, Workspace<float>&);
extern template void evaluate_forces<double>(const Model<double>&, const State<double>&, Workspace<double>&);

} // namespace clothlab::sim
