// The inside of one step, for looking at: where the points are after each of its stages, and the forces it began with.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/diagnostics.h"
#include "sim/state.h"
#include "sim/step.h"

namespace clothlab::sim {

struct StepTrace {
    std::uint64_t step = 0;    ///< steps taken before it
    double dt = 0;             ///< s
    double mass = 0;           ///< kg per point
    std::vector<float> before; ///< m; x, y, z per point
    /// N, of every point at the step's begin, pinned ones too: springs, gravity, wind, damping where it is a force.
    std::vector<float> force;
    /// m, after each stage; that of `forces` is `before`, and a stage that the model does not have is as the one
    /// before.
    std::array<std::vector<float>, stage_count> after;
    std::array<bool, stage_count> active{};            ///< the model has the stage
    std::array<std::size_t, stage_count> moved{};      ///< points that the stage moved
    std::array<double, stage_count> rms_moved{};       ///< m, root mean square over all points
    std::array<double, stage_count> max_moved{};       ///< m
    std::array<std::uint32_t, stage_count> furthest{}; ///< the point that was moved by max_moved
    std::array<Energy, stage_count> energy{};          ///< J, after each stage
    std::array<double, stage_count> max_strain{};      ///< after each stage
    StepCounts counts;
};

} // namespace clothlab::sim
