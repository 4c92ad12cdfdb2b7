// The same scene for both simulators: from the reference's parameters to clothlab's description.
#pragma once

#include "sim/description.h"
#include "support/reference_simulator.h"

namespace clothlab::test {

template <class Real>
constexpr sim::Precision precision_of = sizeof(Real) == 4 ? sim::Precision::single_precision
                                                          : sim::Precision::double_precision;

inline sim::Vec3 vec3(reference::Vector3 v) {
    return {v.x, v.y, v.z};
}

inline sim::Collider collider_of(const reference::Collider& c) {
    if (c.is_sphere)
        return sim::Sphere{vec3(c.place), c.radius, c.friction};
    return sim::Plane{vec3(c.place), vec3(c.normal), c.friction};
}

inline sim::Wind wind_of(const reference::Parameters& p) {
    sim::Wind wind;
    switch (p.wind) {
    case reference::Wind::none:
        break;
    case reference::Wind::course_with_step:
        wind.kind = sim::WindKind::course;
        break;
    case reference::Wind::course_with_time:
        wind.kind = sim::WindKind::course;
        wind.clock = sim::WindClock::time;
        break;
    case reference::Wind::physical:
        wind.kind = sim::WindKind::physical;
        break;
    }
    wind.velocity = vec3(p.wind_velocity);
    wind.gust = p.gust;
    wind.gust_period = p.gust_period;
    wind.air_density = p.air_density;
    wind.drag = p.drag;
    wind.lift = p.lift;
    return wind;
}

inline sim::Description description_of(const reference::Parameters& p,
                                       sim::Precision precision = sim::Precision::double_precision) {
    sim::Description description;
    description.cloth = {
        .width = p.width,
        .height = p.height,
        .num_width_points = p.columns,
        .num_height_points = p.rows,
        .thickness = p.thickness,
        .orientation = p.vertical ? sim::Orientation::vertical : sim::Orientation::horizontal,
        .ks = p.ks,
        .density = p.density,
        .damping = p.damping_percent,
        .enable_structural = p.structural,
        .enable_shearing = p.shear,
        .enable_bending = p.bending,
        .offset = vec3(p.offset),
        .pinned = p.pinned,
    };
    for (const reference::Collider& c : p.colliders)
        description.colliders.push_back(collider_of(c));
    description.wind = wind_of(p);
    description.rules.limit = p.stretch_limit ? sim::LimitRule::cs184 : sim::LimitRule::off;
    description.rules.self_collision = p.self_collision ? sim::SelfCollisionRule::cs184 : sim::SelfCollisionRule::none;
    description.stepping.precision = precision;
    description.stepping.frames_per_second = p.frames_per_second;
    description.stepping.substeps = p.substeps;
    description.stepping.seed = static_cast<double>(p.seed);
    description.stepping.gravity = vec3(p.gravity);
    for (const reference::Vector3& a : p.further_accelerations)
        description.stepping.accelerations.push_back(vec3(a));
    return description;
}

} // namespace clothlab::test
