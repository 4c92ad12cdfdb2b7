// How far two branches are from each other: point by point at the same simulated time.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "timeline/reader.h"

namespace clothlab::timeline {

struct Distance {
    double rms = 0, max = 0; ///< m
};

/// The distances of points, x, y, z each; `each` gets one per point. Points that are not finite in one of the two count
/// as no distance. Throws std::invalid_argument for different numbers of points.
Distance distance(std::span<const float> a, std::span<const float> b, std::vector<float>& each);

/// The moment of another line that a line is compared with: the one at the same simulated time, to the nearest step
/// reachable; none where the other line has nothing so late or has another grid.
std::optional<Moment> same_time(const Timeline& timeline, const Moment& moment, BranchId other);

struct DistanceSample {
    std::uint64_t frame = 0; ///< of the first line
    double time = 0;         ///< s
    Distance distance;
};

/// The curve of the distance of two lines over their common frames, computed a frame at a time, from where they part.
class Comparison {
public:
    /// Works on a copy of the timeline.
    Comparison(Timeline timeline, BranchId a, BranchId b, const sim::Execution& execution = {});
    /// The next frame; false when there is none.
    bool advance();
    const std::vector<DistanceSample>& samples() const { return samples_; }
    /// Share done, 0 to 1.
    double progress() const;

private:
    Timeline timeline_;
    BranchId a_, b_;
    Reader reader_a_, reader_b_;
    std::uint64_t next_ = 0, first_ = 0, last_ = 0; ///< frames of a
    std::vector<DistanceSample> samples_;
    std::vector<float> each_;
};

} // namespace clothlab::timeline
