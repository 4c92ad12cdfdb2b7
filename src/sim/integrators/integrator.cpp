#include "sim/integrators/integrator.h"

#include "sim/forces/gravity.h"
#include "sim/forces/springs.h"
#include "sim/forces/wind.h"
#include "sim/stage_timer.h"

namespace clothlab::sim {

std::span<const IntegratorInfo> integrators() {
    static constexpr IntegratorInfo list[] = {
#define CLOTHLAB_INTEGRATOR(id, name, title, help) {IntegratorId::id, name, title, help},
#include "sim/integrators/integrators.def"
#undef CLOTHLAB_INTEGRATOR
    };
    return list;
}

template <class Real>
void evaluate_forces(const Model<Real>& model, const State<Real>& state, Workspace<Real>& work) {
    const StageTimer timer(work, Stage::forces);
    work.force.resize(model.grid->points());
    if (can_sweep(model, work)) {
        sweep_springs(model, state.position, work, SweepSink::force, work.force);
    } else {
        set_gravity_forces(model, work.force);
        add_spring_forces(model, state.position, work.force);
    }
    if (model.wind.kind == WindKind::physical)
        add_wind_forces(model, state, work.force);
}

template void evaluate_forces<float>(const Model<float>&, const State<float>&, Workspace<float>&);
template void evaluate_forces<double>(const Model<double>&, const State<double>&, Workspace<double>&);

} // namespace clothlab::sim
