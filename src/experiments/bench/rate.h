// How much work threads get done together in a second.
#pragma once

#include <functional>

namespace clothlab::experiments {

/// The most work per second that threads get done together in some tries. A thread calls `prepare()` for what it works
/// on, once, and then what it got for each try; that returns the amount of work done.
double best_rate(int threads, int tries, const std::function<std::function<double()>()>& prepare);

/// The clock of a core under load, Hz: integer additions of which each needs the one before, one per cycle on every
/// processor of today. 0 where the compiler knows no way to insist on additions.
double clock_rate();

/// Integer additions per second that threads get done together now, as many side by side as a core has units for.
/// These see more of other work than fused multiply-adds do: a neighbour that shares the core takes turns in starting
/// instructions, whatever they are. Takes a millisecond. 0 as for clock_rate.
double addition_rate(int threads);

} // namespace clothlab::experiments
