// What a simulated second costs: by turns, all from the same states.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "experiments/accuracy/run.h"
#include "experiments/measured.h"
#include "sim/description.h"

namespace clothlab::experiments {

/// States of the exact motion, evenly spread over the time that is compared, the start among them, each in single and
/// in double precision. Runs of every method can begin with them.
struct Moments {
    std::vector<std::array<std::vector<std::byte>, 2>> saved; ///< by sim::Precision
};
/// `description`: of the coarsest reference.
Moments moments_of(const sim::Description& description, std::uint64_t frames, const Tick& tick);

/// What is timed, and how long a step takes, roughly, in s of processor time.
struct Timed {
    sim::Description description;
    int threads = 1;
    double step = 0;
};

/// Wall s per simulated s of each, of so many rounds: A B C ... A B C ... In its turn a run takes steps from each of
/// the moments in equal number, so that together they take about `slot` s; the first step from each, in which it finds
/// what it remembers from step to step, is not timed, nor is what it prepares before. It uses all the threads it is
/// given. No more steps than there are in `frames` frames.
std::vector<Measured> time_by_turns(const std::vector<Timed>& runs, const Moments& moments, std::uint64_t frames,
                                    int rounds, double slot, const Tick& tick);

} // namespace clothlab::experiments
