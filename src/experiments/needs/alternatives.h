// What can be left out of a scene's model or made coarser, one thing at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/findings.h"
#include "scene/scene.h"

namespace clothlab::experiments::needs {

/// What of a model an alternative is about.
enum class Part : std::uint8_t {
    springs,
    self_collision,
    limit,
    wind,
    damping,
    friction,
    collider,
    substeps,
    precision,
    resolution,
    method,
    solver,
};

struct Alternative {
    std::string what; ///< in words: "no bending springs"
    Part part = Part::springs;
    bool omission = false;    ///< leaves something out; false: makes it coarser, cheaper or does it another way
    Settings settings;        ///< what makes it, on top of the model that it is an alternative to
    std::size_t collider = 0; ///< the one that Part::collider leaves out
};

/// Everything that can be left out of this model or made coarser, in the order of Part. What it has not, such as wind,
/// is not among them, nor is what would set a key of `kept` or of a section in it. With fewer substeps goes the
/// course's damping per substep that takes as much of the motion in a second. Of a method, few substeps come before
/// many.
std::vector<Alternative> alternatives(const scene::Scene& model, const std::vector<std::string>& kept);

/// The settings one after the other, without those that a later one overrides.
Settings joined(const Settings& first, const Settings& second);

/// The alternatives of one model in one: colliders leave from the last to the first, so that each number is still
/// right.
Settings together(const std::vector<Alternative>& alternatives);

/// A model in words, as far as it differs from another, with its substeps and method in any case: "5 substeps of
/// Verlet, no bending springs".
std::string in_words(const scene::Scene& model, const scene::Scene& full);

} // namespace clothlab::experiments::needs
