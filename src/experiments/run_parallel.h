// Runs that do not depend on each other, each in one thread, on as many cores as wanted.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace clothlab::experiments {

/// Calls task(0) ... task(count - 1), each once, in `threads` threads; `tell` is called from the calling thread, about
/// ten times a second, with the number of tasks done. What a task throws is thrown here, of several that of the lowest
/// number; what `tell` throws too, and then `stop`, which every task is given, becomes true: a task that sees it is to
/// end as soon as it can, with whatever it likes to throw.
void run_parallel(std::size_t count, int threads,
                  const std::function<void(std::size_t task, const std::atomic<bool>& stop)>& task,
                  const std::function<void(std::size_t done)>& tell);

/// One for each core.
int all_cores();

} // namespace clothlab::experiments
