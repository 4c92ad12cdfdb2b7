// Watches a run for what makes its numbers worthless: values that are no longer finite, a cloth that grows without
// bound, and the bounded jitter that the stretch limit leaves where springs are too stiff for the step.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/diagnostics.h"
#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

/// What went wrong first, when, where and why.
struct Trouble {
    Status status = Status::diverged; ///< jitter or diverged
    double time = 0;                  ///< s
    std::uint64_t frame = 0;          ///< whole frames since the start
    int column = 0, row = 0;          ///< of the worst point
    std::string cause;                ///< a sentence, with all of the above
    bool operator==(const Trouble&) const = default;
};

} // namespace clothlab::sim
