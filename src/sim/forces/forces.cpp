#include "sim/forces/forces.h"

#include "sim/forces/gravity.h"
#include "sim/forces/springs.h"
#include "sim/forces/wind.h"
#include "sim/stage_timer.h"

namespace clothlab::sim {

template <class Real>
void evaluate_conservative_forces(const Model<Real>& model, const Vec3Array<Real>& position, Workspace<Real>& work,
                                  Vec3Array<Real>& out) {
    out.resize(model.grid->points());
    if (can_sweep(model, work)) {
        sweep_springs(model, position, work, SweepSink::force, out);
    } else {
        set_gravity_forces(model, out);
        add_spring_forces(model, position, out);
    }
}

template <class Real>
void evaluate_forces(const Model<Real>& model, const State<Real>& state, Workspace<Real>& work) {
    const StageTimer timer(work, Stage::forces);
    evaluate_conservative_forces(model, state.position, work, work.force);
    if (model.wind.kind == WindKind::physical)
        add_wind_forces(model, state, work.force);
}

template <class Real>
void add_wind(const Model<Real>& model, const Vec3Array<Real>& position, const Vec3Array<Real>& velocity, double time,
              Vec3Array<Real>& out) {
    if (model.wind.kind == WindKind::physical)
        add_wind_forces(model, position, velocity, time, out);
    else if (model.wind.kind == WindKind::course)
        add_course_wind_forces(model, position, velocity, time, out);
}

namespace {

template <class Real>
void accelerate(const Model<Real>& model, const Vec3Array<Real>& position, const Vec3Array<Real>* velocity, double time,
                double damping_rate, Workspace<Real>& work, Vec3Array<Real>& out) {
    const StageTimer timer(work, Stage::forces);
    evaluate_conservative_forces(model, position, work, out);
    if (velocity)
        add_wind(model, position, *velocity, time, out);
    const Real c = static_cast<Real>(damping_rate);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Real* a = out.axes()[axis];
        const std::size_t points = out.size();
        for (std::size_t i = 0; i < points; ++i)
            a[i] /= model.mass;
        if (velocity && c != 0) {
            const Real* v = velocity->axes()[axis];
            for (std::size_t i = 0; i < points; ++i)
                a[i] -= c * v[i];
        }
        for (const std::uint32_t pin : model.pins)
            a[pin] = 0;
    }
}

} // namespace

template <class Real>
void undamped_accelerations(const Model<Real>& model, const Vec3Array<Real>& position, const Vec3Array<Real>& velocity,
                            double time, Workspace<Real>& work, Vec3Array<Real>& out) {
    accelerate(model, position, &velocity, time, 0, work, out);
}

template <class Real>
void accelerations(const Model<Real>& model, const Vec3Array<Real>& position,
                   const std::type_identity_t<Vec3Array<Real>>* velocity, double time, Workspace<Real>& work,
                   Vec3Array<Real>& out) {
    accelerate(model, position, velocity, time, model.damping_rate, work, out);
}

#define CLOTHLAB_DEFINE(Real)                                                                                          \
    template void evaluate_forces<Real>(const Model<Real>&, const State<Real>&, Workspace<Real>&);                     \
    template void evaluate_conservative_forces<Real>(const Model<Real>&, const Vec3Array<Real>&, Workspace<Real>&,     \
                                                     Vec3Array<Real>&);                                                \
    template void add_wind<Real>(const Model<Real>&, const Vec3Array<Real>&, const Vec3Array<Real>&, double,           \
                                 Vec3Array<Real>&);                                                                    \
    template void undamped_accelerations<Real>(const Model<Real>&, const Vec3Array<Real>&, const Vec3Array<Real>&,     \
                                               double, Workspace<Real>&, Vec3Array<Real>&);                            \
    template void accelerations<Real>(const Model<Real>&, const Vec3Array<Real>&, const Vec3Array<Real>*, double,      \
                                      Workspace<Real>&, Vec3Array<Real>&);
CLOTHLAB_DEFINE(float)
CLOTHLAB_DEFINE(double)
#undef CLOTHLAB_DEFINE

} // namespace clothlab::sim
