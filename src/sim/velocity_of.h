// The velocities of a state, wherever its method keeps them.
#pragma once

#include <cstddef>

#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

/// In m/s: the state's own or, for methods that keep none, (position - previous) / dt, those of the last half step.
template <class Real>
class VelocityOf {
public:
    VelocityOf(const Model<Real>& model, const State<Real>& state) : state_(state), dt_(model.dt) {}
    Vec3 operator()(std::size_t i) const {
        const auto d = [](Real v) { return static_cast<double>(v); };
        const Vec3Array<Real>&x = state_.position, &p = state_.previous, &v = state_.velocity;
        if (v.size() != 0)
            return {d(v.x[i]), d(v.y[i]), d(v.z[i])};
        return {(d(x.x[i]) - d(p.x[i])) / dt_, (d(x.y[i]) - d(p.y[i])) / dt_, (d(x.z[i]) - d(p.z[i])) / dt_};
    }

private:
    const State<Real>& state_;
    double dt_;
};

} // namespace clothlab::sim
