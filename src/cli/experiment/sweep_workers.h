// One process per core for the cells of a sweep: one that crashes or runs out of memory takes only its cell with it.
//
// A worker is this program again, as `clothlab experiment sweep-worker`. It reads the sweep as a line of JSON from its
// standard input, then the number of a cell a line, and answers each on standard output with the row as a line of the
// CSV file, or with "!" and why it could not be run; before that any number of lines "~" and the share that is done.
// It ends when its input does.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/sweep/sweep.h"

namespace clothlab::cli {

/// Runs these cells, `jobs` at a time (0: as many as there are cores), and gives each row to `done` as it comes.
/// Returns the cells that could not be run, and why: the others are run nevertheless. No worker is left when it returns
/// or throws. Throws experiments::Cancelled, what `done` throws, and std::runtime_error when no worker can be started.
std::map<std::size_t, std::string>
run_in_workers(const experiments::Sweep& sweep, const std::vector<std::size_t>& cells, int jobs,
               const std::function<void(std::size_t cell, std::vector<experiments::Value> row)>& done,
               const experiments::Progress& progress);

/// What a worker does. Returns the exit status.
int sweep_worker();

} // namespace clothlab::cli
