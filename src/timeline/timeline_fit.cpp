// How a timeline keeps within its budget.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include "timeline/step_costs.h"
#include "timeline/timeline.h"

namespace clothlab::timeline {
namespace {

/// Freed beyond what is needed, as a share of the budget, so that fitting is done now and then, not for every state. Of
/// the disk, so that there is room for the ends of states that fill no whole grain.
constexpr double slack = 0.03;
/// Bytes of a state that is worth a place on the disk.
constexpr std::size_t least_moved = 1024;
/// How much slower than wanted a seek may become before states within the least reach are dropped.
constexpr double slowest = 4;
/// In steps of which it becomes that.
constexpr double widening = 1.125;

/// Simulated seconds that are reached from a state.
double span_s(const Branch& branch, const Keyframe& keyframe) {
    return frame_time(branch, keyframe.until).time - frame_time(branch, keyframe.step).time;
}

std::size_t but_slack(std::size_t bytes) {
    return static_cast<std::size_t>(static_cast<double>(bytes) * (1 - slack));
}

} // namespace

Timeline::Gap Timeline::widest_gap(double frame_s, double slower) const {
    const double seconds = slower * options_.seek_s, frames = frame_s > 0 ? std::floor(seconds / frame_s) : 1;
    if (frames >= 1)
        return {static_cast<std::uint64_t>(std::min(frames, 1e6)), seconds};
    // Single frames, or states within them. Whoever takes slower seeks takes those over a frame.
    return {1, slower > 1 ? std::numeric_limits<double>::infinity() : slow_frame * seconds};
}

bool Timeline::helps(const Keyframe& keyframe, const Room& room, std::size_t memory) const {
    if (!keyframe.state)
        return false;
    return memory + on_disk_ > room.both ||
           (timeline::on_disk(keyframe) > 0 ? on_disk_ > room.disk : memory > room.memory);
}

template <class GapOf>
void Timeline::thin(const Room& room, const std::vector<StepCosts>& costs, GapOf gap_of) {
    std::size_t now = memory();
    for (std::size_t b = 0; b < branches_.size(); ++b) {
        const Branch& branch = branches_[b];
        const Gap gap = gap_of(costs[b]);
        const auto may_go = [&](const Keyframe& before, const Keyframe& keyframe) {
            if (keyframe.kept || before.until != keyframe.step || !helps(keyframe, room, now))
                return false;
            const FrameTime from = timeline::frame_time(branch, before.step);
            const FrameTime to = timeline::frame_time(branch, keyframe.until);
            return to.frame + (to.substep != 0 ? 1u : 0u) - from.frame <= gap.frames &&
                   costs[b].between_s(before.step, keyframe.until) <= gap.seconds;
        };
        std::vector<Keyframe>& list = branches_[b].keyframes;
        std::size_t kept = std::min<std::size_t>(list.size(), 1); // that many have been looked at and stay
        for (std::size_t i = 1; i < list.size(); ++i) {
            Keyframe& before = list[kept - 1];
            if (over(room, now) && i + 1 < list.size() && may_go(before, list[i])) {
                before.until = list[i].until;
                now -= timeline::memory(list[i]);
                discount(list[i]);
            } else if (kept++ != i) {
                list[kept - 1] = std::move(list[i]);
            }
        }
        list.resize(kept);
    }
}

void Timeline::drop(const Room& room, bool kept_too, double least_reach_s) {
    std::size_t now = memory();
    double reach = reach_s();
    for (Branch& branch : branches_) {
        if (!over(room, now))
            return;
        std::vector<Keyframe>& list = branch.keyframes;
        const std::size_t before = list.size();
        std::size_t left = 0;
        for (std::size_t i = 0; i < list.size(); ++i) {
            // What is at a branch's end is where it goes on.
            bool goes = i + 1 < before && (kept_too || !list[i].kept) && helps(list[i], room, now);
            const double span = goes ? span_s(branch, list[i]) : 0;
            goes = goes && reach - span >= least_reach_s;
            if (goes) {
                now -= timeline::memory(list[i]);
                discount(list[i]);
                reach -= span;
            } else if (left++ != i) {
                list[left - 1] = std::move(list[i]);
            }
        }
        list.resize(left);
        if (left == before)
            continue;
        now -= memory_but_keyframes(branch);
        forget_unreachable(branch);
        now += memory_but_keyframes(branch);
    }
}

void Timeline::forget_unreachable(Branch& branch) {
    const auto lies_in = [](const Keyframe& k, std::uint64_t step) { return k.step <= step && step <= k.until; };
    // Keyframes, changes, clocks and samples all ascend: one walk over each.
    const auto forget = [&](auto& list, auto step_of, auto needed) {
        std::size_t k = 0;
        std::erase_if(list, [&](const auto& entry) {
            const std::uint64_t step = step_of(entry);
            while (k + 1 < branch.keyframes.size() && branch.keyframes[k + 1].step <= step)
                ++k;
            return !needed(step, k);
        });
    };
    const auto reached = [&](std::uint64_t step, std::size_t k) {
        return !branch.keyframes.empty() && lies_in(branch.keyframes[k], step);
    };
    forget(
        branch.samples, [&](const Sample& s) { return timeline::step_of_frame(branch, s.frame); }, reached);
    forget(
        branch.changes, [](const Change& c) { return c.step; }, reached);
    // A clock counts until the next one.
    std::vector<FrameClock> clocks;
    for (std::size_t i = 0; i < branch.clocks.size(); ++i) {
        const std::uint64_t from = branch.clocks[i].step;
        const bool last = i + 1 == branch.clocks.size();
        const bool needed =
            i == 0 || last || std::any_of(branch.keyframes.begin(), branch.keyframes.end(), [&](const Keyframe& k) {
                return k.until >= from && k.step < branch.clocks[i + 1].step;
            });
        if (needed)
            clocks.push_back(branch.clocks[i]);
    }
    branch.clocks = std::move(clocks);
}

double Timeline::reach_s() const {
    double sum = 0;
    for (const Branch& branch : branches_)
        for (const Keyframe& keyframe : branch.keyframes)
            sum += span_s(branch, keyframe);
    return sum;
}

void Timeline::fit() {
    if (!over({.memory = options_.budget, .disk = disk_most_}))
        return;
    const std::size_t most = but_slack(options_.budget);
    const Room room{.memory = most, .disk = disk_most_};
    std::vector<StepCosts> costs(branches_.begin(), branches_.end());
    // Gaps that fit into the next wider one a whole number of times, or that could not be reached.
    int most_halvings = 0;
    for (const StepCosts& cost : costs)
        most_halvings = std::max(most_halvings, std::countr_zero(widest_gap(cost.frame_s(), 1).frames));
    for (int halvings = most_halvings; over(room) && halvings >= 0; --halvings)
        thin(room, costs, [&](const StepCosts& cost) {
            Gap gap = widest_gap(cost.frame_s(), 1);
            gap.frames >>= std::min(halvings, std::countr_zero(gap.frames));
            return gap;
        });
    // A disk that cannot take what it should has as much room as it had so far.
    bool moved = false;
    for (int attempt = 0; attempt < 2 && !moved; ++attempt) {
        make_room({.disk = disk_most_, .both = most + but_slack(disk_most_)});
        moved = move_to_disk(most);
    }
    make_room({.memory = most});
}

void Timeline::make_room(const Room& room) {
    if (options_.least_reach_s > 0) {
        drop(room, false, options_.least_reach_s);
        for (double slower = widening; over(room) && slower <= slowest; slower *= widening) {
            const std::vector<StepCosts> costs(branches_.begin(), branches_.end());
            thin(room, costs, [&](const StepCosts& cost) { return widest_gap(cost.frame_s(), slower); });
        }
    }
    for (const bool kept_too : {false, true})
        drop(room, kept_too, 0);
}

bool Timeline::move_to_disk(std::size_t most) {
    const std::size_t all_else = memory() - stored_;
    try {
        for (Branch& branch : branches_)
            for (Keyframe& keyframe : branch.keyframes) {
                if (all_else + stored_ <= most)
                    return true;
                const StoredStatePtr& state = keyframe.state;
                if (!state || state->on_disk() > 0 || state->memory() < least_moved)
                    continue;
                if (on_disk_ + state->memory() > disk_most_)
                    return true;
                if (!scratch_)
                    scratch_ =
                        ScratchFile::make(options_.disk_folder.empty() ? scratch_folder() : options_.disk_folder);
                const StoredStatePtr moved = scratch_->keep(state->compressed());
                discount(keyframe);
                keyframe.state = moved;
                count(keyframe);
            }
        return true;
    } catch (const std::system_error& e) {
        disk_trouble_ = e.what();
        disk_most_ = on_disk_;
        return false;
    }
}

} // namespace clothlab::timeline
