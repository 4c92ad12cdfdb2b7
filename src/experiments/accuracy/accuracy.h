// Accuracy against speed: every method at many steps, how far its cloth is from the exact motion at a time, and what a
// simulated second costs.
//
// Refining the step has to lead to one motion, so all runs follow the physical rules (physical_model). The reference is
// the method of the highest order in double precision at h, h/2 and h/4; its own error comes from the differences of
// these. A scene in which a perturbation of 1e-10 m grows without bound has no such motion that a computer could find,
// and is refused.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/findings.h"
#include "scene/scene.h"
#include "sim/integrators/integrator.h"

namespace clothlab::experiments {

/// What the chart, the slopes, the front and the sentences are of; the table has all of them.
enum class ErrorQuantity : std::uint8_t { rms, largest, sag, drape, energy };

struct ErrorQuantityInfo {
    ErrorQuantity id;
    const char* name;   ///< as the command line writes it
    const char* column; ///< of the table
    const char* title;  ///< of the error, with the unit
    const char* unit;
    const char* help;
};
/// In the order of ErrorQuantity.
const std::vector<ErrorQuantityInfo>& error_quantities();

/// Steps per frame from one number to another, evenly in the logarithm: at most `count` whole numbers, ascending.
std::vector<int> spread_substeps(int first, int last, int count);

struct AccuracyConfig {
    scene::Scene scene;
    std::string scene_name; ///< for the title
    double seconds = 0.5;   ///< simulated s after which shapes are compared: the nearest whole frame
    std::vector<sim::IntegratorId> integrators; ///< empty: all
    std::vector<int> substeps;                  ///< per frame; empty: 1, 2, 4 ... 1024
    std::vector<sim::Precision> precisions{sim::Precision::single_precision, sim::Precision::double_precision};
    std::vector<int> threads{1, 2};
    bool rules = false; ///< also the scene's method with the course's version of one rule at a time
    ErrorQuantity quantity = ErrorQuantity::rms;
    std::vector<double> tolerances; ///< in the quantity's unit, of the sentences; empty: 10, 1, 0.1 and 0.01
    double budget = 2;  ///< s of processor time that a run to the end may take; what takes longer is left out
    int rounds = 3;     ///< of timing; 0: no times, and so no front
    double slot = 0.02; ///< wall s that a run is timed in each round, at least a few steps
    int jobs = 0;       ///< runs at a time while errors are measured, not times; 0: one for each core
};

/// Throws Refusal, scene::SceneError and Cancelled.
Findings run_accuracy(const AccuracyConfig& config, const Progress& progress);

} // namespace clothlab::experiments
