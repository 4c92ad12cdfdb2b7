// The search for the cheapest model within a tolerance: see needs.h.
#pragma once

#include <string>
#include <vector>

#include "experiments/needs/alternatives.h"
#include "experiments/needs/needs.h"

namespace clothlab::experiments::needs {

enum class Verdict : std::uint8_t {
    within, ///< the tolerance
    breaks, ///< it
    fails,  ///< diverges or jitters, which breaks any tolerance
    slower, ///< by so much that its run was given up
};

struct Trial {
    std::string what;
    Alternative alternative; ///< its last change
    Settings settings;       ///< what makes it of the full model
    scene::Scene scene;
    Verdict verdict = Verdict::within;
    double deviation = 0;           ///< in the quantity's unit; NaN where it is not known
    std::vector<std::string> proof; ///< why it is the full model to the bit; empty: it was tried
    std::string trouble;            ///< of a run that fails or was given up
    Measured cost;                  ///< s of wall time per simulated s
    bool timed = false;             ///< by turns; false: once, in the run that it was judged by
    double speed_up = 1;            ///< over the full model
    double wall_s = 0;              ///< of the run that it was judged by
};

struct Found {
    Course course;
    Record yardstick;         ///< the full model's run
    double noise = 0;         ///< how far the full model moves by a nudge, in the quantity's unit
    double nudge = 0;         ///< m
    Trial full;               ///< timed at the end, beside `recommended`
    std::vector<Trial> alone; ///< one thing left out of the full model
    std::vector<Trial> path;  ///< models that were taken, one after the other
    Trial recommended;        ///< the last of them, or the full model
    Trial again;              ///< the same, run and timed again
    std::vector<Trial> more;  ///< one more thing left out of it
};

/// What counts as faster: less is within what timings differ by.
inline constexpr double least_gain = 0.03;

Found search(const Config& config, const Progress& progress);

} // namespace clothlab::experiments::needs
