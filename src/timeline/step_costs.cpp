#include "timeline/step_costs.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace clothlab::timeline {
namespace {

/// Frames on either side of one that tell what it takes, so that it does not count when the machine paused.
constexpr std::ptrdiff_t around = 2;

double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace

StepCosts::StepCosts(const Branch& branch) : branch_(&branch), sums_{0} {
    std::vector<double> frames, near;
    frames.reserve(branch.samples.size());
    sums_.reserve(branch.samples.size() + 1);
    auto clock = branch.clocks.begin();
    for (const Sample& sample : branch.samples) {
        while (std::next(clock) != branch.clocks.end() && std::next(clock)->frame < sample.frame)
            ++clock;
        frames.push_back(clock->substeps *
                         std::accumulate(sample.stage_seconds.begin(), sample.stage_seconds.end(), 0.0));
    }
    for (auto frame = frames.begin(); frame != frames.end(); ++frame) {
        near.assign(frame - std::min(around, frame - frames.begin()),
                    frame + std::min(around + 1, frames.end() - frame));
        sums_.push_back(sums_.back() + median(near));
    }
    if (!frames.empty())
        frame_s_ = median(frames);
}

double StepCosts::until_s(std::uint64_t step) const {
    const FrameTime at = frame_time(*branch_, step);
    const std::vector<Sample>& samples = branch_->samples;
    const auto next = std::upper_bound(samples.begin(), samples.end(), at.frame,
                                       [](std::uint64_t frame, const Sample& s) { return frame < s.frame; });
    const auto whole = static_cast<std::size_t>(next - samples.begin());
    const bool known = next != samples.end() && next->frame == at.frame + 1; // not that of the frame under way
    const double frame_s = known ? sums_[whole + 1] - sums_[whole] : frame_s_;
    return sums_[whole] + frame_s * at.substep / at.substeps;
}

} // namespace clothlab::timeline
