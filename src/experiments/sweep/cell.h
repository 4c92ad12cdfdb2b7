// One run of a sweep, and the numbers that are kept of it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "experiments/table.h"
#include "sim/description.h"

namespace clothlab::experiments {

/// How long each run is.
struct SweepLength {
    std::uint64_t frames = 90;
    std::optional<double> seconds; ///< simulated; instead of frames, rounded up to a whole frame
};

/// How many frames a run of a description takes. Throws scene::SceneError for more than 1e15.
std::uint64_t frames_of(const SweepLength& length, const sim::Description& description);

/// Of what run_cell measures, in its order.
std::vector<Column> cell_columns(bool times);

/// Runs a description for so many frames, or until it diverges, on one thread, and says how it ended, in the order of
/// cell_columns. The wall time, where wanted, is that of the steps. Everything else is the same for every run on any
/// machine. `go_on` is told the share that is done after every frame; where it returns false, Cancelled is thrown.
std::vector<Value> run_cell(const sim::Description& description, std::uint64_t frames, bool times,
                            const std::function<bool(double share)>& go_on);

} // namespace clothlab::experiments
