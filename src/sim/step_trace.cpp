#include "sim/step_trace.h"

#include <cmath>

#include "sim/forces/forces.h"
#include "sim/integrators/integrator.h"
#include "sim/step_recorder.h"

namespace clothlab::sim {
namespace {

template <class Real>
std::vector<float> interleaved(const Vec3Array<Real>& v) {
    std::vector<float> all(3 * v.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
        all[3 * i] = static_cast<float>(v.x[i]);
        all[3 * i + 1] = static_cast<float>(v.y[i]);
        all[3 * i + 2] = static_cast<float>(v.z[i]);
    }
    return all;
}

/// All forces that a step begins with, in N. The physical rule's damping is one of them, -c m v, but for the methods
/// that multiply the motion instead (IntegratorTraits::exact_damping); the course's damping never is.
template <class Real>
Vec3Array<Real> forces(const Model<Real>& model, const State<Real>& state, Workspace<Real>& work) {
    Vec3Array<Real> force;
    evaluate_conservative_forces(model, state.position, work, force);
    const bool damped = model.damping_rate != 0 && !traits(model.integrator).exact_damping;
    if (model.wind.kind == WindKind::none && !damped)
        return force;
    Vec3Array<Real> velocity = state.velocity;
    if (velocity.size() == 0) {
        velocity.resize(state.position.size());
        const Real dt = static_cast<Real>(model.dt);
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < velocity.size(); ++i)
                velocity.axes()[axis][i] = (state.position.axes()[axis][i] - state.previous.axes()[axis][i]) / dt;
    }
    add_wind(model, state.position, velocity, state.time, force);
    if (damped) {
        const Real c = static_cast<Real>(model.damping_rate) * model.mass;
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < velocity.size(); ++i)
                force.axes()[axis][i] -= c * velocity.axes()[axis][i];
    }
    return force;
}

} // namespace

template <class Real>
void StepRecorder<Real>::begin(const Model<Real>& model, const State<Real>& state, Workspace<Real>& work) {
    trace_ = {};
    trace_.step = state.steps;
    trace_.dt = model.dt;
    trace_.mass = static_cast<double>(model.mass);
    trace_.before = interleaved(state.position);
    trace_.force = interleaved(forces(model, state, work));
    last_ = state.position;
    after(Stage::forces, true, model, state);
}

template <class Real>
void StepRecorder<Real>::after(Stage stage, bool active, const Model<Real>& model, const State<Real>& state) {
    const auto s = static_cast<std::size_t>(stage);
    trace_.active[s] = active;
    trace_.after[s] = interleaved(state.position);
    double sum = 0;
    for (std::size_t i = 0; i < last_.size(); ++i) {
        double square = 0;
        bool moved = false;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Real from = last_.axes()[axis][i], to = state.position.axes()[axis][i];
            const double d = static_cast<double>(to) - static_cast<double>(from);
            moved |= from != to;
            square += d * d;
        }
        trace_.moved[s] += moved ? 1 : 0;
        sum += square;
        if (std::sqrt(square) > trace_.max_moved[s]) {
            trace_.max_moved[s] = std::sqrt(square);
            trace_.furthest[s] = static_cast<std::uint32_t>(i);
        }
    }
    trace_.rms_moved[s] = std::sqrt(sum / static_cast<double>(last_.size()));
    const Diagnostics diagnostics = diagnose(model, state);
    trace_.energy[s] = diagnostics.energy;
    trace_.max_strain[s] = diagnostics.max_strain;
    last_ = state.position;
}

template class StepRecorder<float>;
template class StepRecorder<double>;

} // namespace clothlab::sim
