#include "ui/frame_axis.h"

#include <algorithm>
#include <cmath>

namespace clothlab::ui {

FrameAxis::FrameAxis(const timeline::Overview& overview, const timeline::Playhead& playhead)
    : end_step_(overview.end_step) {
    const auto stepping = [](const timeline::DescriptionPtr& d) { return d ? &d->stepping : nullptr; };
    Part part{0, 0, 0, std::max(playhead.substeps, 1), overview.frames_per_second};
    if (!overview.changes.empty())
        if (const sim::Stepping* s = stepping(overview.changes.front().before))
            part.substeps = s->substeps, part.frames_per_second = s->frames_per_second;
    parts_.push_back(part);
    for (const timeline::ChangeInfo& change : overview.changes) {
        const sim::Stepping* s = stepping(change.after);
        if (!s || (s->substeps == part.substeps && s->frames_per_second == part.frames_per_second))
            continue;
        const double time =
            part.time + static_cast<double>(change.step - part.step) / (part.substeps * part.frames_per_second);
        // A frame that has fewer steps now than were taken is over.
        const double fraction = std::min(static_cast<double>(change.substep) / s->substeps, 1.0);
        part = {change.step, static_cast<double>(change.frame) + fraction, time, s->substeps, s->frames_per_second};
        if (parts_.back().step == part.step)
            parts_.back() = part;
        else
            parts_.push_back(part);
    }
}

double FrameAxis::frame_of(std::uint64_t step) const {
    auto after = std::upper_bound(parts_.begin() + 1, parts_.end(), step,
                                  [](std::uint64_t s, const Part& part) { return s < part.step; });
    const Part& part = *(after - 1);
    return part.frame + static_cast<double>(step - part.step) / part.substeps;
}

const FrameAxis::Part& FrameAxis::part_with(double frame) const {
    auto after = std::upper_bound(parts_.begin() + 1, parts_.end(), frame,
                                  [](double f, const Part& part) { return f < part.frame; });
    return *(after - 1);
}

std::uint64_t FrameAxis::step_of(double frame) const {
    const Part& part = part_with(frame);
    const double steps = std::round((frame - part.frame) * part.substeps);
    return steps <= 0 ? part.step : std::min(part.step + static_cast<std::uint64_t>(steps), end_step_);
}

double FrameAxis::time_of(double frame) const {
    const Part& part = part_with(frame);
    return part.time + (frame - part.frame) / part.frames_per_second;
}

double FrameAxis::frame_at(double time) const {
    auto after = std::upper_bound(parts_.begin() + 1, parts_.end(), time,
                                  [](double t, const Part& part) { return t < part.time; });
    const Part& part = *(after - 1);
    return part.frame + (time - part.time) * part.frames_per_second;
}

int FrameAxis::substeps_at(double frame) const {
    return part_with(frame).substeps;
}

bool on_line(const timeline::Overview& overview, const timeline::Moment& moment) {
    const auto find = [&](timeline::BranchId id) {
        return std::find_if(overview.branches.begin(), overview.branches.end(),
                            [id](const timeline::BranchInfo& b) { return b.id == id; });
    };
    // The branch that owns the step: what comes before a fork is the parent's.
    auto owner = find(moment.branch);
    while (owner != overview.branches.end() && owner->parent != 0 && moment.step <= owner->fork_step)
        owner = find(owner->parent);
    if (owner == overview.branches.end())
        return false;
    std::uint64_t until = overview.end_step;
    for (auto branch = find(overview.line); branch != overview.branches.end(); branch = find(branch->parent)) {
        if (branch->id == owner->id)
            return moment.step <= until;
        until = branch->fork_step;
    }
    return false;
}

double round_step(double least) {
    const double unit = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * unit >= least * (1 - 1e-9))
            return factor * unit;
    return 10 * unit;
}

} // namespace clothlab::ui
