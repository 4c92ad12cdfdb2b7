#include "timeline/reader.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace clothlab::timeline {
namespace {

/// Steps between states that are kept within a frame: saving one takes about as long as a step.
constexpr std::uint64_t between_passed = 5;

} // namespace

void Reader::take(const DescriptionPtr& description, const std::vector<std::byte>* state) {
    const bool fits = state && simulation_ && can_change_live(simulation_->description(), *description);
    if (!fits) {
        simulation_ = sim::Simulation::create(*description, execution_);
        simulation_->time_stages(observed_);
        simulation_->watch(observed_);
    } else if (simulation_->description() != *description) {
        simulation_->change(*description);
    }
    description_ = description;
    if (state)
        simulation_->load_state(*state);
}

void Reader::change(const DescriptionPtr& description) {
    simulation_->change(*description);
    description_ = description;
}

void Reader::check_revision(const Timeline& timeline) {
    if (std::exchange(revision_, timeline.revision()) == timeline.revision())
        return;
    at_ = {};
    passed_.clear();
    passed_bytes_ = 0;
}

const Reader::Passed* Reader::passed_before(const Moment& moment, std::uint64_t from) const {
    const Passed* best = nullptr;
    for (const Passed& passed : passed_)
        if (passed.moment.branch == moment.branch && passed.moment.step >= from && passed.moment.step <= moment.step &&
            (!best || passed.moment.step > best->moment.step))
            best = &passed;
    return best;
}

void Reader::pass() {
    const auto same = [&](const Passed& p) { return p.moment == at_; };
    if (std::any_of(passed_.begin(), passed_.end(), same))
        return;
    passed_.push_back({at_, description_, simulation_->save_state()});
    passed_bytes_ += passed_.back().state.size();
    while (passed_bytes_ > most_passed_bytes_ && !passed_.empty()) {
        passed_bytes_ -= passed_.front().state.size();
        passed_.pop_front();
    }
}

void Reader::seek(const Timeline& timeline, const Moment& moment) {
    check_revision(timeline);
    if (!timeline.find(moment.branch))
        throw std::out_of_range("there is no branch " + std::to_string(moment.branch));
    const Branch& owner = timeline.owner(moment);
    const Keyframe* keyframe = keyframe_before(owner, moment.step);
    if (!keyframe)
        throw std::out_of_range("step " + std::to_string(moment.step) + " is not in the cache");
    const Moment target{owner.id, moment.step};
    const bool back = at_.branch == owner.id && at_.step > target.step &&
                      at_.step - target.step <= static_cast<std::uint64_t>(frame_time(owner, at_.step).substeps);

    // From the nearest of: where the simulation is, a state on the way of an earlier seek, the stored state.
    const Passed* passed = passed_before(target, keyframe->step);
    const bool from_here = at_.branch == owner.id && at_.step <= target.step && at_.step >= keyframe->step &&
                           (!passed || at_.step >= passed->moment.step);
    if (!from_here) {
        at_ = {}; // should the state turn out to be damaged
        if (passed) {
            take(passed->description, &passed->state);
            at_ = passed->moment;
        } else {
            if (keyframe->state) {
                const std::vector<std::byte> state = expand_state(keyframe->state->compressed());
                take(keyframe->description, &state);
            } else {
                take(keyframe->description, nullptr);
                for (const Change& made : owner.changes)
                    if (made.step == keyframe->step)
                        change(made.description);
            }
            at_ = {owner.id, keyframe->step};
        }
    }
    // Who goes back by one is likely to go on doing so: through the frames, or through the steps of this one.
    const FrameTime time = frame_time(owner, target.step);
    const std::uint64_t frame_begin = target.step - static_cast<std::uint64_t>(time.substep);
    std::uint64_t passed_at = at_.step;
    auto next = std::upper_bound(owner.changes.begin(), owner.changes.end(), at_.step,
                                 [](std::uint64_t s, const Change& c) { return s < c.step; });
    while (at_.step < target.step) {
        const bool within = time.substep > 0 && at_.step >= frame_begin && at_.step >= passed_at + between_passed;
        if (back && (simulation_->substep() == 0 || within)) {
            pass();
            passed_at = at_.step;
        }
        simulation_->step();
        ++at_.step;
        for (; next != owner.changes.end() && next->step == at_.step; ++next)
            change(next->description);
    }
}

sim::StepCounts Reader::step(const Timeline& timeline, BranchId line) {
    const sim::StepCounts counts = simulation_->step();
    const std::uint64_t step = simulation_->steps();
    // Where a branch begins, its parent's changes come before its own.
    const std::vector<const Branch*> branches = timeline.line(line);
    for (std::size_t i = branches.size(); i-- > 0;) {
        const Branch& branch = *branches[i];
        if (step < branch.fork_step || (i > 0 && step > branches[i - 1]->fork_step))
            continue;
        const auto begin = std::lower_bound(branch.changes.begin(), branch.changes.end(), step,
                                            [](const Change& c, std::uint64_t s) { return c.step < s; });
        for (auto made = begin; made != branch.changes.end() && made->step == step; ++made)
            change(made->description);
    }
    check_revision(timeline);
    at_ = {timeline.owner({line, step}).id, step};
    return counts;
}

} // namespace clothlab::timeline
