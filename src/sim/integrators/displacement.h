// What methods share that find the next positions first, and then make velocities of the displacements: they begin with
// a prediction without springs and end with v = (x - x_n) / dt.
#pragma once

#include <algorithm>
#include <array>

#include "sim/integrators/combine.h"
#include "sim/integrators/implicit.h"

namespace clothlab::sim {

/// Where a point without springs goes: x_n + velocity v + force f, with the forces f that stand still during the step.
template <class Real>
struct Prediction {
    Real velocity; ///< s
    Real force;    ///< s²/kg
};

/// The exact solution of v' = f/m - c v over a step, c the physical rule's damping, and then x + dt v.
template <class Real>
Prediction<Real> explicit_prediction(const Model<Real>& model) {
    const bool physical = model.rules.damping == DampingRule::physical;
    const Real dt = static_cast<Real>(model.dt);
    return {dt * (physical ? model.keep : Real(1)), dt * dt * model.force_share / model.mass};
}

/// That of backward Euler: v = v_n + dt (f/m - c v).
template <class Real>
Prediction<Real> implicit_prediction(const Model<Real>& model) {
    const double damped = 1 + model.damping_rate * model.dt;
    return {static_cast<Real>(model.dt / damped),
            static_cast<Real>(model.dt * model.dt / damped / static_cast<double>(model.mass))};
}

/// Sets `wind` to the forces of the wind at the start of a step, in N; zero in still air.
template <class Real>
void set_wind(const Model<Real>& model, const State<Real>& state, Workspace<Real>& work, Vec3Array<Real>& wind) {
    if (wind_forces(model, state, work, wind))
        return;
    for (Real* axis : wind.axes())
        std::fill(axis, axis + wind.size(), Real(0));
}

/// Sets `previous` to the position, and moves the position of every free point to its prediction.
template <class Real>
void predict(const Model<Real>& model, Prediction<Real> factors, const Vec3Array<Real>& wind, State<Real>& state) {
    state.previous = state.position;
    const std::array<Real, 3> g{model.gx, model.gy, model.gz};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Real* x = state.position.axes()[axis];
        const Real *p = state.previous.axes()[axis], *v = state.velocity.axes()[axis], *w = wind.axes()[axis];
        const Real weight = model.mass * g[axis];
        for (std::size_t i = 0; i < state.position.size(); ++i)
            x[i] = p[i] + (factors.velocity * v[i] + factors.force * (weight + w[i]));
        for (const std::uint32_t pin : model.pins)
            x[pin] = p[pin];
    }
}

/// Puts the pins back, which whatever is multiplied by an inverse mass of zero does not move unless it is infinite, and
/// sets velocities to (position - previous) / dt, less what the course's damping takes.
template <class Real>
void velocities_from_displacements(const Model<Real>& model, State<Real>& state) {
    const Real dt = static_cast<Real>(model.dt);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Real *x = state.position.axes()[axis], *v = state.velocity.axes()[axis];
        const Real* p = state.previous.axes()[axis];
        for (const std::uint32_t pin : model.pins)
            x[pin] = p[pin];
        for (std::size_t i = 0; i < state.position.size(); ++i)
            v[i] = (x[i] - p[i]) / dt;
    }
    scale(state.velocity, model.course_keep);
}

} // namespace clothlab::sim
