// What steps cost when they were taken, and so what a seek over them will take.
#pragma once

#include <cstdint>
#include <vector>

#include "timeline/branch.h"

namespace clothlab::timeline {

/// Of one branch, as long as its samples stay what they are.
class StepCosts {
public:
    explicit StepCosts(const Branch& branch);
    /// What a frame takes, in s: the median of those that are known; 0 without any.
    double frame_s() const { return frame_s_; }
    /// What the steps after `from` up to `to` took, in s, but for pauses of the machine. Nothing between the two may
    /// have been dropped.
    double between_s(std::uint64_t from, std::uint64_t to) const { return until_s(to) - until_s(from); }

private:
    double until_s(std::uint64_t step) const; ///< from the first frame that is known

    const Branch* branch_;
    double frame_s_ = 0;
    std::vector<double> sums_; ///< s; of as many of the branch's samples
};

} // namespace clothlab::timeline
