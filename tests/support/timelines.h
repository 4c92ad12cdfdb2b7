// Timelines for tests of what is kept: of a cloth of a few points, and without any simulation behind them.
#pragma once

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "timeline/player.h"

namespace clothlab::test {

using timeline::Branch;
using timeline::BranchId;
using timeline::CacheOptions;
using timeline::Keyframe;
using timeline::Player;
using timeline::Sample;
using timeline::Timeline;

inline sim::Description tiny_cloth() {
    sim::Description d;
    d.cloth.num_width_points = 4;
    d.cloth.num_height_points = 3;
    d.cloth.pinned = {{0, 0}};
    d.stepping.substeps = 2;
    return d;
}

inline Sample sample_of(std::uint64_t frame, double seconds) {
    Sample sample{.frame = frame, .time = static_cast<double>(frame) / 90};
    sample.stage_seconds[0] = static_cast<float>(seconds / 30);
    return sample;
}

/// A branch without a simulation behind it: a state of so many bytes at the end of every frame, which took so long.
inline Timeline made_up(std::size_t budget, std::uint64_t frames, std::size_t bytes, double frame_s,
                        double least_reach_s = 0) {
    Timeline timeline({.budget = budget, .seek_s = 0.01, .least_reach_s = least_reach_s});
    const auto description = std::make_shared<const sim::Description>();
    const BranchId id = timeline.add_root(description, {0, 0, 0, 30, 0, 1.0 / 2700});
    timeline.store(id, {0, 0, description, nullptr, false});
    Branch& branch = *timeline.find(id);
    for (std::uint64_t frame = 1; frame <= frames; ++frame) {
        branch.end = 30 * frame;
        branch.keyframes.back().until = branch.end;
        branch.samples.push_back(sample_of(frame, frame_s));
        timeline.store(
            id, {branch.end, branch.end, description, timeline::keep_in_memory(std::vector<std::byte>(bytes)), false});
    }
    return timeline;
}

/// The most frames from one stored state to the next, over all that is reachable.
inline std::uint64_t widest_gap(const Branch& branch) {
    std::uint64_t widest = 0;
    for (const Keyframe& keyframe : branch.keyframes)
        widest = std::max(widest, (keyframe.until - keyframe.step) / 30);
    return widest;
}

inline std::uint64_t hash_at(Player& player, std::uint64_t step) {
    REQUIRE(player.seek(step));
    return player.simulation().hash();
}

} // namespace clothlab::test
