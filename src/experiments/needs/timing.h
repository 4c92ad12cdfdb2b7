// What models cost, in one process and by turns, so that whatever else the machine does hits all of them alike.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "experiments/measured.h"
#include "experiments/needs/measure.h"

namespace clothlab::experiments::needs {

/// What a model costs, in s of wall time per simulated s.
using Cost = std::function<double(const sim::Description&)>;

struct Turns {
    int rounds = 3;
    /// Of a turn, with setting up: a model that takes less runs several times in each.
    double least_s = 0.03;
};

/// Runs the models by turns, A B C ... A B C, and returns what each costs in s of wall time per simulated s: of the
/// steps alone, the median of the rounds and their spread. With `known`, nothing is run: that is what they cost.
std::vector<Measured> time_by_turns(const std::vector<sim::Description>& models, const Course& course,
                                    const Turns& turns, const Cost& known, const Progress& progress);

} // namespace clothlab::experiments::needs
