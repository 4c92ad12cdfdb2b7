#include "timeline/branch.h"

#include <algorithm>

namespace clothlab::timeline {

const FrameClock& clock_at(const Branch& branch, std::uint64_t step) {
    auto after = std::upper_bound(branch.clocks.begin(), branch.clocks.end(), step,
                                  [](std::uint64_t s, const FrameClock& clock) { return s < clock.step; });
    if (after != branch.clocks.begin())
        --after;
    return *after;
}

FrameTime frame_time(const Branch& branch, std::uint64_t step) {
    const FrameClock& clock = clock_at(branch, step);
    const auto substeps = static_cast<std::uint64_t>(clock.substeps);
    const std::uint64_t taken = step - clock.step + static_cast<std::uint64_t>(clock.substep);
    return {clock.frame + taken / substeps, static_cast<int>(taken % substeps), clock.substeps,
            clock.time + static_cast<double>(step - clock.step) * clock.dt};
}

std::uint64_t step_of_frame(const Branch& branch, std::uint64_t frame) {
    // The last clock that begins before the frame is complete.
    for (auto clock = branch.clocks.rbegin(); clock != branch.clocks.rend(); ++clock) {
        const bool complete = clock->frame > frame || (clock->frame == frame && clock->substep > 0);
        if (complete && std::next(clock) != branch.clocks.rend())
            continue;
        if (clock->frame >= frame)
            return clock->step;
        return clock->step + (frame - clock->frame) * static_cast<std::uint64_t>(clock->substeps) -
               static_cast<std::uint64_t>(clock->substep);
    }
    return branch.fork_step;
}

} // namespace clothlab::timeline
