// All that is known of the runs of a session: branches and bookmarks, within a budget of memory. Knows no simulation:
// Player fills it, Reader goes to what is in it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "timeline/branch.h"
#include "timeline/scratch_file.h"
#include "timeline/step_costs.h"

namespace clothlab::timeline {

struct CacheOptions {
    std::size_t budget = std::size_t{512} << 20; ///< bytes of memory, of all branches together
    /// What the steps of a seek may take, in s; 2.5 times as long where one frame alone takes longer than that. States
    /// are stored so close together that it suffices, and dropped rather than further apart.
    double seek_s = 0.0135;
    /// Simulated seconds that are worth a slower seek, of a whole frame or up to four times that, before their states
    /// are dropped.
    double least_reach_s = 0;
    /// Bytes on a disk, for states that memory has no room for and that are needed for a quick seek.
    std::size_t disk = 0;
    std::filesystem::path disk_folder = {}; ///< empty: scratch_folder()
    bool operator==(const CacheOptions&) const = default;
};

/// The stored state from which a step of a branch's own part is reached; null when it cannot be.
const Keyframe* keyframe_before(const Branch& branch, std::uint64_t step);

/// Bytes of memory of all that a branch keeps, of a stored state of it, and of all else.
std::size_t memory(const Branch& branch);
std::size_t memory(const Keyframe& keyframe);
std::size_t memory_but_keyframes(const Branch& branch);
/// Bytes on disk, of a stored state and of all of a branch's.
std::size_t on_disk(const Keyframe& keyframe);
std::size_t on_disk(const Branch& branch);

/// How much longer a seek may take where one frame alone takes longer than a seek should.
inline constexpr double slow_frame = 2.5;

class Timeline {
public:
    explicit Timeline(const CacheOptions& options = {}) : options_(options), disk_most_(options.disk) { revise(); }

    const std::vector<Branch>& branches() const { return branches_; } ///< parents before their children
    const std::vector<Bookmark>& bookmarks() const { return bookmarks_; }
    const Branch* find(BranchId id) const;
    Branch* find(BranchId id);
    /// The branch that owns a moment of a line: itself or an ancestor. Throws std::out_of_range for an unknown branch.
    const Branch& owner(const Moment& moment) const;
    /// The branch, its parent, ..., its root.
    std::vector<const Branch*> line(BranchId id) const;

    /// Steps, frames and time of a line.
    FrameTime frame_time(const Moment& moment) const;
    /// The step that completes a frame of a line, at most its last step. `frame` 0 is step 0.
    std::uint64_t step_of_frame(BranchId id, std::uint64_t frame) const;
    /// Whether a state can be had: it has not been dropped from the cache, and has been computed.
    bool reachable(const Moment& moment) const;
    /// Of a line: the reachable step nearest to one that may not be.
    std::uint64_t nearest_reachable(const Moment& moment) const;
    /// The first reachable one that is not before it, or the line's end.
    std::uint64_t next_reachable(const Moment& moment) const;
    /// The last reachable one that is not after it; none when there is none.
    std::optional<std::uint64_t> previous_reachable(const Moment& moment) const;
    /// Calls take(first, last) for ranges of reachable steps of a line, the last ones first.
    template <class Take>
    void for_reachable(BranchId id, Take take) const {
        const std::vector<const Branch*> branches = line(id);
        std::uint64_t last = branches.front()->end;
        for (const Branch* branch : branches) {
            for (auto keyframe = branch->keyframes.rbegin(); keyframe != branch->keyframes.rend(); ++keyframe)
                if (keyframe->step <= last)
                    take(keyframe->step, std::min(keyframe->until, last));
            if (branch->fork_step == 0)
                return;
            last = branch->fork_step - 1;
        }
    }

