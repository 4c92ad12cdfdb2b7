// A cloth with its insides open: tests set positions and velocities here and call single stages.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "sim/description.h"
#include "sim/random.h"
#include "sim/step.h"

namespace clothlab::test {

template <class Real>
struct Sheet {
    sim::Model<Real> model;
    sim::State<Real> state;
    sim::Vec3Array<Real> start;
    sim::Workspace<Real> work;

    explicit Sheet(const sim::Description& description, const sim::Execution& execution = {})
        : model(sim::make_model<Real>(description,
                                      std::make_shared<const sim::Grid<Real>>(sim::make_grid<Real>(description)))),
          state(sim::initial_state<Real>(description)), start(state.position),
          work(sim::make_workspace(model, execution)) {
        work.force.resize(points());
        sim::begin(model, state, work);
    }

    sim::StepCounts step() { return sim::step(model, state, work); }
    std::size_t points() const { return state.position.size(); }
    std::size_t at(int column, int row) const { return static_cast<std::size_t>(row * model.grid->columns + column); }
    sim::Vec3 position(std::size_t i) const { return coordinates(state.position, i); }
    sim::Vec3 previous(std::size_t i) const { return coordinates(state.previous, i); }
    static void put(sim::Vec3Array<Real>& array, std::size_t i, sim::Vec3 v) {
        array.x[i] = static_cast<Real>(v.x);
        array.y[i] = static_cast<Real>(v.y);
        array.z[i] = static_cast<Real>(v.z);
    }
    /// Puts a point somewhere, at rest.
    void place(std::size_t i, sim::Vec3 v) {
        put(state.position, i, v);
        put(state.previous, i, v);
    }
    static sim::Vec3 coordinates(const sim::Vec3Array<Real>& array, std::size_t i) {
        return {static_cast<double>(array.x[i]), static_cast<double>(array.y[i]), static_cast<double>(array.z[i])};
    }
    /// Calls visit(a, b, s) for every spring that pulls, in order.
    template <class Visit>
    void for_each_pulling_spring(Visit visit) const {
        sim::for_each_spring(model.grid->columns, model.grid->rows,
                             [&](std::uint32_t a, std::uint32_t b, std::size_t s) {
                                 if (model.pulls(s))
                                     visit(a, b, s);
                             });
    }
    void still_forces() {
        for (auto* axis : {&work.force.x, &work.force.y, &work.force.z})
            std::fill(axis->begin(), axis->end(), Real(0));
    }
};

/// A cloth of springs and nothing else: no gravity, damping, limit, self-collision or collider.
inline sim::Description bare_cloth(int columns, int rows) {
    sim::Description description;
    description.cloth.num_width_points = columns;
    description.cloth.num_height_points = rows;
    description.cloth.damping = 0;
    description.rules.limit = sim::LimitRule::off;
    description.rules.self_collision = sim::SelfCollisionRule::none;
    description.stepping.gravity = {0, 0, 0};
    description.stepping.precision = sim::Precision::double_precision;
    return description;
}

/// Uniform in [low, high).
inline double uniform(sim::SplitMix64& random, double low, double high) {
    return low + (high - low) * random.unit();
}

/// Lets cloth lie or stand, with some kinds of springs and with damping or without.
inline void vary_springs(sim::Cloth& cloth, sim::SplitMix64& random) {
    cloth.orientation = random.next() % 2 == 0 ? sim::Orientation::horizontal : sim::Orientation::vertical;
    cloth.enable_structural = random.next() % 4 != 0;
    cloth.enable_shearing = random.next() % 4 != 0;
    cloth.enable_bending = random.next() % 4 != 0;
    cloth.damping = random.next() % 3 == 0 ? 0 : 0.3;
}

inline sim::Vec3 uniform_point(sim::SplitMix64& random, double low, double high) {
    const double x = uniform(random, low, high), y = uniform(random, low, high), z = uniform(random, low, high);
    return {x, y, z};
}

inline sim::Vec3 minus(sim::Vec3 a, sim::Vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline double dot(sim::Vec3 a, sim::Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline double norm(sim::Vec3 a) {
    return std::sqrt(dot(a, a));
}

} // namespace clothlab::test
