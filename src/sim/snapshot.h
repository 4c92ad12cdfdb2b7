// What a moment of a run shows: plain data that a simulation fills in and that renderer, panels and files read.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/diagnostics.h"
#include "sim/execution.h"
#include "sim/monitor.h"
#include "sim/point_quantities.h"
#include "sim/stability.h"
#include "sim/state.h"
#include "sim/step.h"

namespace clothlab::sim {

/// What a snapshot has only where it is asked for, for its cost.
struct SnapshotExtras {
    bool stability = false;
    PointQuantity quantity = PointQuantity::none;
    PointQuantity second_quantity = PointQuantity::none; ///< for a picture that shows two
};

struct Snapshot {
    std::uint64_t capture = 0; ///< another number for every capture; 0 in a snapshot that was made by hand
    int columns = 0, rows = 0;
    std::vector<float> positions;                      ///< x, y, z per point, row-major, in m
    PointQuantity quantity_kind = PointQuantity::none; ///< what `quantity` has
    std::vector<float> quantity;                       ///< one per point; empty where none was asked for
    PointQuantity second_quantity_kind = PointQuantity::none;
    std::vector<float> second_quantity; ///< the same of the second
    double time = 0;                    ///< s
    std::uint64_t steps = 0;
    std::uint64_t frame = 0;                  ///< whole frames since the start
    int substep = 0;                          ///< steps taken of the frame under way
    int substeps = 1;                         ///< per frame
    double dt = 0;                            ///< s
    Diagnostics diagnostics;                  ///< with the status and cause of `trouble`, if there is any
    std::optional<Trouble> trouble;           ///< the run's first, while it is watched
    std::optional<StabilityMargin> stability; ///< only where it was asked for
    StepCounts counts;                        ///< of the last step
    InstructionSet instructions = InstructionSet::scalar;
    int threads = 1;                 ///< of the last step
    StageSeconds seconds_per_step{}; ///< mean wall time of each stage since the last snapshot
};

} // namespace clothlab::sim
