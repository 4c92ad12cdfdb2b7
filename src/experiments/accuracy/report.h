// What the accuracy experiment's runs tell: the table, the charts and the sentences.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/accuracy/accuracy.h"
#include "experiments/accuracy/reference.h"
#include "experiments/accuracy/run.h"
#include "experiments/measured.h"

namespace clothlab::experiments {

/// A method, perhaps with the course's version of a rule.
struct Candidate {
    sim::IntegratorId integrator;
    std::string name;  ///< "rk4", "rk4, limit=cs184"
    std::string rule;  ///< empty: none
    Settings settings; ///< on top of the model's
};

/// A candidate at a step.
struct Attempt {
    std::size_t candidate = 0;
    sim::Precision precision = sim::Precision::double_precision;
    int substeps = 1;
    double dt = 0;     ///< s
    Settings settings; ///< on top of the experiment's scene
    sim::Description description;
    bool left_out = false; ///< it would have taken longer than the budget
    sim::Status status = sim::Status::ok;
    double step = 0;             ///< s of processor time that a step took while errors were measured
    std::optional<Errors> error; ///< of what did not diverge
    std::vector<Measured> cost;  ///< wall s per simulated s, of AccuracyConfig::threads; empty: not timed
};

/// Errors below so many times the reference's own are not told from it.
inline constexpr double resolution = 10;

struct AccuracyRuns {
    std::uint64_t frames = 1;
    Reference reference;
    std::vector<Candidate> candidates;
    std::vector<Attempt> attempts; ///< by candidate, precision, then from few substeps to many
};

/// `config` with its lists filled in.
Findings accuracy_findings(const AccuracyConfig& config, const AccuracyRuns& runs);

} // namespace clothlab::experiments
