// Physics breakpoints: conditions at which a run pauses. A breakpoint hits when its condition becomes true in a step:
// it was not before the step and is after it. Contacts and a gain of energy are what happens in a step: they hit when
// they happen in one and did not in the one before. So a hit depends on the run alone, and comes again wherever it is
// rewound and played again.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/simulation.h"

namespace clothlab::timeline {

enum class BreakpointKind : std::uint8_t {
    max_strain,     ///< the largest strain of any spring is above `value` (0.05: 5 %)
    sphere_contact, ///< some point touches a sphere
    plane_contact,  ///< some point touches a plane
    self_contact,   ///< some points of the cloth push each other apart
    energy_gain,    ///< the total energy has grown by more than `value`, in J, in one step
    point_rises,    ///< a point's height is above `value`, in m
    point_falls,    ///< a point's height is below `value`, in m
    rms_speed,      ///< the root mean square speed is below `value`, in m/s: at rest
};
inline constexpr std::size_t breakpoint_kinds = 8;

struct BreakpointKindInfo {
    const char* name; ///< as people read it
    const char* unit; ///< of `value`, "%" of a hundred times it; empty: it has none
    const char* help; ///< a sentence
    double value;     ///< at first
};
const std::array<BreakpointKindInfo, breakpoint_kinds>& breakpoint_info();

struct Breakpoint {
    BreakpointKind kind = BreakpointKind::max_strain;
    double value = 0.05;
    sim::GridPoint point{0, 0}; ///< column and row, of point_rises and point_falls
    bool before = false;        ///< pause before the step that makes it true, not after it
    bool on = true;
    bool operator==(const Breakpoint&) const = default;
};

/// What it pauses at, as a short text: "max strain > 5 %".
std::string describe(const Breakpoint& breakpoint);

/// Watches a run for a list of breakpoints. What none of them needs is not computed.
class BreakpointWatch {
public:
    void set(std::vector<Breakpoint> breakpoints);
    const std::vector<Breakpoint>& breakpoints() const { return breakpoints_; }
    bool any() const;
    /// After a seek or a change: what is true now has not become true in a step. What happened in the step before is
    /// not known then and is taken to be the same as in the next, except at the run's start.
    void reset() { known_ = false; }
    /// Before each step.
    void before_step(const sim::Simulation& simulation);
    /// After it: the first of the breakpoints that hits.
    std::optional<std::size_t> after_step(const sim::Simulation& simulation, const sim::StepCounts& counts);

private:
    std::vector<Breakpoint> breakpoints_;
    std::vector<bool> was_; ///< true before the step, by breakpoint
    double energy_ = 0;     ///< J, before the step
    bool known_ = false;    ///< was_ and energy_ are of the state now
};

} // namespace clothlab::timeline
