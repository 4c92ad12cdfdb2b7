#include "timeline/timeline.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <utility>

namespace clothlab::timeline {
namespace {

std::size_t bytes(const sim::Description& description) {
    return sizeof description + description.cloth.pinned.capacity() * sizeof(sim::GridPoint) +
           description.colliders.capacity() * sizeof(sim::Collider);
}

auto first_after(std::vector<Keyframe>& keyframes, std::uint64_t step) {
    return std::upper_bound(keyframes.begin(), keyframes.end(), step,
                            [](std::uint64_t s, const Keyframe& k) { return s < k.step; });
}

} // namespace

const Keyframe* keyframe_before(const Branch& branch, std::uint64_t step) {
    auto after = std::upper_bound(branch.keyframes.begin(), branch.keyframes.end(), step,
                                  [](std::uint64_t s, const Keyframe& k) { return s < k.step; });
    if (after == branch.keyframes.begin() || step > branch.end)
        return nullptr;
    const Keyframe& keyframe = *std::prev(after);
    return step <= keyframe.until ? &keyframe : nullptr;
}

std::size_t memory(const Keyframe& keyframe) {
    return sizeof keyframe + (keyframe.state ? keyframe.state->memory() : 0);
}

std::size_t on_disk(const Keyframe& keyframe) {
    return keyframe.state ? keyframe.state->on_disk() : 0;
}

std::size_t on_disk(const Branch& branch) {
    std::size_t sum = 0;
    for (const Keyframe& keyframe : branch.keyframes)
        sum += on_disk(keyframe);
    return sum;
}

std::size_t memory_but_keyframes(const Branch& branch) {
    std::size_t sum = sizeof branch + branch.samples.size() * sizeof(Sample) + branch.marks.size() * sizeof(Mark) +
                      branch.clocks.size() * sizeof(FrameClock);
    for (const Change& change : branch.changes)
        sum += sizeof change + bytes(*change.description);
    return sum;
}

std::size_t memory(const Branch& branch) {
    std::size_t sum = memory_but_keyframes(branch);
    for (const Keyframe& keyframe : branch.keyframes)
        sum += memory(keyframe);
    return sum;
}

const Branch* Timeline::find(BranchId id) const {
    const auto found = std::find_if(branches_.begin(), branches_.end(), [id](const Branch& b) { return b.id == id; });
    return found == branches_.end() ? nullptr : &*found;
}

Branch* Timeline::find(BranchId id) {
    return const_cast<Branch*>(std::as_const(*this).find(id));
}

const Branch& Timeline::owner(const Moment& moment) const {
    const Branch* branch = find(moment.branch);
    while (branch && branch->parent != 0 && moment.step < branch->fork_step)
        branch = find(branch->parent);
    if (!branch)
        throw std::out_of_range("there is no branch " + std::to_string(moment.branch));
    return *branch;
}

std::vector<const Branch*> Timeline::line(BranchId id) const {
    std::vector<const Branch*> line;
    for (const Branch* branch = find(id); branch; branch = find(branch->parent))
        line.push_back(branch);
    if (line.empty())
        throw std::out_of_range("there is no branch " + std::to_string(id));
    return line;
}

FrameTime Timeline::frame_time(const Moment& moment) const {
    return timeline::frame_time(owner(moment), moment.step);
}

std::uint64_t Timeline::step_of_frame(BranchId id, std::uint64_t frame) const {
    const std::vector<const Branch*> branches = line(id);
    for (const Branch* branch : branches) {
        const FrameClock& begin = branch->clocks.front();
        if (branch->parent != 0 && (frame < begin.frame || (frame == begin.frame && begin.substep > 0)))
            continue;
        return std::min(timeline::step_of_frame(*branch, frame), branches.front()->end);
    }
    return branches.back()->fork_step;
}

bool Timeline::reachable(const Moment& moment) const {
    return find(moment.branch) && keyframe_before(owner(moment), moment.step);
}

std::uint64_t Timeline::nearest_reachable(const Moment& moment) const {
    std::optional<std::uint64_t> best;
    for_reachable(moment.branch, [&](std::uint64_t first, std::uint64_t last) {
        const auto away = [&](std::uint64_t s) { return s > moment.step ? s - moment.step : moment.step - s; };
        const std::uint64_t step = std::clamp(moment.step, first, last);
        if (!best || away(step) < away(*best))
            best = step;
    });
    return best.value_or(find(moment.branch)->end);
}

std::uint64_t Timeline::next_reachable(const Moment& moment) const {
    std::uint64_t next = find(moment.branch)->end;
    for_reachable(moment.branch, [&](std::uint64_t first, std::uint64_t last) {
        if (last >= moment.step)
            next = std::min(next, std::max(first, moment.step));
    });
    return next;
}

std::optional<std::uint64_t> Timeline::previous_reachable(const Moment& moment) const {
    std::optional<std::uint64_t> previous;
    for_reachable(moment.branch, [&](std::uint64_t first, std::uint64_t last) {
        if (first <= moment.step)
            previous = std::max(previous.value_or(0), std::min(last, moment.step));
    });
    return previous;
}

void Timeline::revise() {
    static std::atomic<std::uint64_t> revisions = 0; // of all timelines, so that two of them never have the same
    revision_ = ++revisions;
}

BranchId Timeline::add_root(DescriptionPtr start, const FrameClock& clock, std::string name) {
    Branch branch;
    branch.id = next_branch_++;
    branch.name = name.empty() ? "Run " + std::to_string(branch.id) : std::move(name);
    branch.fork_step = branch.end = clock.step;
    branch.start = std::move(start);
    branch.clocks.push_back(clock);
    branches_.push_back(std::move(branch));
    return branches_.back().id;
}

BranchId Timeline::add_fork(const Moment& from, DescriptionPtr start, std::string name) {
    const Branch& parent = owner(from);
    Branch branch;
    branch.id = next_branch_++;
    branch.name = name.empty() ? "Branch " + std::to_string(branch.id) : std::move(name);
    branch.parent = parent.id;
    branch.fork_step = branch.end = from.step;
    branch.start = std::move(start);
    FrameClock clock = clock_at(parent, from.step);
    const FrameTime time = timeline::frame_time(parent, from.step);
    clock.step = from.step;
    clock.frame = time.frame;
    clock.substep = time.substep;
    clock.time = time.time;
    branch.clocks.push_back(clock);
    branches_.push_back(std::move(branch));
    return branches_.back().id;
}

void Timeline::add(Branch branch) {
    if (branch.id == 0 || find(branch.id) || (branch.parent != 0 && !find(branch.parent)) || branch.clocks.empty() ||
        !branch.start)
        throw std::invalid_argument("a branch that does not fit");
    next_branch_ = std::max(next_branch_, branch.id + 1);
    for (const Keyframe& keyframe : branch.keyframes)
        count(keyframe);
    branches_.push_back(std::move(branch));
}

void Timeline::rename(BranchId id, std::string name) {
    if (Branch* branch = find(id); branch && !name.empty())
        branch->name = std::move(name);
}

void Timeline::remove(BranchId id) {
    Branch* branch = find(id);
    if (!branch)
        return;
    revise();
    std::optional<std::uint64_t> shared; // the last step that a child comes from
    for (const Branch& child : branches_)
        if (child.parent == id)
            shared = std::max(shared.value_or(0), child.fork_step);
    const auto gone = [&](const Bookmark& b) { return b.moment.branch == id && (!shared || b.moment.step > *shared); };
    bookmarks_.erase(std::remove_if(bookmarks_.begin(), bookmarks_.end(), gone), bookmarks_.end());
    if (!shared) {
        const BranchId parent = branch->parent;
        for (const Keyframe& keyframe : branch->keyframes)
            discount(keyframe);
        branches_.erase(branches_.begin() + (branch - branches_.data()));
        const Branch* above = find(parent);
        if (above && above->stem)
            remove(parent);
        return;
    }
    branch->stem = true;
    const std::uint64_t last_frame = timeline::frame_time(*branch, *shared).frame;
    branch->end = std::min(branch->end, *shared);
    for (auto k = first_after(branch->keyframes, branch->end); k != branch->keyframes.end(); ++k)
        discount(*k);
    branch->keyframes.erase(first_after(branch->keyframes, branch->end), branch->keyframes.end());
    if (!branch->keyframes.empty())
        branch->keyframes.back().until = std::min(branch->keyframes.back().until, branch->end);
    const auto later = [&](const auto& x) { return x.step > branch->end; };
    std::erase_if(branch->changes, later);
    std::erase_if(branch->clocks, later);
    std::erase_if(branch->marks, later);
    std::erase_if(branch->samples, [&](const Sample& s) { return s.frame > last_frame; });
    if (branch->trouble && branch->trouble_step > branch->end)
        branch->trouble.reset();
}

void Timeline::clear() {
    branches_.clear();
    bookmarks_.clear();
    stored_ = on_disk_ = 0;
    revise();
}

std::uint32_t Timeline::add_bookmark(const Moment& moment, std::string name, std::optional<scene::Camera> camera) {
    const Branch& branch = owner(moment);
    const FrameTime time = timeline::frame_time(branch, moment.step);
    Bookmark bookmark{next_bookmark_++, {branch.id, moment.step}, time.frame, time.substep, std::move(name), camera};
    if (bookmark.name.empty())
        bookmark.name = "Bookmark " + std::to_string(bookmark.id);
    bookmarks_.push_back(std::move(bookmark));
    return bookmarks_.back().id;
}

void Timeline::rename_bookmark(std::uint32_t id, std::string name) {
    for (Bookmark& bookmark : bookmarks_)
        if (bookmark.id == id && !name.empty())
            bookmark.name = std::move(name);
}

void Timeline::remove_bookmark(std::uint32_t id) {
    std::erase_if(bookmarks_, [id](const Bookmark& b) { return b.id == id; });
}

const Bookmark* Timeline::find_bookmark(std::uint32_t id) const {
    const auto found =
        std::find_if(bookmarks_.begin(), bookmarks_.end(), [id](const Bookmark& b) { return b.id == id; });
    return found == bookmarks_.end() ? nullptr : &*found;
}

void Timeline::count(const Keyframe& keyframe) {
    stored_ += timeline::memory(keyframe);
    on_disk_ += timeline::on_disk(keyframe);
}

void Timeline::discount(const Keyframe& keyframe) {
    stored_ -= timeline::memory(keyframe);
    on_disk_ -= timeline::on_disk(keyframe);
}

void Timeline::store(BranchId id, Keyframe keyframe) {
    Branch* branch = find(id);
    if (!branch)
        throw std::out_of_range("there is no branch " + std::to_string(id));
    count(keyframe);
    auto after = first_after(branch->keyframes, keyframe.step);
    if (after != branch->keyframes.begin()) {
        Keyframe& before = *std::prev(after);
        if (before.step == keyframe.step) {
            discount(before);
            keyframe.until = std::max(keyframe.until, before.until);
            keyframe.kept |= before.kept;
            before = std::move(keyframe);
            return;
        }
        if (before.until >= keyframe.step) {
            keyframe.until = std::max(keyframe.until, before.until);
            before.until = keyframe.step;
        }
    }
    branch->keyframes.insert(after, std::move(keyframe));
}

void Timeline::refresh_kept(BranchId id) {
    Branch* branch = find(id);
    if (!branch)
        return;
    for (Keyframe& keyframe : branch->keyframes)
        keyframe.kept = false;
    const auto keep = [&](std::uint64_t step) {
        if (const Keyframe* keyframe = keyframe_before(*branch, step))
            branch->keyframes[static_cast<std::size_t>(keyframe - branch->keyframes.data())].kept = true;
    };
    for (const Mark& mark : branch->marks)
        keep(mark.step);
    for (const Bookmark& bookmark : bookmarks_)
        if (bookmark.moment.branch == id)
            keep(bookmark.moment.step);
}

void Timeline::set_options(const CacheOptions& options) {
    if (options.disk_folder != options_.disk_folder)
        scratch_.reset(); // what is there stays until nobody needs it any more
    options_ = options;
    disk_most_ = options.disk;
    disk_trouble_.clear();
}

std::size_t Timeline::memory() const {
    std::size_t sum = stored_ + bookmarks_.size() * sizeof(Bookmark);
    for (const Branch& branch : branches_)
        sum += memory_but_keyframes(branch);
    return sum;
}

} // namespace clothlab::timeline
