// A scene without the course's shortcuts: the model whose motion does not depend on the step.
#pragma once

#include <string>
#include <vector>

#include "experiments/findings.h"
#include "scene/scene.h"

namespace clothlab::experiments {

struct PhysicalModel {
    Settings settings;              ///< that make it out of the scene
    std::vector<std::string> notes; ///< a sentence for each that changes the motion
};

/// Every rule that is the course's becomes the physical one; others stay. The share that the course's damping takes in
/// a substep becomes the rate that it has at the scene's own step, c = -ln(1 - d) substeps frames_per_second. Throws
/// Refusal where there is no such rate, at a damping of 100 %.
PhysicalModel physical_model(const scene::Scene& scene);

/// The settings that give a scene of the physical model the course's version of a rule, one rule each, by the rule's
/// name: those that have a part in the scene and that physical_model switched.
struct RuleChange {
    std::string name; ///< "damping=cs184"
    Settings settings;
};
std::vector<RuleChange> course_rules(const scene::Scene& scene);

/// KEY=VALUE, so that the very number is read back.
std::string setting(const std::string& key, double value);

} // namespace clothlab::experiments
