#include "timeline/overview.h"

#include <algorithm>

namespace clothlab::timeline {
namespace {

BranchInfo info(const Timeline& timeline, const Branch& branch) {
    BranchInfo info;
    info.id = branch.id;
    info.name = branch.name;
    info.parent = branch.parent;
    info.depth = static_cast<int>(timeline.line(branch.id).size()) - 1;
    info.fork_step = branch.fork_step;
    info.fork_frame = frame_time(branch, branch.fork_step).frame;
    info.end_step = branch.end;
    const FrameTime end = frame_time(branch, branch.end);
    info.end_frame = end.frame;
    info.end_time = end.time;
    info.stem = branch.stem;
    info.keyframes = branch.keyframes.size();
    info.memory = memory(branch);
    info.on_disk = on_disk(branch);
    if (!branch.changes.empty() && branch.changes.front().step == branch.fork_step) {
        info.before = branch.start;
        info.after = branch.changes.front().description;
    }
    return info;
}

/// The branch and all that come from it, each after its parent.
void add_branches(const Timeline& timeline, const Branch& branch, std::vector<BranchInfo>& list) {
    list.push_back(info(timeline, branch));
    for (const Branch& child : timeline.branches())
        if (child.parent == branch.id)
            add_branches(timeline, child, list);
}

/// The frames of a line's ranges of reachable steps; neighbours become one.
std::vector<FrameRange> reachable_frames(const Timeline& timeline, BranchId line) {
    std::vector<FrameRange> ranges;
    timeline.for_reachable(line, [&](std::uint64_t first, std::uint64_t last) {
        // Of a frame the end counts, and of the frame under way what there is of it.
        const FrameTime from = timeline.frame_time({line, first}), to = timeline.frame_time({line, last});
        const FrameRange range{from.frame + (from.substep > 0 ? 1 : 0), to.frame};
        if (!ranges.empty() && range.last + 1 >= ranges.back().first)
            ranges.back().first = std::min(ranges.back().first, range.first);
        else if (range.first <= range.last)
            ranges.push_back(range);
    });
    std::reverse(ranges.begin(), ranges.end());
    return ranges;
}

} // namespace

Overview overview(const Player& player) {
    const Timeline& timeline = player.timeline();
    Overview o;
    o.version = player.version();
    for (const Branch& branch : timeline.branches())
        if (branch.parent == 0)
            add_branches(timeline, branch, o.branches);
    o.bookmarks = timeline.bookmarks();
    o.memory = player.memory();
    o.budget = player.options().budget;
    o.on_disk = timeline.on_disk();
    o.disk = player.options().disk;
    o.disk_trouble = timeline.disk_trouble();
    o.least_reach_s = player.options().least_reach_s;
    o.line = player.line();
    if (o.line == 0)
        return o;
    o.frames_per_second = player.description()->stepping.frames_per_second;

    std::vector<const Branch*> line = timeline.line(o.line);
    o.end_step = line.front()->end;
    const FrameTime end = timeline.frame_time({o.line, o.end_step});
    o.end_frame = end.frame;
    o.end_time = end.time;
    o.reachable = reachable_frames(timeline, o.line);
    std::reverse(line.begin(), line.end());
    for (std::size_t i = 0; i < line.size(); ++i) {
        const Branch& branch = *line[i];
        // Where the next branch of the line begins, this one's part of it ends.
        const bool whole = i + 1 == line.size();
        const std::uint64_t last = whole ? branch.end : line[i + 1]->fork_step;
        const std::uint64_t last_frame = frame_time(branch, last).frame;
        for (const Keyframe& keyframe : branch.keyframes)
            if (keyframe.step <= last)
                o.keyframes.push_back(frame_time(branch, keyframe.step).frame);
        DescriptionPtr before = branch.start;
        for (const Change& change : branch.changes) {
            if (change.step > last)
                break;
            const FrameTime time = frame_time(branch, change.step);
            o.changes.push_back({change.step, time.frame, time.substep, branch.id, before, change.description});
            before = change.description;
        }
        for (const Mark& mark : branch.marks)
            if (mark.step <= last)
                o.marks.push_back({mark, branch.id});
        const auto after = std::upper_bound(branch.samples.begin(), branch.samples.end(), last_frame,
                                            [](std::uint64_t f, const Sample& s) { return f < s.frame; });
        o.samples.insert(o.samples.end(), branch.samples.begin(), after);
    }
    o.keyframes.erase(std::unique(o.keyframes.begin(), o.keyframes.end()), o.keyframes.end());
    return o;
}

Playhead playhead(const Player& player) {
    Playhead p;
    if (!player.has_simulation())
        return p;
    const sim::Simulation& simulation = player.simulation();
    p.moment = player.moment();
    p.frame = simulation.frame();
    p.substep = simulation.substep();
    p.substeps = player.description()->stepping.substeps;
    p.time = simulation.time();
    p.at_end = player.at_end();
    return p;
}

} // namespace clothlab::timeline
