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

/// The moment of another line that a line is compared with: the one at the same simulated time, to the nearest step;
/// none where the other line has nothing so late, has dropped it or has another grid, and for lines that there are not.
std::optional<Moment> same_time(const Timeline& timeline, const Moment& moment, BranchId other);

struct DistanceSample {
    std::uint64_t frame = 0; ///< of the first line
    double time = 0;         ///< s
    Distance distance;
};

/// The curve of the distance of two lines over their common frames, computed a frame at a time, from where they part.
/// Frames that cannot be reached in both are left out.
class Comparison {
public:
    /// Works on a copy of the timeline.
    Comparison(Timeline timeline, BranchId a, BranchId b, const sim::Execution& execution = {});
    /// The next frame; false when there is none. Throws std::runtime_error when a stored state cannot be read.
    bool advance();
    /// Goes on with a newer copy of the same timeline, in which the lines may have become longer.
    void grow(Timeline timeline);
    const std::vector<DistanceSample>& samples() const { return samples_; }
    /// Share done, 0 to 1.
    double progress() const;

private:
    void find_end();

    Timeline timeline_;
    BranchId a_, b_;
    Reader reader_a_, reader_b_;
    std::uint64_t first_ = 0, next_ = 0, end_ = 0; ///< frames of a; end_ is the first that b has nothing of
    std::vector<DistanceSample> samples_;
    std::vector<float> each_;
};

} // namespace clothlab::timeline
