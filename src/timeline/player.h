// A run with its history: the one who writes the timeline. At the end of a line steps are new and are recorded; before
// it they are those that were taken before, to the last bit. An edit before the end makes a branch.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "timeline/reader.h"
#include "timeline/timeline.h"

namespace clothlab::timeline {

class Player : private Reader {
public:
    explicit Player(const CacheOptions& options = {}, const sim::Execution& execution = {});

    /// A run from its start, beside those there are; where the line shown has that very start and no changes, its own.
    /// Throws std::invalid_argument, and changes nothing, for a description without meaning.
    void start(const sim::Description& description);
    /// Forgets everything; has no simulation until the next start.
    void clear();
    /// Other parameters from the present moment on. At the line's end it is recorded there, and another change at the
    /// same moment takes its place; before the end a branch begins, and the old future stays. What cannot be changed
    /// live is a run of its own (start). Throws std::invalid_argument, and changes nothing, for no meaning.
    void change(const sim::Description& description);

    /// One step forward; over what has been dropped from the cache, to the next state there is.
    sim::StepCounts step();
    bool at_end() const;
    /// To a step of the present line, or the nearest one that can be reached; false when that is another.
    bool seek(std::uint64_t step);
    /// To the same step of another line, or the nearest there is. Throws std::out_of_range for an unknown one.
    void switch_to(BranchId line);
    /// To a moment on any line, or the nearest one there. The line shown stays if the moment lies on it.
    void go_to(const Moment& moment);

    /// Marks the present moment, whose state is kept.
    std::uint32_t bookmark(std::string name, std::optional<scene::Camera> camera);
    void rename_bookmark(std::uint32_t id, std::string name);
    void remove_bookmark(std::uint32_t id);
    void rename_branch(BranchId id, std::string name);
    /// The line shown is left first: for its parent's, or for another run. The only branch cannot be removed: throws
    /// std::invalid_argument.
    void remove_branch(BranchId id);

    /// In place of everything: what a file had. Throws std::out_of_range, or std::runtime_error, and changes nothing,
    /// when the moment cannot be gone to.
    void adopt(Timeline timeline, const Moment& at);
    void set_options(const CacheOptions& options);
    const CacheOptions& options() const { return options_; }

    const Timeline& timeline() const { return timeline_; }
    Moment moment() const { return {line_, simulation_ ? simulation_->steps() : 0}; } ///< of the line shown
    BranchId line() const { return line_; }
    using Reader::description;
    using Reader::has_simulation;
    using Reader::simulation;
    /// The first trouble of the line up to the present moment.
    const sim::Trouble* trouble() const;
    std::size_t memory() const { return timeline_.memory() + Reader::memory(); }
    /// Counts up whenever the timeline is not what it was, but for the playhead.
    std::uint64_t version() const { return version_; }

private:
    // Before the last change, as long as another one may take its place.
    struct BeforeChange {
        Moment moment;
        BranchId line = 0; ///< that was shown
        DescriptionPtr description;
        std::vector<std::byte> state;
        bool recorded = false; ///< a change was
    };
    // The frame that is being recorded.
    struct FrameSoFar {
        std::uint32_t contacts = 0, self_contacts = 0, shortened_springs = 0;
        int steps = 0;
        sim::StageSeconds seconds{}; ///< of all stages when it began
    };

    sim::StepCounts record();
    void end_frame(Branch& branch);
    void store_within_frame(Branch& branch, double step_s);
    void mark(Branch& branch, MarkKind kind, double value, std::string text);
    void look_for_marks(Branch& branch, const sim::StepCounts& counts);
    void look_for_peak(Branch& branch);
    void store_state(Branch& branch, bool kept);
    void put_clock(Branch& branch);
    void finish_change(Branch& branch);
    void begin_branch();

    CacheOptions options_;
    /// Calls look(branch, last) for the branches of the line shown, with the last step that belongs to it, from the end
    /// to the root.
    template <class Look>
    void for_line(Look look) const {
        const Branch* child = nullptr;
        for (const Branch* branch : timeline_.line(line_)) {
            look(*branch, child ? child->fork_step : branch->end);
            child = branch;
        }
    }

    Timeline timeline_;
    BranchId line_ = 0;
    std::uint64_t version_ = 0;
    std::optional<BeforeChange> before_change_;
    FrameSoFar frame_;
    std::array<bool, mark_kinds> found_{}; ///< on the line shown, once for all
    /// What a step takes, times steps per frame: the mean of the newest frames of this run.
    double seconds_per_frame_ = 0;
    int timed_frames_ = 0;
    double since_stored_s_ = 0; ///< that the steps since the newest stored state took
};

} // namespace clothlab::timeline
