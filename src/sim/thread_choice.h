// How many threads a run's steps use: measured, not guessed. The number changes no bit of the result.
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

namespace clothlab::sim {

class ThreadChoice {
public:
    ThreadChoice() : ThreadChoice(1, false) {}
    /// Up to `most` threads; fewer where steps are found to be faster with fewer, if that is wanted.
    ThreadChoice(int most, bool fewer_if_faster);

    /// Threads for the next step.
    int threads() const { return candidates_[now_]; }
    /// To be called before and after each step, or several that are taken at once.
    void begin_step() {
        if (candidates_.size() > 1)
            start_ = Clock::now();
    }
    void end_step(int steps = 1);
    /// Measures again: the scene has changed.
    void restart();

private:
    /// Steps for which one thread goes on alone, since several were held up.
    int next_time_alone();

    using Clock = std::chrono::steady_clock;
    std::vector<int> candidates_; ///< 1, 2, 4, ..., most
    std::vector<double> best_;    ///< s, a step of the fastest block of each
    std::size_t now_ = 0;
    bool measuring_ = false;
    int step_ = 0, round_ = 0;
    int since_ = 0;           ///< steps since it was measured, or since several threads were held up
    int until_ = 0;           ///< so many: then it is measured again
    int alone_for_ = 512;     ///< steps with one thread when several are held up the next time
    int patient_for_ = 256;   ///< steps at least until it is measured again
    std::size_t before_ = 0;  ///< what was measured to be best the last time
    double seconds_ = 0;      ///< that the steps of the block under way have taken, without what was between them
    Clock::time_point start_; ///< of the step under way
};

} // namespace clothlab::sim
