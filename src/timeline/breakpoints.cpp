#include "timeline/breakpoints.h"

#include <algorithm>
#include <cstdio>

namespace clothlab::timeline {
namespace {

/// Whether the condition is one of the step itself, not of the state that it ends with.
bool is_of_step(BreakpointKind kind) {
    return kind == BreakpointKind::sphere_contact || kind == BreakpointKind::plane_contact ||
           kind == BreakpointKind::self_contact || kind == BreakpointKind::energy_gain;
}

bool needs_diagnostics(BreakpointKind kind) {
    return kind == BreakpointKind::max_strain || kind == BreakpointKind::energy_gain ||
           kind == BreakpointKind::rms_speed;
}

/// The diagnostics that the breakpoints need; all of a state's cost the same.
sim::Diagnostics diagnostics(const std::vector<Breakpoint>& breakpoints, const sim::Simulation& simulation) {
    const bool needed = std::any_of(breakpoints.begin(), breakpoints.end(),
                                    [](const Breakpoint& b) { return b.on && needs_diagnostics(b.kind); });
    return needed ? simulation.diagnose() : sim::Diagnostics{};
}

/// In m; none for a point outside the grid.
std::optional<double> height(const sim::Simulation& simulation, const sim::GridPoint& point) {
    const sim::Cloth& cloth = simulation.description().cloth;
    const auto [column, row] = point;
    if (column < 0 || column >= cloth.num_width_points || row < 0 || row >= cloth.num_height_points)
        return {};
    return simulation
        .position(static_cast<std::size_t>(row) * static_cast<std::size_t>(cloth.num_width_points) +
                  static_cast<std::size_t>(column))
        .y;
}

/// Whether a condition of states holds. Comparisons with what is no number are false.
bool holds(const Breakpoint& b, const sim::Simulation& simulation, const sim::Diagnostics& now) {
    switch (b.kind) {
    case BreakpointKind::max_strain:
        return now.max_strain > b.value;
    case BreakpointKind::rms_speed:
        return now.rms_speed < b.value;
    case BreakpointKind::point_rises: {
        const auto y = height(simulation, b.point);
        return y && *y > b.value;
    }
    case BreakpointKind::point_falls: {
        const auto y = height(simulation, b.point);
        return y && *y < b.value;
    }
    default:
        return false;
    }
}

/// Whether a condition of steps held in one.
bool held(const Breakpoint& b, const sim::StepCounts& counts, double energy_gain) {
    switch (b.kind) {
    case BreakpointKind::sphere_contact:
        return counts.sphere_contacts > 0;
    case BreakpointKind::plane_contact:
        return counts.plane_contacts > 0;
    case BreakpointKind::self_contact:
        return counts.self_contacts > 0;
    case BreakpointKind::energy_gain:
        return energy_gain > b.value;
    default:
        return false;
    }
}

std::string with_value(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

} // namespace

const std::array<BreakpointKindInfo, breakpoint_kinds>& breakpoint_info() {
    static const std::array<BreakpointKindInfo, breakpoint_kinds> info{{
        {"max strain", "%", "The largest strain of any spring gets above this.", 0.05},
        {"sphere contact", "", "A point touches a sphere, and none did in the step before.", 0},
        {"plane contact", "", "A point touches a plane, and none did in the step before.", 0},
        {"self-contact", "", "Points of the cloth push each other apart, and none did in the step before.", 0},
        {"energy gain", "J", "The total energy grows by more than this in one step, and did not in the step before.",
         0.1},
        {"point rises", "m", "A point of the cloth gets above this height.", 1},
        {"point falls", "m", "A point of the cloth gets below this height.", 0.5},
        {"RMS speed", "m/s", "The root mean square of the points' speeds gets below this: the cloth comes to rest.",
         0.01},
    }};
    return info;
}

std::string describe(const Breakpoint& b) {
    const auto of_point = [&](const char* what) {
        return "point " + std::to_string(b.point[0]) + ", " + std::to_string(b.point[1]) + with_value(what, b.value);
    };
    switch (b.kind) {
    case BreakpointKind::max_strain:
        return with_value("max strain > %.4g %%", 100 * b.value);
    case BreakpointKind::energy_gain:
        return with_value("energy gain > %.4g J in a step", b.value);
    case BreakpointKind::point_rises:
        return of_point(" above %.4g m");
    case BreakpointKind::point_falls:
        return of_point(" below %.4g m");
    case BreakpointKind::rms_speed:
        return with_value("RMS speed < %.4g m/s", b.value);
    default:
        return breakpoint_info()[static_cast<std::size_t>(b.kind)].name;
    }
}

void BreakpointWatch::set(std::vector<Breakpoint> breakpoints) {
    if (breakpoints == breakpoints_)
        return;
    breakpoints_ = std::move(breakpoints);
    known_ = false;
}

bool BreakpointWatch::any() const {
    return std::any_of(breakpoints_.begin(), breakpoints_.end(), [](const Breakpoint& b) { return b.on; });
}

void BreakpointWatch::before_step(const sim::Simulation& simulation) {
    if (known_ || !any())
        return;
    const sim::Diagnostics now = diagnostics(breakpoints_, simulation);
    energy_ = now.energy.total();
    // What the step before did is not in a state; that there was none is.
    const bool first = simulation.steps() == 0;
    was_.assign(breakpoints_.size(), false);
    for (std::size_t i = 0; i < breakpoints_.size(); ++i) {
        const Breakpoint& b = breakpoints_[i];
        was_[i] = is_of_step(b.kind) ? !first : b.on && holds(b, simulation, now);
    }
    known_ = true;
}

std::optional<std::size_t> BreakpointWatch::after_step(const sim::Simulation& simulation,
                                                       const sim::StepCounts& counts) {
    if (!known_ || !any())
        return {};
    const sim::Diagnostics now = diagnostics(breakpoints_, simulation);
    const double gain = now.energy.total() - energy_;
    energy_ = now.energy.total();
    std::optional<std::size_t> hit;
    for (std::size_t i = 0; i < breakpoints_.size(); ++i) {
        const Breakpoint& b = breakpoints_[i];
        if (!b.on)
            continue;
        const bool is = is_of_step(b.kind) ? held(b, counts, gain) : holds(b, simulation, now);
        if (is && !was_[i] && !hit)
            hit = i;
        was_[i] = is;
    }
    return hit;
}

} // namespace clothlab::timeline
