// One run of the accuracy experiment: to its end, within a budget, and how far that end is from another.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiments/accuracy/accuracy.h"
#include "experiments/trial.h"
#include "sim/description.h"
#include "sim/diagnostics.h"
#include "sim/simulation.h"

namespace clothlab::experiments {

/// Called some ten times a second with the share of a run that is done; may throw Cancelled to end it.
using Tick = std::function<void(double share)>;

struct Ending {
    bool finished = false; ///< false: it would have taken longer than the budget, or it diverged
    sim::Status status = sim::Status::ok;
    Shape shape;
    double energy = 0;               ///< J, total
    double seconds = 0;              ///< of processor time
    std::uint64_t steps = 0;         ///< that were taken
    std::uint64_t self_contacts = 0; ///< in all of them
};

/// Takes so many frames, at least one. The energy is of velocities at the very end: for methods that keep none, from
/// the positions a step before and a step after, which is second order. Gives up as soon as it is clear that a run
/// takes longer than `budget` s of processor time.
Ending run_to_end(const sim::Description& description, std::uint64_t frames, double budget, const Tick& tick);

/// How far an ending is from another, by ErrorQuantity and in its unit: mm, the energy in mJ.
using Errors = std::array<double, 5>;
Errors errors_between(const Ending& ending, const Ending& reference);

/// Runs task(i) for i below n, some at a time, and tells how many are done. Tasks are given a tick that throws
/// Cancelled when the experiment is to end. With one job all is done in the calling thread. Throws what a task throws.
void run_tasks(std::size_t n, int jobs, const std::function<void(std::size_t, const Tick&)>& task,
               const std::function<void(std::size_t done)>& tell);

} // namespace clothlab::experiments
