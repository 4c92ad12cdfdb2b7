// How a timeline keeps within its budget.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "timeline/step_costs.h"
#include "timeline/timeline.h"

namespace clothlab::timeline {
namespace {

/// Freed beyond what is needed, as a share of the budget, so that fitting is done now and then, not for every state.
constexpr double slack = 0.03;
/// How much slower than wanted a seek may become before states within the least reach are dropped.
constexpr double slowest = 4;
/// In steps of which it becomes that.
constexpr double widening = 1.125;

/// Simulated seconds that are reached from a state.
double span_s(const Branch& branch, const Keyframe& keyframe) {
    return frame_time(branch, keyframe.until).time - frame_time(branch, keyframe.step).time;
}

} // namespace

Timeline::Gap Timeline::widest_gap(double frame_s, double slower) const {
    const double seconds = slower * options_.seek_s, frames = frame_s > 0 ? std::floor(seconds / frame_s) : 1;
    if (frames >= 1)
        return {static_cast<std::uint64_t>(std::min(frames, 1e6)), seconds};
    // Single frames, or states within them. Whoever takes slower seeks takes those over a frame.
    return {1, slower > 1 ? std::numeric_limits<double>::infinity() : slow_frame * seconds};
}

template <class GapOf>
void Timeline::thin(std::size_t most, const std::vector<StepCosts>& costs, GapOf gap_of) {
    std::size_t now = memory();
    for (std::size_t b = 0; b < branches_.size(); ++b) {
        const Branch& branch = branches_[b];
        const Gap gap = gap_of(costs[b]);
        const auto may_go = [&](const Keyframe& before, const Keyframe& keyframe) {
            if (keyframe.kept || !keyframe.state || before.until != keyframe.step)
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
            if (now > most && i + 1 < list.size() && may_go(before, list[i])) {
                before.until = list[i].until;
                now -= timeline::memory(list[i]), stored_ -= timeline::memory(list[i]);
            } else if (kept++ != i) {
                list[kept - 1] = std::move(list[i]);
            }
        }
        list.resize(kept);
    }
}

void Timeline::drop(std::size_t most, bool kept_too, double least_reach_s) {
    std::size_t now = memory();
    double reach = reach_s();
    for (Branch& branch : branches_) {
        if (now <= most)
            return;
        std::vector<Keyframe>& list = branch.keyframes;
        const std::size_t before = list.size();
        std::size_t left = 0;
        for (std::size_t i = 0; i < list.size(); ++i) {
            // What is at a branch's end is where it goes on.
            bool goes = now > most && i + 1 < before && list[i].state && (kept_too || !list[i].kept);
            const double span = goes ? span_s(branch, list[i]) : 0;
            goes = goes && reach - span >= least_reach_s;
            if (goes)
                now -= timeline::memory(list[i]), stored_ -= timeline::memory(list[i]), reach -= span;
            else if (left++ != i)
                list[left - 1] = std::move(list[i]);
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
    if (memory() <= options_.budget)
        return;
    const auto most = static_cast<std::size_t>(static_cast<double>(options_.budget) * (1 - slack));
    std::vector<StepCosts> costs(branches_.begin(), branches_.end());
    // Gaps that fit into the next wider one a whole number of times, or that could not be reached.
    int most_halvings = 0;
    for (const StepCosts& cost : costs)
        most_halvings = std::max(most_halvings, std::countr_zero(widest_gap(cost.frame_s(), 1).frames));
    for (int halvings = most_halvings; memory() > most && halvings >= 0; --halvings)
        thin(most, costs, [&](const StepCosts& cost) {
            Gap gap = widest_gap(cost.frame_s(), 1);
            gap.frames >>= std::min(halvings, std::countr_zero(gap.frames));
            return gap;
        });
    if (options_.least_reach_s > 0) {
        if (memory() > most)
            drop(most, false, options_.least_reach_s);
        for (double slower = widening; memory() > most && slower <= slowest; slower *= widening) {
            costs = {branches_.begin(), branches_.end()};
            thin(most, costs, [&](const StepCosts& cost) { return widest_gap(cost.frame_s(), slower); });
        }
    }
    for (const bool kept_too : {false, true})
        if (memory() > most)
            drop(most, kept_too, 0);
}

} // namespace clothlab::timeline
