// Where a scene's runs are stable, over two of its parameters, and where they are predicted to be.
#pragma once

#include <string>

#include "experiments/findings.h"
#include "experiments/stability/cell.h"
#include "scene/scene.h"

namespace clothlab::experiments {

struct StabilityMapConfig {
    scene::Scene scene;
    /// As read_axis reads them (axis.h): any two of the scene's parameters.
    std::string x = "simulation.substeps=8:64", y = "cloth.ks=1e4:1e6log";
    std::size_t resolution = 64; ///< values of an axis that does not say how many
    std::size_t blocks = 8;      ///< of the coarse lattice along an axis of numbers
    JudgeConfig judge;
    int threads = 1; ///< runs at the same time; the findings do not depend on it
};

/// Judges the runs of a coarse lattice, then those along the borders between verdicts (refinement.h), and compares the
/// border of the stable runs with the prediction (prediction.h) of the start pose. The table has one row for
/// each run. A row next to the border says where along one axis it is predicted and observed: between that run and its
/// neighbour. Throws Refusal, scene::SceneError and Cancelled.
Findings map_stability(const StabilityMapConfig& config, const Progress& progress);

} // namespace clothlab::experiments
