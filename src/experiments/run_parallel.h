// Runs that do not depend on each other, each in one thread, on as many cores as wanted.
#pragma once

#include <cstddef>
#include <functional>

namespace clothlab::experiments {

/// To be called often by what takes long: throws when it is to end.
using Check = std::function<void()>;

/// Calls task(0) ... task(count - 1), each once, in `threads` threads; of one, in the calling thread itself. `tell` is
/// called from the calling thread, about ten times a second, with the number of tasks done. What a task throws is
/// thrown here, of several that of the lowest number; what `tell` throws too, and then every task's Check throws
/// Cancelled.
void run_parallel(std::size_t count, int threads, const std::function<void(std::size_t task, const Check& check)>& task,
                  const std::function<void(std::size_t done)>& tell);

/// One for each core.
int all_cores();

} // namespace clothlab::experiments
