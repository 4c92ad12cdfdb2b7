// All that changes while steps are taken and is needed to resume a run bit for bit.
#pragma once

#include <array>
#include <cstdint>

#include "sim/grid.h"

namespace clothlab::sim {

template <class Real>
struct State {
    Vec3Array<Real> position; ///< m
    Vec3Array<Real> previous; ///< m, one step earlier
    /// m/s; empty for methods that keep it as position - previous (IntegratorTraits::velocity).
    Vec3Array<Real> velocity;
    Vec3Array<Real> previous_velocity; ///< m/s, one step earlier; empty for methods that do not look back
    double time = 0;                   ///< s
    std::uint64_t steps = 0;
    std::uint32_t history = 0; ///< how many steps back the previous values were computed with the present dt
    double solver_step = 0;    ///< s, what a method that chooses its own steps tries next; 0: it has not begun
    bool operator==(const State&) const = default;
};

/// The stages of a step, in order. Where one pass over the points computes the forces and moves the points, all of its
/// time counts as that of the forces.
enum class Stage : std::uint8_t { forces, integrate, self_collision, colliders, limit };
inline constexpr int stage_count = 5;
inline constexpr std::array<const char*, stage_count> stage_names{"forces", "integrate", "self_collision", "colliders",
                                                                  "limit"};
/// Seconds of wall time spent in each stage.
using StageSeconds = std::array<double, stage_count>;

} // namespace clothlab::sim