    /// The new branch's number. A name is made up when it is empty.
    BranchId add_root(DescriptionPtr start, const FrameClock& clock, std::string name = {});
    BranchId add_fork(const Moment& from, DescriptionPtr start, std::string name = {});
    /// With everything in it; its number, and its parent's, must fit. For files.
    void add(Branch branch);
    void rename(BranchId id, std::string name);
    /// Removes a branch; what its children came from stays. Bookmarks of what is gone go too.
    void remove(BranchId id);
    void clear();

    std::uint32_t add_bookmark(const Moment& moment, std::string name, std::optional<scene::Camera> camera);
    void rename_bookmark(std::uint32_t id, std::string name);
    void remove_bookmark(std::uint32_t id);
    const Bookmark* find_bookmark(std::uint32_t id) const;

    /// Another number whenever states are no longer what they were: by another change, or as a branch has been cut.
    /// What only grows keeps it; copies have the original's.
    std::uint64_t revision() const { return revision_; }
    void revise();

    /// Stores a state of a branch, in place of one of the same step.
    void store(BranchId id, Keyframe keyframe);
    /// The states that a branch's marks and bookmarks need are kept: they go last.
    void refresh_kept(BranchId id);
    /// Thins out and drops states until the budget holds. First states go so that those left are evenly apart, the
    /// oldest first, as long as a seek between them takes no longer than it may by what the steps there took; then the
    /// oldest move to the disk, as far as there is room on it; then the oldest go, each branch's last one excepted, and
    /// kept ones only when no others are left.
    void fit();

    const CacheOptions& options() const { return options_; }
    void set_options(const CacheOptions& options);
    /// Bytes of memory of all that is kept.
    std::size_t memory() const;
    std::size_t on_disk() const { return on_disk_; } ///< bytes
    /// Why the disk is not used as it should be; empty when it is. Another try is made when options are set.
    const std::string& disk_trouble() const { return disk_trouble_; }
    /// Simulated seconds that are reachable, of all branches together.
    double reach_s() const;

private:
    // How far apart the states of a branch may be.
    struct Gap {
        std::uint64_t frames = 1; ///< that it reaches into
        double seconds = 0;       ///< that its steps take
    };
    // What there may be, in bytes.
    struct Room {
        static constexpr std::size_t any = SIZE_MAX;
        std::size_t memory = any, disk = any, both = any;
    };
    bool over(const Room& room) const { return over(room, memory()); }
    bool over(const Room& room, std::size_t memory) const {
        return memory > room.memory || on_disk_ > room.disk || memory + on_disk_ > room.both;
    }
    /// Whether it becomes less of what there is too much of when the state goes.
    bool helps(const Keyframe& keyframe, const Room& room, std::size_t memory) const;
    /// For seeks that take so many times as long as they should.
    Gap widest_gap(double frame_s, double slower) const;
    /// What goes from each branch is what leaves gaps no wider than gap_of gives for its steps' costs.
    template <class GapOf>
    void thin(const Room& room, const std::vector<StepCosts>& costs, GapOf gap_of);
    void drop(const Room& room, bool kept_too, double least_reach_s);
    /// The oldest states go, or those between others if seeks may become slow.
    void make_room(const Room& room);
    /// The oldest states, until memory has no more than that or the disk its part; false when the disk fails.
    bool move_to_disk(std::size_t most);
    void count(const Keyframe& keyframe);
    void discount(const Keyframe& keyframe);
    static void forget_unreachable(Branch& branch);

    CacheOptions options_;
    std::uint64_t revision_;
    std::size_t stored_ = 0, on_disk_ = 0; ///< bytes of all keyframes
    std::shared_ptr<ScratchFile> scratch_; ///< none before it is needed
    std::size_t disk_most_ = 0;            ///< bytes that may be there: the options', or what there was when it failed
    std::string disk_trouble_;
    std::vector<Branch> branches_;
    std::vector<Bookmark> bookmarks_;
    BranchId next_branch_ = 1;
    std::uint32_t next_bookmark_ = 1;
};

} // namespace clothlab::timeline
