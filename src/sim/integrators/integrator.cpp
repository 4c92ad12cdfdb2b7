#include "sim/integrators/integrator.h"

#include <vector>

#include "sim/forces/forces.h"

namespace clothlab::sim {

std::span<const IntegratorInfo> integrators() {
    static const std::vector<IntegratorInfo> list{
#define CLOTHLAB_INTEGRATOR(id, name) {id##_traits, IntegratorId::id, name},
#include "sim/integrators/integrators.def"
#undef CLOTHLAB_INTEGRATOR
    };
    return list;
}

template <class Real>
void adopt(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, double dt) {
    const IntegratorTraits& method = traits(model.integrator);
    const bool had_velocity = state.velocity.size() != 0;
    const std::size_t points = state.position.size();
    if (had_velocity != method.velocity) {
        const Real h = static_cast<Real>(dt);
        Vec3Array<Real>&x = state.position, &p = state.previous;
        Vec3Array<Real> a, v;
        a.resize(points);
        if (state.steps > 0) // at the start, no force has acted yet
            accelerations(model, x, nullptr, state.time, work, a);
        if (method.velocity) {
            v.resize(points);
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (std::size_t i = 0; i < points; ++i)
                    v.axes()[axis][i] = (x.axes()[axis][i] - p.axes()[axis][i]) / h + Real(0.5) * h * a.axes()[axis][i];
        } else {
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (std::size_t i = 0; i < points; ++i)
                    p.axes()[axis][i] =
                        x.axes()[axis][i] - h * state.velocity.axes()[axis][i] + Real(0.5) * h * h * a.axes()[axis][i];
        }
        state.velocity = std::move(v);
        state.history = 0;
        state.solver_step = 0;
    }
    if (method.velocity)
        for (const std::uint32_t pin : model.pins)
            state.velocity.x[pin] = state.velocity.y[pin] = state.velocity.z[pin] = 0;
    const bool history = keeps_history(model);
    if (history != (state.previous_velocity.size() != 0)) {
        state.previous_velocity = history ? state.velocity : Vec3Array<Real>();
        state.history = 0;
    }
}

template void adopt<float>(const Model<float>&, State<float>&, Workspace<float>&, double);
template void adopt<double>(const Model<double>&, State<double>&, Workspace<double>&, double);

} // namespace clothlab::sim
