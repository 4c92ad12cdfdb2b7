// All that changes while steps are taken and is needed to resume a run bit for bit, and the scratch memory of a step.
#pragma once

#include <array>
#include <cstdint>

#include "sim/grid.h"

namespace clothlab::sim {

template <class Real>
struct State {
    Vec3Array<Real> position; ///< m
    Vec3Array<Real> previous; ///< m, one step earlier
    double time = 0;          ///< s
    std::uint64_t steps = 0;
    bool operator==(const State&) const = default;
};

/// The stages of a step, in order.
enum class Stage : std::uint8_t { forces, integrate, self_collision, colliders, limit };
inline constexpr int stage_count = 5;
inline constexpr std::array<const char*, stage_count> stage_names{"forces", "integrate", "self_collision", "colliders",
                                                                  "limit"};
/// Seconds of wall time spent in each stage.
using StageSeconds = std::array<double, stage_count>;

/// Cells of the self-collision: per cell slot a chain of points in index order.
struct CellLists {
    std::vector<std::int32_t> first; ///< per slot, -1 when empty; the size is a power of two
    std::vector<std::int32_t> next;  ///< per point, -1 at the end
};

/// Memory that a step writes before it reads: sized once, not part of the state.
template <class Real>
struct Workspace {
    Vec3Array<Real> force; ///< N
    Vec3Array<Real> cell;  ///< cell coordinates of the self-collision, whole numbers
    CellLists cells;
    StageSeconds seconds{}; ///< summed up over all steps when timed
    bool timed = false;
};

} // namespace clothlab::sim
