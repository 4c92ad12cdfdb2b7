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

template <class Real>
void add_wind_forces(const Model<Real>& model, const State<Real>& state, Vec3Array<Real>& force) {
    const Vec3 air = air_velocity(model.wind, state.time);
    const Triple<Real> wind{static_cast<Real>(air.x), static_cast<Real>(air.y), static_cast<Real>(air.z)};
    const Real drag = static_cast<Real>(0.5 * model.wind.air_density * model.wind.drag / 3);
    const Real lift = static_cast<Real>(0.5 * model.wind.air_density * model.wind.lift / 3);
    const Real per_second = static_cast<Real>(1 / (3 * model.dt));
    const Vec3Array<Real>&x = state.position, &p = state.previous;

    for_each_triangle(model.grid->columns, model.grid->rows, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto mean_velocity = [&](const AlignedVector<Real>& now, const AlignedVector<Real>& before) {
            return ((now[a] - before[a]) + (now[b] - before[b]) + (now[c] - before[c])) * per_second;
        };
        const Triple<Real> u{wind.x - mean_velocity(x.x, p.x), wind.y - mean_velocity(x.y, p.y),
                             wind.z - mean_velocity(x.z, p.z)};
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

#define CLOTHLAB_DEFINE(Real)                                                                                          \
    template Triple<Real> course_wind<Real>(Triple<Real>, Real);                                                       \
    template Triple<Real> course_air_resistance<Real>(Triple<Real>, Triple<Real>);                                     \
    template void add_wind_forces<Real>(const Model<Real>&, const State<Real>&, Vec3Array<Real>&);
CLOTHLAB_DEFINE(float)
CLOTHLAB_DEFINE(double)
#undef CLOTHLAB_DEFINE

} // namespace clothlab::sim
