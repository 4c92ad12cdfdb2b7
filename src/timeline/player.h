// A run with its history: the one who writes the timeline. At the end of a line steps are new and are recorded; before
// it they are those that were taken before, to the last bit. An edit before the end makes a branch.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "timeline/reader.h"
#include "timeline/timeline.h"

namespace clothlab::timeline {

class Player {
public:
    explicit Player(const CacheOptions& options = {}, const sim::Execution& execution = {});

    /// A run from its start, beside those there are. The line shown now may be told by the same start and no changes:
    /// then its start is gone to. Throws std::invalid_argument, and changes nothing, for a description without meaning.
    void start(const sim::Description& description);
    /// Forgets everything but the present description's start.
    void clear();
    /// Other parameters from the present moment on. At the line's end it is recorded there, and another change at the
    /// same moment takes its place; before the end a branch begins, and the old future stays. What cannot be changed
    /// live is a run of its own (start). Throws std::invalid_argument, and changes nothing, for no meaning.
    void change(const sim::Description& description);

    /// One step forward.
    sim::StepCounts step();
    bool at_end() const;
    /// To a step of the present line, or the nearest one that can be reached; false when that is another.
    bool seek(std::uint64_t step);
    /// To the same step of another line, or the nearest there is. Throws std::out_of_range.
    void switch_to(BranchId line);
    /// To a moment on any line, or the nearest one.
    bool go_to(const Moment& moment);

    std::uint32_t bookmark(std::string name, std::optional<scene::Camera> camera);
    void rename_bookmark(std::uint32_t id, std::string name) { timeline_.rename_bookmark(id, std::move(name)); }
    void remove_bookmark(std::uint32_t id);
    void rename_branch(BranchId id, std::string name) { timeline_.rename(id, std::move(name)); }
    /// The line shown is left first for its parent's.
    void remove_branch(BranchId id);

    /// In place of everything: what a file had.
    void adopt(Timeline timeline, const Moment& at);
    void set_options(const CacheOptions& options);

    const Timeline& timeline() const { return timeline_; }
    Moment moment() const; ///< of the line shown
    BranchId line() const { return line_; }
    bool has_simulation() const { return reader_.has_simulation(); }
    sim::Simulation& simulation() { return reader_.simulation(); }
    const sim::Simulation& simulation() const { return reader_.simulation(); }
    /// The first trouble of the line up to the present moment.
    const sim::Trouble* trouble() const;
    std::size_t memory() const { return timeline_.memory() + reader_.memory(); }
    /// Counts up whenever the timeline is not what it was, but for the playhead.
    std::uint64_t version() const { return version_; }

private:
    struct Recording; // of the frame under way
    Timeline timeline_;
    Reader reader_;
    BranchId line_ = 0;
    std::uint64_t version_ = 0;
};

} // namespace clothlab::timeline
