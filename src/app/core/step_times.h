// What the steps that were taken cost, stage by stage: the mean since somebody last asked. Steps that a seek takes
// again do not count.
#pragma once

#include <cstdint>

#include "sim/simulation.h"

namespace clothlab::app {

class StepTimes {
public:
    void before_step(const sim::Simulation& simulation) {
        begin_ = simulation.stage_seconds();
        begin_step_ = simulation.steps();
    }
    /// The simulation may be another one than before the step, or have gone elsewhere: then nothing is counted.
    void after_step(const sim::Simulation& simulation) {
        const sim::StageSeconds& end = simulation.stage_seconds();
        bool one_step = simulation.steps() == begin_step_ + 1;
        for (std::size_t i = 0; i < end.size(); ++i)
            one_step = one_step && end[i] >= begin_[i];
        if (!one_step)
            return;
        for (std::size_t i = 0; i < end.size(); ++i)
            sums_[i] += end[i] - begin_[i];
        ++steps_;
    }
    /// In s per step; zeros when none was taken.
    sim::StageSeconds take() {
        sim::StageSeconds mean = sums_;
        for (double& seconds : mean)
            seconds = steps_ > 0 ? seconds / steps_ : 0;
        sums_ = {};
        steps_ = 0;
        return mean;
    }

private:
    sim::StageSeconds begin_{}, sums_{};
    std::uint64_t begin_step_ = 0;
    int steps_ = 0;
};

} // namespace clothlab::app
