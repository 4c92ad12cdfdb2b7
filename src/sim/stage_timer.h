// Attributes wall time to the stages of a step; costs nothing when the workspace is not timed.
#pragma once

#include <chrono>

#include "sim/workspace.h"

namespace clothlab::sim {

class StageTimer {
public:
    template <class Real>
    StageTimer(Workspace<Real>& work, Stage stage) : seconds_(work.timed ? &work.seconds[index(stage)] : nullptr) {
        if (seconds_)
            start_ = Clock::now();
    }
    ~StageTimer() {
        if (seconds_)
            *seconds_ += std::chrono::duration<double>(Clock::now() - start_).count();
    }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

private:
    using Clock = std::chrono::steady_clock;
    static std::size_t index(Stage stage) { return static_cast<std::size_t>(stage); }
    double* seconds_;
    Clock::time_point start_;
};

} // namespace clothlab::sim
