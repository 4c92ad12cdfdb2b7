// One line of history: what was changed when, states to start from again, and what was found. Plain data that can be
// copied while the run goes on: what is large is shared and never written to again.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "sim/description.h"
#include "sim/monitor.h"
#include "sim/state.h"
#include "timeline/state_codec.h"

namespace clothlab::timeline {

using BranchId = std::uint32_t; ///< 0: none. No number is used twice.
using DescriptionPtr = std::shared_ptr<const sim::Description>;

/// A state between two steps: after `step` steps since the run's start, and after the changes that were made there.
struct Moment {
    BranchId branch = 0;
    std::uint64_t step = 0;
    bool operator==(const Moment&) const = default;
};

/// A change of parameters. Those of the same step are made in order.
struct Change {
    std::uint64_t step = 0;
    DescriptionPtr description; ///< from here on
};

/// How steps and frames go together from a step on, until the next one of these.
struct FrameClock {
    std::uint64_t step = 0;
    std::uint64_t frame = 0; ///< whole frames by then
    int substep = 0;         ///< steps taken of the frame under way
    int substeps = 1;        ///< per frame
    double time = 0;         ///< s
    double dt = 0;           ///< s
};

/// A state to start from. Steps up to `until` are reached from it by taking steps.
struct Keyframe {
    std::uint64_t step = 0;
    std::uint64_t until = 0;
    DescriptionPtr description; ///< in force
    StoredStatePtr state;
    bool kept = false; ///< bookmarked or marked: goes last
};

/// What a frame's end is like.
struct Sample {
    std::uint64_t frame = 0;                    ///< whole frames by then
    double time = 0;                            ///< s
    float kinetic = 0, spring = 0, gravity = 0; ///< J
    float max_strain = 0;                       ///< 0.01: 1 % longer
    /// The most in any step of the frame.
    std::uint32_t contacts = 0, self_contacts = 0, shortened_springs = 0;
    std::array<float, sim::stage_count> stage_seconds{}; ///< mean wall time of each stage in a step of this frame
    float total() const { return kinetic + spring + gravity; }
};

enum class MarkKind : std::uint8_t {
    first_contact,      ///< a point touched a collider
    first_self_contact, ///< two points of the cloth pushed each other apart
    limit_active,       ///< the stretch limit shortened its first spring
    peak_strain,        ///< the most strain at any frame's end
    jitter,
    blow_up
};
inline constexpr std::size_t mark_kinds = 6;
inline constexpr std::array<const char*, mark_kinds> mark_names{
    "first contact", "first self-contact", "limit active", "peak strain", "jitter", "blow-up"};

/// What a run found by itself.
struct Mark {
    MarkKind kind = MarkKind::first_contact;
    std::uint64_t step = 0;  ///< that ended with it
    std::uint64_t frame = 0; ///< whole frames by then
    double value = 0;        ///< of peak_strain: the strain; 0 otherwise
    std::string text;        ///< a sentence
};

/// A moment with a name.
struct Bookmark {
    std::uint32_t id = 0;
    Moment moment;
    std::uint64_t frame = 0;
    int substep = 0;
    std::string name;
    std::optional<scene::Camera> camera;
};

/// A branch owns the steps after `fork_step`; those before are its parent's, and the parent's parent's.
struct Branch {
    BranchId id = 0;
    std::string name;
    BranchId parent = 0; ///< 0: a run from its start
    std::uint64_t fork_step = 0;
    std::uint64_t end = 0;               ///< the last step that has been taken
    bool stem = false;                   ///< deleted but for what its children need
    DescriptionPtr start;                ///< in force at fork_step before the branch's own changes
    std::vector<Change> changes;         ///< ascending
    std::vector<FrameClock> clocks;      ///< ascending; the first is of fork_step
    std::vector<Keyframe> keyframes;     ///< ascending; the last one's `until` is `end`
    std::vector<Sample> samples;         ///< of frames that end after fork_step, ascending by one
    std::vector<Mark> marks;             ///< ascending by step
    std::optional<sim::Trouble> trouble; ///< the branch's own first
    std::uint64_t trouble_step = 0;
};

/// The clock in force at a step, and where the step lies in frames by it.
const FrameClock& clock_at(const Branch& branch, std::uint64_t step);
struct FrameTime {
    std::uint64_t frame = 0;
    int substep = 0;
    int substeps = 1;
    double time = 0; ///< s
};
FrameTime frame_time(const Branch& branch, std::uint64_t step);
/// The step that completes a frame, in the branch's own part (or its fork_step if that is later). May lie beyond its
/// end.
std::uint64_t step_of_frame(const Branch& branch, std::uint64_t frame);

} // namespace clothlab::timeline
