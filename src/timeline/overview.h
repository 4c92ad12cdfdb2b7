// What panels show of a timeline: a picture of it at one moment, made in the simulation's thread and read in the
// window's.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "timeline/player.h"

namespace clothlab::timeline {

struct BranchInfo {
    BranchId id = 0;
    std::string name;
    BranchId parent = 0;
    int depth = 0; ///< below its root
    std::uint64_t fork_step = 0, fork_frame = 0;
    std::uint64_t end_step = 0, end_frame = 0;
    double end_time = 0; ///< s
    bool stem = false;   ///< deleted, but its children come from it
    std::size_t keyframes = 0;
    std::size_t memory = 0;       ///< bytes
    std::size_t on_disk = 0;      ///< bytes
    DescriptionPtr before, after; ///< what its first change changed; null for a root and a fork without a change
};

/// A range of frames of the line shown, both included.
struct FrameRange {
    std::uint64_t first = 0, last = 0;
};

/// A change on the line shown.
struct ChangeInfo {
    std::uint64_t step = 0, frame = 0;
    int substep = 0;
    BranchId branch = 0;
    DescriptionPtr before, after;
};

struct MarkInfo : Mark {
    BranchId branch = 0;
};

struct Overview {
    std::uint64_t version = 0;        ///< another one, another timeline
    std::vector<BranchInfo> branches; ///< each after its parent, siblings by age
    std::vector<Bookmark> bookmarks;
    BranchId line = 0; ///< the branch shown; what follows is of it and its ancestors
    std::uint64_t end_step = 0, end_frame = 0;
    double end_time = 0;                  ///< s
    double frames_per_second = 90;        ///< of the description in force
    std::vector<FrameRange> reachable;    ///< ascending
    std::vector<std::uint64_t> keyframes; ///< frames with a stored state, ascending
    std::vector<ChangeInfo> changes;
    std::vector<MarkInfo> marks;
    std::vector<Sample> samples;        ///< ascending by frame, with gaps where states have been dropped
    std::size_t memory = 0, budget = 0; ///< bytes
    std::size_t on_disk = 0, disk = 0;  ///< bytes
    std::string disk_trouble;           ///< Timeline::disk_trouble
    double least_reach_s = 0;           ///< CacheOptions
};

/// Where the playhead is.
struct Playhead {
    Moment moment;
    std::uint64_t frame = 0;
    int substep = 0, substeps = 1;
    double time = 0; ///< s
    bool at_end = true;
    bool operator==(const Playhead&) const = default;
};

Overview overview(const Player& player);
Playhead playhead(const Player& player);

} // namespace clothlab::timeline
