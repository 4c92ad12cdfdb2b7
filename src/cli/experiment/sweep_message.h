// A sweep on its way to a worker: a line of JSON.
#pragma once

#include <string>

#include "experiments/sweep/sweep.h"

namespace clothlab::cli {

/// With the end of the line. Every bit of the sweep's identity is in it.
std::string sweep_message(const experiments::SweepConfig& config);
/// Throws std::exception for what sweep_message did not write.
experiments::SweepConfig read_sweep_message(const std::string& line);

} // namespace clothlab::cli
