// Position Verlet with damping on the displacement, as the course's specification gives it:
//     x(t + dt) = x + (1 - d) (x - x(t - dt)) + a dt²
// Its undamped form is L. Verlet, Physical Review 159 (1967), equation 4.
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "sim/forces/forces.h"
#include "sim/forces/springs.h"
#include "sim/forces/wind.h"
#include "sim/integrators/integrator.h"
#include "sim/stage_timer.h"

namespace clothlab::sim {
namespace {

/// Moves every free mass; with_wind is a compile-time switch so that still air costs nothing.
template <class Real, class WithWind>
void move(const Model<Real>& model, State<Real>& state, const Vec3Array<Real>& force, WithWind with_wind) {
    const Real dt = static_cast<Real>(model.dt), dt2 = dt * dt, c = model.force_share * dt2 / model.mass,
               keep = model.keep;
    const Real wind_factor = Real(0.7) * dt2;
    const Real t = model.wind.clock == WindClock::time ? static_cast<Real>(state.time) : dt;
    Vec3Array<Real>&x = state.position, &p = state.previous;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (model.pinned[i])
            continue;
        Triple<Real> next{x.x[i] + keep * (x.x[i] - p.x[i]) + force.x[i] * c,
                          x.y[i] + keep * (x.y[i] - p.y[i]) + force.y[i] * c,
                          x.z[i] + keep * (x.z[i] - p.z[i]) + force.z[i] * c};
        if constexpr (with_wind) {
            const Real m = model.mass;
            const Triple<Real> w = course_wind<Real>({x.x[i], x.y[i], x.z[i]}, t);
            const Triple<Real> r =
                course_air_resistance<Real>({force.x[i] / m, force.y[i] / m, force.z[i] / m},
                                            {(x.x[i] - p.x[i]) / dt, (x.y[i] - p.y[i]) / dt, (x.z[i] - p.z[i]) / dt});
            next.x -= wind_factor * (w.x + r.x);
            next.y -= wind_factor * (w.y + r.y);
            next.z -= wind_factor * (w.z + r.z);
        }
        p.x[i] = x.x[i];
        p.y[i] = x.y[i];
        p.z[i] = x.z[i];
        x.x[i] = next.x;
        x.y[i] = next.y;
        x.z[i] = next.z;
    }
}

/// Forces and move in one sweep: each point's next position takes the place of its previous one, and then the two
/// arrays change places.
template <class Real>
void sweep(const Model<Real>& model, State<Real>& state, Workspace<Real>& work) {
    const StageTimer timer(work, Stage::forces);
    Vec3Array<Real>&x = state.position, &p = state.previous;
    for (std::size_t k = 0; k < model.pins.size(); ++k) {
        const std::uint32_t i = model.pins[k];
        work.pin_previous[k] = {p.x[i], p.y[i], p.z[i]};
    }
    sweep_springs(model, x, work, verlet_sink(model), p);
    std::swap(x, p);
    for (std::size_t k = 0; k < model.pins.size(); ++k) {
        const std::uint32_t i = model.pins[k];
        x.x[i] = p.x[i];
        x.y[i] = p.y[i];
        x.z[i] = p.z[i];
        p.x[i] = work.pin_previous[k][0];
        p.y[i] = work.pin_previous[k][1];
        p.z[i] = work.pin_previous[k][2];
    }
}

} // namespace

template <class Real>
void course_verlet(const Model<Real>& model, State<Real>& state, Workspace<Real>& work, StepCounts& counts) {
    counts.force_evaluations = 1;
    if (model.wind.kind == WindKind::none && can_sweep(model, work))
        return sweep(model, state, work);
    evaluate_forces(model, state, work);
    const StageTimer timer(work, Stage::integrate);
    if (model.wind.kind == WindKind::course)
        move(model, state, work.force, std::true_type{});
    else
        move(model, state, work.force, std::false_type{});
}

const IntegratorTraits course_verlet_traits{
    .title = "Course Verlet",
    .help = "Position Verlet as the course writes it. Second order from the physical start, first order from the "
            "course's. The fastest method here for cloth that is not stiff.",
    .family = Family::explicit_method,
    .order = 2,
    .limit_formula = "2 sqrt(1 - d/2)",
    .limit = [](double d) { return 2 * std::sqrt(std::max(0.0, 1 - d / 2)); },
    .cost = "1 force evaluation, fused with the step",
    .source = "L. Verlet, Physical Review 159 (1967), equation 4; damping as in the course's handout",
    .velocity = false,
    .exact_damping = true};

CLOTHLAB_DEFINE_INTEGRATOR(course_verlet)

} // namespace clothlab::sim
