// What is written below a figure: its parameters, and what its run reported about itself.
#pragma once

#include <string>
#include <vector>

#include "cli/gui/gallery_figures.h"
#include "scene/shader_parameters.h"
#include "sim/simulation.h"

namespace clothlab::cli {

struct Caption {
    std::string parameters; ///< of the simulation: the usual ones, what the figure changes, the moment
    std::string look;       ///< the shader, and what the figure changes in the look
    std::string outcome;    ///< how the run is doing
    bool trouble = false;   ///< the outcome says what went wrong
};

/// Speeds are told as the mean over this time, s: what lies on a plane, or is held by the stretch limit, is moved to
/// and fro within every step and stays where it is.
inline constexpr double caption_seconds = 0.1;

/// Of a figure that shows a snapshot of a run, captured with its stability margin; `before` is of up to caption_seconds
/// before it. `settings` are those that made `scene` from the figure's own: what they change is named.
Caption caption(const scene::Scene& scene, const std::vector<scene::ShaderDeclaration>& shaders,
                const std::vector<std::string>& settings, const sim::Snapshot& snapshot, const sim::Snapshot& before);

/// For people: four digits, thousands in groups.
std::string readable(double value);

} // namespace clothlab::cli
