// What implicit methods share.
#pragma once

#include <algorithm>

#include "sim/forces/forces.h"
#include "sim/model.h"
#include "sim/state.h"
#include "sim/workspace.h"

namespace clothlab::sim {

/// The wind's forces at the beginning of the step in N, or null in still air. They are not stiff: methods that are
/// implicit in the springs take them as they are.
template <class Real>
const Vec3Array<Real>* wind_forces(const Model<Real>& model, const State<Real>& state, Workspace<Real>& work,
                                   Vec3Array<Real>& out) {
    if (model.wind.kind == WindKind::none)
        return nullptr;
    // The course's air resistance is a share of all other forces: it is what they become with the wind, less them.
    evaluate_conservative_forces(model, state.position, work, work.force);
    out = work.force;
    add_wind(model, state.position, state.velocity, state.time, out);
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < out.size(); ++i)
            out.axes()[axis][i] -= work.force.axes()[axis][i];
    return &out;
}

} // namespace clothlab::sim
