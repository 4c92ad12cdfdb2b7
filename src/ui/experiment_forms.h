// The settings of each experiment, as the panel shows them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace clothlab::ui {

/// A parameter and its values, as the panel lets them be chosen.
struct AxisChoice {
    std::string key;         ///< as the command line takes it
    double from = 0, to = 1; ///< of numbers, in the unit of the scene's files
    int count = 8;
    bool log = false;
    std::string list; ///< of things that are not numbers: separated by commas; empty: all
};

struct AccuracyForm {
    double seconds = 0.5;
    int quantity = 0;
    std::vector<bool> methods; ///< empty: all
    int first_substeps = 1, last_substeps = 1024, steps = 11;
    int precisions = 0; ///< both, single, double
    bool second_thread = true, rules = false;
    double budget = 2; ///< wall s of a run
};

struct StabilityForm {
    bool bisect = false;
    AxisChoice x{"simulation.substeps", 8, 64, 0, false, {}}, y{"cloth.ks", 1e4, 1e6, 0, true, {}};
    std::string key = "cloth.ks"; ///< of the limit
    int resolution = 32;
};

struct NeedsForm {
    double seconds = 0.5, tolerance = 1;
    int quantity = 0;
    bool at_end = false, second_thread = false;
};

struct SweepForm {
    AxisChoice first{"cloth.ks", 500, 50000, 5, true, {}}, second{"cloth.density", 50, 450, 3, false, {}};
    bool two = true;
    int frames = 90;
    std::string plot = "max_strain";
};

/// What was chosen in each form: the panel's own.
struct ExperimentForms {
    AccuracyForm accuracy;
    StabilityForm stability;
    NeedsForm needs;
    SweepForm sweep;
};

} // namespace clothlab::ui
