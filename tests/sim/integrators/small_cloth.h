// A small cloth and the problem that backward Euler poses in one step of it.
#pragma once

#include <algorithm>

#include "sim/forces/forces.h"
#include "sim/integrators/integrator.h"
#include "support/sheet.h"

namespace clothlab::test {

/// 6 x 5 points in steps of 1 ms, each as heavy as a point of the default cloth, hung by two corners.
inline sim::Description small_cloth(sim::IntegratorId integrator) {
    sim::Description description = bare_cloth(6, 5);
    description.cloth.density = 0.06 * 30;
    description.cloth.pinned = {{0, 0}, {5, 0}};
    description.rules.damping = sim::DampingRule::physical;
    description.cloth.damping_rate = 5.4;
    description.stepping.gravity = {0, -9.8, 0};
    description.stepping.frames_per_second = 100;
    description.stepping.substeps = 10;
    description.stepping.integrator = integrator;
    return description;
}

/// Folds a sheet over in the middle, shakes every free point by up to `shake` m, and gives it a velocity of up to
/// 1 m/s along each axis.
template <class Real>
void crumple(Sheet<Real>& sheet, double shake = 0.02) {
    sim::SplitMix64 random(5);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 at = sheet.position(i), d = uniform_point(random, -shake, shake);
        const sim::Vec3 v = uniform_point(random, -1, 1);
        if (sheet.model.pinned[i])
            continue;
        const bool folded = at.z > 0.5;
        sheet.place(i, {at.x + d.x, at.y + d.y + (folded ? 0.05 : 0), (folded ? 1 - at.z : at.z) + d.z});
        Sheet<Real>::put(sheet.state.velocity, i, v);
    }
}

inline double farthest(const Sheet<double>& sheet, const sim::Vec3Array<double>& from) {
    double farthest = 0;
    for (std::size_t i = 0; i < sheet.points(); ++i)
        farthest = std::max(farthest, norm(minus(sheet.position(i), Sheet<double>::coordinates(from, i))));
    return farthest;
}

/// The largest force that is out of balance after a step from a state with velocities v_n, as a multiple of a point's
/// weight: a (x - x_n) - b v_n - F(x). Backward Euler has a = m (1 + c dt) / dt² and b = m / dt.
inline double out_of_balance(Sheet<double>& sheet, const sim::Vec3Array<double>& v_n, double a, double b) {
    sim::Vec3Array<double> force;
    sim::evaluate_conservative_forces(sheet.model, sheet.state.position, sheet.work, force);
    double largest = 0;
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        if (sheet.model.pinned[i])
            continue;
        const sim::Vec3 moved = minus(sheet.position(i), sheet.previous(i));
        const sim::Vec3 v = Sheet<double>::coordinates(v_n, i), f = Sheet<double>::coordinates(force, i);
        largest = std::max(
            largest, norm({a * moved.x - b * v.x - f.x, a * moved.y - b * v.y - f.y, a * moved.z - b * v.z - f.z}));
    }
    return largest / (sheet.model.mass * 9.8);
}

} // namespace clothlab::test
