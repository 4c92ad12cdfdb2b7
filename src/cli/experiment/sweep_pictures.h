// A sweep's cells as a grid of pictures.
#pragma once

#include <string>

#include "cli/command_line.h"
#include "experiments/sweep/sweep.h"

namespace clothlab::cli {

/// Why a sweep is no grid of pictures of a size in px: it has more than two varied parameters, or would be too large
/// for one picture. Empty where it is.
std::string objection_to_grid(const experiments::Sweep& sweep, int width, int height);

/// The grid of a sweep with all its rows: the first parameter from the left to the right, the second downwards, and
/// below each picture how its run ended. Its file, size and jobs are left to be set.
SceneGrid sweep_pictures(const experiments::Sweep& sweep, const experiments::SweepRows& rows);

} // namespace clothlab::cli
