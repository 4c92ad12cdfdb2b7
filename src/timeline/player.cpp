#include "timeline/player.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace clothlab::timeline {
namespace {

/// States are stored so close that a seek takes this share of what it may; the rest is for the steps within a frame and
/// for thinning out.
constexpr double stored_share = 0.25;
/// Of the budget, for states on the way of a seek.
constexpr std::size_t way_share = 8;
constexpr std::uint64_t widest_stride = 16; ///< frames
/// Of the newest frame in the mean cost of a frame.
constexpr double newest_share = 0.02;
/// Growth of the strain, relative to the largest so far, that makes a new peak.
constexpr double new_peak = 1.001;

double sum(const sim::StageSeconds& seconds) {
    return std::accumulate(seconds.begin(), seconds.end(), 0.0);
}

std::string sentence(const char* format, double value) {
    char text[96];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

} // namespace

Player::Player(const CacheOptions& options, const sim::Execution& execution) : Reader(execution) {
    observed_ = true;
    set_options(options);
}

void Player::start(const sim::Description& description) {
    if (line_ != 0) {
        const Branch& branch = *timeline_.find(line_);
        if (branch.parent == 0 && branch.changes.empty() && *branch.start == description &&
            timeline_.reachable({line_, 0})) {
            seek(0);
            return;
        }
    }
    auto begin = std::make_shared<const sim::Description>(description);
    take(begin, nullptr);
    const sim::Stepping& stepping = description.stepping;
    FrameClock clock;
    clock.substeps = stepping.substeps;
    clock.dt = 1 / (stepping.frames_per_second * stepping.substeps);
    line_ = timeline_.add_root(begin, clock);
    seconds_per_frame_ = 0;
    timed_frames_ = 0;
    timeline_.store(line_, {0, 0, begin, nullptr, false});
    at_ = {};
    begin_branch();
}

void Player::clear() {
    timeline_.clear();
    simulation_.reset();
    description_.reset();
    line_ = 0;
    before_change_.reset();
    ++version_;
}

void Player::begin_branch() {
    found_ = {};
    for_line([&](const Branch& branch, std::uint64_t last) {
        for (const Mark& mark : branch.marks)
            if (mark.step <= last)
                found_[static_cast<std::size_t>(mark.kind)] = true;
    });
    frame_ = {};
    before_change_.reset();
    ++version_;
}

void Player::put_clock(Branch& branch) {
    const sim::Stepping& stepping = description_->stepping;
    const std::uint64_t step = simulation_->steps();
    while (!branch.clocks.empty() && branch.clocks.back().step == step)
        branch.clocks.pop_back();
    branch.clocks.push_back({step, simulation_->frame(), simulation_->substep(), stepping.substeps, simulation_->time(),
                             1 / (stepping.frames_per_second * stepping.substeps)});
}

void Player::store_state(Branch& branch, bool kept) {
    const std::uint64_t step = simulation_->steps();
    const Keyframe* there = keyframe_before(branch, step);
    if (there && there->step == step && !there->state)
        return; // the start of a run needs none
    since_stored_s_ = 0;
    timeline_.store(branch.id,
                    {step, step, description_, keep_in_memory(compress_state(simulation_->save_state())), kept});
}

void Player::change(const sim::Description& description) {
    if (!can_change_live(simulation_->description(), description))
        return start(description);
    const auto next = std::make_shared<const sim::Description>(description);
    const Moment here = moment();
    if (!before_change_ || before_change_->moment != here) {
        if (description == *description_)
            return;
        BeforeChange before{here, line_, description_, simulation_->save_state(), {}};
        Reader::change(next);
        if (!at_end()) {
            line_ = timeline_.add_fork(here, before.description);
            begin_branch();
        }
        before.moment.branch = line_;
        before_change_ = std::move(before);
    } else {
        // In place of the last change, as if that had not been.
        const DescriptionPtr last = description_;
        take(before_change_->description, &before_change_->state);
        if (description == *before_change_->description) {
            Branch& branch = *timeline_.find(line_);
            if (before_change_->line != line_) {
                timeline_.remove(std::exchange(line_, before_change_->line));
                begin_branch();
                return;
            }
            if (before_change_->recorded)
                branch.changes.pop_back();
            before_change_->recorded = false;
            finish_change(branch);
            return;
        }
        try {
            Reader::change(next);
        } catch (...) {
            Reader::change(last);
            throw;
        }
        if (before_change_->recorded)
            timeline_.find(line_)->changes.pop_back();
    }
    Branch& branch = *timeline_.find(line_);
    branch.changes.push_back({here.step, next});
    before_change_->recorded = true;
    finish_change(branch);
}

void Player::finish_change(Branch& branch) {
    put_clock(branch);
    const std::uint64_t step = simulation_->steps();
    const Keyframe* there = keyframe_before(branch, step);
    if (step == branch.fork_step || (there && there->step == step))
        store_state(branch, false);
    timeline_.revise();
    frame_ = {};
    ++version_;
    timeline_.fit();
}

bool Player::at_end() const {
    const Branch* branch = timeline_.find(line_);
    return branch && simulation_ && branch->end == simulation_->steps();
}

sim::StepCounts Player::step() {
    before_change_.reset();
    if (at_end())
        return record();
    frame_ = {};
    const std::uint64_t next = simulation_->steps() + 1;
    if (!timeline_.reachable({line_, next})) {
        seek(timeline_.next_reachable({line_, next}));
        return {};
    }
    return Reader::step(timeline_, line_);
}

sim::StepCounts Player::record() {
    Branch& branch = *timeline_.find(line_);
    if (frame_.steps == 0) {
        frame_.seconds = simulation_->stage_seconds();
        since_stored_s_ = static_cast<double>(branch.end - branch.keyframes.back().step) * seconds_per_frame_ /
                          description_->stepping.substeps;
    }
    const std::uint64_t frame = simulation_->frame();
    const double before_s = sum(simulation_->stage_seconds());
    const sim::StepCounts counts = simulation_->step();
    const double step_s = sum(simulation_->stage_seconds()) - before_s;
    since_stored_s_ += step_s;
    branch.end = simulation_->steps();
    branch.stem = false;
    branch.keyframes.back().until = branch.end;
    at_ = {line_, branch.end};
    ++frame_.steps;
    frame_.contacts = std::max(frame_.contacts, static_cast<std::uint32_t>(counts.contacts));
    frame_.self_contacts = std::max(frame_.self_contacts, static_cast<std::uint32_t>(counts.self_contacts));
    frame_.shortened_springs = std::max(frame_.shortened_springs, static_cast<std::uint32_t>(counts.shortened_springs));
    look_for_marks(branch, counts);
    if (simulation_->frame() != frame)
        end_frame(branch);
    else
        store_within_frame(branch, step_s);
    ++version_;
    return counts;
}

void Player::end_frame(Branch& branch) {
    const sim::Diagnostics diagnostics = simulation_->diagnose();
    Sample sample;
    sample.frame = simulation_->frame();
    sample.time = simulation_->time();
    sample.kinetic = static_cast<float>(diagnostics.energy.kinetic);
    sample.spring = static_cast<float>(diagnostics.energy.spring);
    sample.gravity = static_cast<float>(diagnostics.energy.gravity);
    sample.max_strain = static_cast<float>(diagnostics.max_strain);
    sample.contacts = frame_.contacts;
    sample.self_contacts = frame_.self_contacts;
    sample.shortened_springs = frame_.shortened_springs;
    sim::StageSeconds spent = simulation_->stage_seconds();
    for (std::size_t i = 0; i < spent.size(); ++i) {
        spent[i] = (spent[i] - frame_.seconds[i]) / frame_.steps;
        sample.stage_seconds[i] = static_cast<float>(spent[i]);
    }
    branch.samples.push_back(sample);
    look_for_peak(branch);
    frame_ = {};

    const double cost = sum(spent) * description_->stepping.substeps;
    seconds_per_frame_ += std::max(newest_share, 1.0 / ++timed_frames_) * (cost - seconds_per_frame_);
    const double stride = cost > 0 ? stored_share * timeline_.options().seek_s / seconds_per_frame_ : 1;
    const auto frames = std::clamp<std::uint64_t>(static_cast<std::uint64_t>(std::min(stride, 1e6)), 1, widest_stride);
    const std::uint64_t stored = frame_time(branch, branch.keyframes.back().step).frame;
    if (sample.frame - stored >= frames) {
        store_state(branch, false);
        timeline_.fit();
    }
}

void Player::store_within_frame(Branch& branch, double step_s) {
    if (since_stored_s_ + step_s <= slow_frame * timeline_.options().seek_s)
        return;
    store_state(branch, false);
    timeline_.fit();
}

void Player::mark(Branch& branch, MarkKind kind, double value, std::string text) {
    found_[static_cast<std::size_t>(kind)] = true;
    branch.marks.push_back({kind, simulation_->steps(), simulation_->frame(), value, std::move(text)});
    timeline_.refresh_kept(branch.id);
}

void Player::look_for_marks(Branch& branch, const sim::StepCounts& counts) {
    const auto found = [&](MarkKind kind) { return found_[static_cast<std::size_t>(kind)]; };
    if (counts.contacts != 0 && !found(MarkKind::first_contact))
        mark(branch, MarkKind::first_contact, 0,
             sentence("The cloth touches a collider for the first time, with %.0f of its points.",
                      static_cast<double>(counts.contacts)));
    if (counts.self_contacts != 0 && !found(MarkKind::first_self_contact))
        mark(branch, MarkKind::first_self_contact, 0, "The cloth touches itself for the first time.");
    if (counts.shortened_springs != 0 && !found(MarkKind::limit_active))
        mark(branch, MarkKind::limit_active, 0,
             sentence("The stretch limit shortens springs for the first time: %.0f of them.",
                      static_cast<double>(counts.shortened_springs)));
    const std::optional<sim::Trouble>& trouble = simulation_->trouble();
    if (!trouble)
        return;
    const MarkKind kind = trouble->status == sim::Status::diverged ? MarkKind::blow_up : MarkKind::jitter;
    if (found(kind) || found(MarkKind::blow_up))
        return;
    branch.trouble = *trouble;
    branch.trouble_step = simulation_->steps();
    mark(branch, kind, 0, trouble->cause);
}

void Player::look_for_peak(Branch& branch) {
    const Sample& sample = branch.samples.back();
    if (!std::isfinite(sample.max_strain) || sample.max_strain <= 0)
        return;
    bool higher = true;
    for_line([&](const Branch& b, std::uint64_t last) {
        for (const Mark& m : b.marks)
            if (m.kind == MarkKind::peak_strain && m.step <= last)
                higher = higher && sample.max_strain > new_peak * m.value;
    });
    if (!higher)
        return;
    std::erase_if(branch.marks, [](const Mark& m) { return m.kind == MarkKind::peak_strain; });
    mark(branch, MarkKind::peak_strain, sample.max_strain,
         sentence("The largest strain so far: %.3g %%.", 100.0 * static_cast<double>(sample.max_strain)));
}

const sim::Trouble* Player::trouble() const {
    const std::uint64_t step = simulation_ ? simulation_->steps() : 0;
    const sim::Trouble* first = nullptr;
    if (line_ != 0)
        for_line([&](const Branch& branch, std::uint64_t last) {
            if (branch.trouble && branch.trouble_step <= std::min(step, last))
                first = &*branch.trouble;
        });
    return first;
}

bool Player::seek(std::uint64_t step) {
    const std::uint64_t nearest = timeline_.nearest_reachable({line_, step});
    Reader::seek(timeline_, {line_, nearest});
    before_change_.reset();
    frame_ = {};
    return nearest == step;
}

void Player::switch_to(BranchId line) {
    if (!timeline_.find(line))
        throw std::out_of_range("there is no branch " + std::to_string(line));
    const std::uint64_t step = simulation_->steps();
    const BranchId before = std::exchange(line_, line);
    try {
        seek(step);
    } catch (...) {
        line_ = before;
        throw;
    }
    begin_branch();
}

void Player::go_to(const Moment& moment) {
    const Branch& owner = timeline_.owner(moment);
    if (timeline_.owner({line_, moment.step}).id == owner.id && moment.step <= timeline_.find(line_)->end) {
        seek(moment.step);
        return;
    }
    const BranchId before = std::exchange(line_, owner.id);
    try {
        seek(moment.step);
    } catch (...) {
        line_ = before;
        throw;
    }
    begin_branch();
}

std::uint32_t Player::bookmark(std::string name, std::optional<scene::Camera> camera) {
    const BranchId owner = timeline_.owner(moment()).id;
    const std::uint32_t id = timeline_.add_bookmark(moment(), std::move(name), std::move(camera));
    store_state(*timeline_.find(owner), true);
    timeline_.fit();
    ++version_;
    return id;
}

void Player::rename_bookmark(std::uint32_t id, std::string name) {
    timeline_.rename_bookmark(id, std::move(name));
    ++version_;
}

void Player::remove_bookmark(std::uint32_t id) {
    const Bookmark* bookmark = timeline_.find_bookmark(id);
    const BranchId branch = bookmark ? bookmark->moment.branch : 0;
    timeline_.remove_bookmark(id);
    timeline_.refresh_kept(branch);
    ++version_;
}

void Player::rename_branch(BranchId id, std::string name) {
    timeline_.rename(id, std::move(name));
    ++version_;
}

void Player::remove_branch(BranchId id) {
    const Branch* branch = timeline_.find(id);
    if (!branch)
        return;
    if (id == line_) {
        BranchId other = branch->parent;
        for (const Branch& candidate : timeline_.branches())
            if (other == 0 && candidate.id != id && !candidate.stem)
                other = candidate.id;
        if (other == 0)
            throw std::invalid_argument("The only branch cannot be removed.");
        switch_to(other);
    }
    timeline_.remove(id);
    if (!timeline_.find(line_)) // it was a stem, for this branch alone
        line_ = timeline_.branches().front().id;
    begin_branch();
}

void Player::adopt(Timeline timeline, const Moment& at) {
    timeline.set_options(timeline_.options());
    const BranchId before_line = std::exchange(line_, at.branch);
    std::swap(timeline_, timeline);
    const Moment before{before_line, simulation_ ? simulation_->steps() : 0};
    try {
        seek(at.step);
    } catch (...) {
        std::swap(timeline_, timeline);
        line_ = before_line;
        if (line_ != 0)
            Reader::seek(timeline_, before);
        throw;
    }
    begin_branch();
    timeline_.fit();
}

void Player::set_options(const CacheOptions& options) {
    options_ = options;
    most_passed_bytes_ = options.budget / way_share;
    CacheOptions stored = options;
    stored.budget -= most_passed_bytes_;
    timeline_.set_options(stored);
    timeline_.fit();
    ++version_;
}

} // namespace clothlab::timeline
