// How a thread waits for another one that it expects within microseconds.
#pragma once

#include <algorithm>
#include <thread>

#include <hwy/cache_control.h>

namespace clothlab::sim {

/// Counts how often a thread has looked in vain for what it waits for.
class Spin {
public:
    /// Pauses for a moment, before the next look, and now and then lets another thread have this processor: the one
    /// that is waited for may wait for it. Returns whether it still is worth looking: for some two hundred
    /// microseconds, longer than the stages that one thread does alone take in a small cloth, and than a virtual core
    /// that sleeps takes to wake up. With less, two threads would fall asleep by turns, each before the other has woken
    /// up.
    bool again() {
        looks_ = std::min(looks_ + 1, most_looks); // who never sleeps may look for minutes
        if (looks_ % looks_until_yield == 0 || looks_ == most_looks)
            std::this_thread::yield();
        else
            hwy::Pause();
        return looks_ < most_looks;
    }

private:
    static constexpr int looks_until_yield = 256; ///< some three microseconds
    static constexpr int most_looks = 16'000;
    int looks_ = 0;
};

} // namespace clothlab::sim
