// The cheapest model that a scene needs: switches off or coarsens one thing at a time, then greedily in combination,
// and measures what each costs and what leaving it out changes.
//
// The scene as it is given, the full model, is the yardstick: deviations are from it, not from the truth. What its run
// proves to be free to drop is dropped first. Then, of all single alternatives to the model so far, the fastest that
// keeps the whole within the tolerance is taken, measured as it is and not added up, until none gains anything; what
// can be left out within the tolerance without a gain is left out too. So every further alternative breaks the
// tolerance or is not faster, and that was measured for each.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/findings.h"
#include "experiments/needs/measure.h"
#include "experiments/needs/timing.h"
#include "scene/scene.h"

namespace clothlab::experiments::needs {

struct Config {
    scene::Scene scene;
    std::string source; ///< the scene's, for people
    std::uint64_t frames = 90;
    Quantity quantity = Quantity::rms;
    double tolerance = 1; ///< in the quantity's unit, above 0
    bool at_end = false;  ///< compare at the end only, not over time; of first_contact there is only one comparison
    int threads = 1;
    std::vector<std::string> kept = {}; ///< keys and sections that are not to be touched
    Cost known_cost = {};               ///< instead of measuring: makes the search the same every time
};

struct Result {
    Findings findings;
    scene::Scene recommended; ///< named and described as what it is
};

/// The table's columns are stage, model, cost_s_per_s, spread_percent, speed_up, deviation_UNIT, within, evidence.
/// Throws scene::SceneError for a key of `kept` that does not exist, and Refusal where the full model diverges,
/// jitters, is too chaotic for the tolerance or has no first contact.
Result run_needs(const Config& config, const Progress& progress);

} // namespace clothlab::experiments::needs
