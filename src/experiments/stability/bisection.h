// Where along one parameter a scene's runs stop being stable, as exactly as wanted.
#pragma once

#include <optional>
#include <string>

#include "experiments/findings.h"
#include "experiments/stability/cell.h"
#include "scene/scene.h"

namespace clothlab::experiments {

struct BisectionConfig {
    scene::Scene scene;
    std::string key = "cloth.ks";   ///< as quantity_of reads it (axis.h)
    std::optional<double> from, to; ///< where to look; what is missing is found from the prediction
    /// Of the last interval, as a share of its values. Whole numbers are found to 1.
    double precision = 1e-3;
    JudgeConfig judge;
    int threads = 1; ///< of the two ends of the first interval; the findings do not depend on it
};

/// Judges the ends of an interval, then its middle, and so on. The table has a row for each run, in the order of the
/// values; the row of the last stable one has the limit: predicted from the start pose, predicted from the poses that
/// this run goes through, and observed, in the middle of the last interval. Throws Refusal (no limit in reach, both
/// ends alike), scene::SceneError and Cancelled.
Findings bisect_stability(const BisectionConfig& config, const Progress& progress);

} // namespace clothlab::experiments
