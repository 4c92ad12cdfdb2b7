// Whether threads had cores of their own while something was timed. Machines are shared: another program, or another
// virtual machine, can run beside a thread on the same core, minutes on end, or two of our threads on one; then a loop
// that keeps a core busy takes 1.2 to 2 times as long, and one that waits for memory hardly longer. No clock or counter
// tells; what the cores get done does.
#pragma once

#include <functional>
#include <map>

#include "experiments/bench/rate.h"

namespace clothlab::experiments {

class CoreWitness {
public:
    /// Told how to measure what a number of threads get done per second, now.
    explicit CoreWitness(std::function<double(int threads)> rate = addition_rate);

    /// What so many threads get done now, to be judged by alone() when the most is known.
    double ask(int threads);
    /// Whether a rate that was measured says that no thread shared its core: at least nine tenths of the most that so
    /// many threads ever got done.
    bool alone(double rate, int threads) const;

private:
    std::function<double(int)> rate_;
    std::map<int, double> best_; ///< by number of threads
};

} // namespace clothlab::experiments
