// Where the steps of the line shown lie on the track: in frames, with a fraction for the substeps, and in seconds.
#pragma once

#include <cstdint>
#include <vector>

#include "timeline/overview.h"

namespace clothlab::ui {

class FrameAxis {
public:
    FrameAxis(const timeline::Overview& overview, const timeline::Playhead& playhead);

    double frame_of(std::uint64_t step) const;
    /// The step nearest to a place, from 0 to the line's end.
    std::uint64_t step_of(double frame) const;
    double time_of(double frame) const; ///< s
    double frame_at(double time) const;
    int substeps_at(double frame) const;
    double end() const { return frame_of(end_step_); }
    std::uint64_t end_step() const { return end_step_; }

private:
    // From one change of the substeps or the frame rate to the next.
    struct Part {
        std::uint64_t step;
        double frame, time;
        int substeps;
        double frames_per_second;
    };
    const Part& part_with(double frame) const;

    std::vector<Part> parts_; ///< at least one; ascending
    std::uint64_t end_step_ = 0;
};

/// Where a step lies on the line shown: none when it is on another branch.
bool on_line(const timeline::Overview& overview, const timeline::Moment& moment);

/// 1, 2 or 5 times a power of ten, the smallest that is not below `least`.
double round_step(double least);

} // namespace clothlab::ui
