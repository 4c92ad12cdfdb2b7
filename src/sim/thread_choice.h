// How many threads a run's steps use: measured, not guessed. The number changes no bit of the result.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

namespace clothlab::sim {

class ThreadChoice {
public:
    ThreadChoice() : ThreadChoice(1, false) {}
    /// Up to `most` threads; fewer where steps are found to be faster with fewer, if that is wanted.
    ThreadChoice(int most, bool fewer_if_faster);

    /// Threads for the next step.
    int threads() const { return candidates_[now_]; }
    /// To be called before and after each step.
    void begin_step() {
        if (candidates_.size() > 1 && step_ == 0)
            start_ = Clock::now();
    }
    void end_step();
    /// Measures again: the scene has changed.
    void restart();

private:
    using Clock = std::chrono::steady_clock;
    std::vector<int> candidates_; ///< 1, 2, 4, ..., most
    std::vector<double> best_;    ///< s, fastest block of steps of each
    std::size_t now_ = 0;
    bool measuring_ = false;
    int step_ = 0, round_ = 0;
    std::uint64_t until_restart_ = 0;
    Clock::time_point start_; ///< of the block under way
};

} // namespace clothlab::sim
