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

/// `settings` are those that made `scene` from the figure's own: what they change is named.
Caption caption(const scene::Scene& scene, const std::vector<scene::ShaderDeclaration>& shaders,
                const std::vector<std::string>& settings, int frame, const sim::Snapshot& snapshot);

/// How the run that a snapshot was captured of is doing: its trouble, else its stability margin, speed, strain, and
/// where the cloth passes through a plane or itself. The snapshot needs its stability margin.
void describe_outcome(const scene::Scene& scene, const sim::Snapshot& snapshot, Caption& caption);

/// For people: four digits, thousands in groups.
std::string readable(double value);

} // namespace clothlab::cli
