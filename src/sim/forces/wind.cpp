// Physical wind: M. Keckeisen, S. Kimmerle, B. Thomaszewski, M. Wacker, "Modelling effects of wind fields in cloth
// animations", Journal of WSCG 12 (2004): drag along, and lift across, the relative flow at each face. A deviation:
// their lift has a unit vector for its direction and so is strongest, and without a direction, where the wind stands on
// the face. Here the part of the normal across the flow is used as it is, with the sine for its length: lift then
// vanishes there, and with equal coefficients drag and lift together are the pressure on a flat plate, along its
// normal.
#include "sim/forces/wind.h"

#include <cmath>
#include <numbers>

namespace clothlab::sim {

template <class Real>
Triple<Real> course_wind(Triple<Real> p, Real t) {
    return {std::sin(p.x * p.y * t), Real(1.2) * std::cos(Real(5) * p.z * t),
            Real(1.5) * (std::sin(std::cos(Real(5) * p.x * p.y * p.z)) + p.y / Real(1.5))};
}

template <class Real>
Triple<Real> course_air_resistance(Triple<Real> a, Triple<Real> v) {
    const Real acceleration = std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
    const Real speed = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    const Real factor = Real(0.5) * acceleration * speed;
    return {factor * v.x, factor * v.y, factor * v.z};
}

Vec3 air_velocity(const Wind& wind, double time) {
    // Three periods without a common multiple, so that the gusts never repeat in a lecture.
    double swing = 0;
    for (const double stretch : {1.0, 0.618, 0.377})
        swing += std::sin(2 * std::numbers::pi * time / (wind.gust_period * stretch)) / 3;
    const double factor = 1 + wind.gust * swing;
    return {wind.velocity.x * factor, wind.velocity.y * factor, wind.velocity.z * factor};
}

namespace {

/// Drag and lift; mean_velocity(a, b, c) is that of a triangle's corners.
template <class Real, class MeanVelocity>
void add_drag_and_lift(const Model<Real>& model, const Vec3Array<Real>& x, double time, MeanVelocity mean_velocity,
                       Vec3Array<Real>& force) {
    const Vec3 air = air_velocity(model.wind, time);
    const Triple<Real> wind{static_cast<Real>(air.x), static_cast<Real>(air.y), static_cast<Real>(air.z)};
    const Real drag = static_cast<Real>(0.5 * model.wind.air_density * model.wind.drag / 3);
    const Real lift = static_cast<Real>(0.5 * model.wind.air_density * model.wind.lift / 3);

    for_each_triangle(model.grid->columns, model.grid->rows, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const Triple<Real> mean = mean_velocity(a, b, c);
        const Triple<Real> u{wind.x - mean.x, wind.y - mean.y, wind.z - mean.z};
        const Triple<Real> e{x.x[b] - x.x[a], x.y[b] - x.y[a], x.z[b] - x.z[a]};
        const Triple<Real> f{x.x[c] - x.x[a], x.y[c] - x.y[a], x.z[c] - x.z[a]};
        const Triple<Real> cross{e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x};
        const Real twice_area = std::sqrt(cross.x * cross.x + cross.y * cross.y + cross.z * cross.z);
        const Real speed = std::sqrt(u.x * u.x + u.y * u.y + u.z * u.z);
        if (!(twice_area > 0) || !(speed > 0))
            return; // no normal, or no wind

        const Real along = cross.x * u.x + cross.y * u.y + cross.z * u.z;
        const Real side = along < 0 ? Real(-1) : Real(1);
        const Triple<Real> n{side * cross.x / twice_area, side * cross.y / twice_area, side * cross.z / twice_area};
        const Real cosine = side * along / (twice_area * speed);
        const Real flow = Real(0.5) * twice_area * cosine * speed; // A cos |u|, to be multiplied by |u| below
        // The part of n across the flow; its length is the sine, and n = cosine u/|u| + across.
        const Triple<Real> across{n.x - cosine * u.x / speed, n.y - cosine * u.y / speed, n.z - cosine * u.z / speed};
        const Real d = drag * flow, l = lift * flow * speed;
        const Triple<Real> share{d * u.x + l * across.x, d * u.y + l * across.y, d * u.z + l * across.z};
        for (const std::uint32_t corner : {a, b, c}) {
            force.x[corner] += share.x;
            force.y[corner] += share.y;
            force.z[corner] += share.z;
        }
    });
}

} // namespace

template <class Real>
void add_wind_forces(const Model<Real>& model, const State<Real>& state, Vec3Array<Real>& force) {
    const Real per_second = static_cast<Real>(1 / (3 * model.dt));
    const Vec3Array<Real>&x = state.position, &p = state.previous;
    const auto mean_velocity = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto mean = [&](const AlignedVector<Real>& now, const AlignedVector<Real>& before) {
            return ((now[a] - before[a]) + (now[b] - before[b]) + (now[c] - before[c])) * per_second;
        };
        return Triple<Real>{mean(x.x, p.x), mean(x.y, p.y), mean(x.z, p.z)};
    };
    add_drag_and_lift(model, x, state.time, mean_velocity, force);
}

template <class Real>
void add_wind_forces(const Model<Real>& model, const Vec3Array<Real>& position, const Vec3Array<Real>& velocity,
                     double time, Vec3Array<Real>& force) {
    const auto mean_velocity = [&v = velocity](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return Triple<Real>{(v.x[a] + v.x[b] + v.x[c]) / Real(3), (v.y[a] + v.y[b] + v.y[c]) / Real(3),
                            (v.z[a] + v.z[b] + v.z[c]) / Real(3)};
    };
    add_drag_and_lift(model, position, time, mean_velocity, force);
}

template <class Real>
void add_course_wind_forces(const Model<Real>& model, const Vec3Array<Real>& x, const Vec3Array<Real>& v, double time,
                            Vec3Array<Real>& force) {
    const Real m = model.mass;
    const Real t = static_cast<Real>(model.wind.clock == WindClock::time ? time : model.dt);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Triple<Real> w = course_wind<Real>({x.x[i], x.y[i], x.z[i]}, t);
        const Triple<Real> r =
            course_air_resistance<Real>({force.x[i] / m, force.y[i] / m, force.z[i] / m}, {v.x[i], v.y[i], v.z[i]});
        force.x[i] -= Real(0.7) * m * (w.x + r.x);
        force.y[i] -= Real(0.7) * m * (w.y + r.y);
        force.z[i] -= Real(0.7) * m * (w.z + r.z);
    }
}

#define CLOTHLAB_DEFINE(Real)                                                                                          \
    template Triple<Real> course_wind<Real>(Triple<Real>, Real);                                                       \
    template Triple<Real> course_air_resistance<Real>(Triple<Real>, Triple<Real>);                                     \
    template void add_wind_forces<Real>(const Model<Real>&, const State<Real>&, Vec3Array<Real>&);                     \
    template void add_wind_forces<Real>(const Model<Real>&, const Vec3Array<Real>&, const Vec3Array<Real>&, double,    \
                                        Vec3Array<Real>&);                                                             \
    template void add_course_wind_forces<Real>(const Model<Real>&, const Vec3Array<Real>&, const Vec3Array<Real>&,     \
                                               double, Vec3Array<Real>&);
CLOTHLAB_DEFINE(float)
CLOTHLAB_DEFINE(double)
#undef CLOTHLAB_DEFINE

} // namespace clothlab::sim
