// What every experiment is given and what every one ends in: a table, charts and sentences, the same on the command
// line, in the lab's panels and in reports.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/chart.h"
#include "experiments/table.h"

namespace clothlab::experiments {

/// KEY=VALUE of scene::set_parameter, in the order in which they are to be set.
using Settings = std::vector<std::string>;

struct Findings {
    std::string title; ///< the experiment and its scene
    Table table;
    /// Of each row of the table: what makes that row's run out of the experiment's scene. As long as table.rows.
    std::vector<Settings> settings;
    /// What makes the reference's run, to be drawn as a ghost beside a row's; empty: the scene itself.
    Settings reference;
    double seconds = 0; ///< simulated, of each run; 0: unknown
    std::vector<Chart> charts;
    std::vector<std::string> sentences; ///< what was found; the most important first
    std::vector<std::string> notes;     ///< how it was measured, and what was left out
};

/// Why an experiment cannot be made, as a sentence for its user: a chaotic scene, a method that does not exist.
class Refusal : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Thrown by Progress::tell when the experiment is not wanted any more.
class Cancelled : public std::runtime_error {
public:
    Cancelled() : std::runtime_error("cancelled") {}
};

/// Told how far an experiment is. Experiments call it often enough to be ended within a second or two, always from the
/// thread that they were called in.
struct Progress {
    /// `share` of the work from 0 to 1, and what is done now; returns false when it is to end.
    std::function<bool(double share, const std::string& what)> report;
    /// Throws Cancelled.
    void tell(double share, const std::string& what) const {
        if (report && !report(share, what))
            throw Cancelled();
    }
};

} // namespace clothlab::experiments
