#include "sim/thread_choice.h"

#include <algorithm>
#include <limits>

namespace clothlab::sim {
namespace {

/// Each candidate is timed over so many steps, in so many rounds, and its fastest block counts: what else the machine
/// does only ever makes one slower.
constexpr int block = 8, rounds = 4;
/// Contacts come and go: look again after so many steps.
constexpr std::uint64_t steps_between = 8192;
/// More threads have to be worth their cores.
constexpr double worth = 0.95;
/// While several threads are used, so many steps at a time are timed; if they take this much longer than with one
/// thread, something else needs the machine, and one thread goes on alone until the next measurement.
constexpr int watched = 32;
constexpr double patience = 1.5;

} // namespace

ThreadChoice::ThreadChoice(int most, bool fewer_if_faster) {
    if (fewer_if_faster)
        for (int n = 1; n < most; n *= 2)
            candidates_.push_back(n);
    candidates_.push_back(std::max(most, 1));
    best_.resize(candidates_.size());
    restart();
}

void ThreadChoice::restart() {
    measuring_ = candidates_.size() > 1;
    now_ = 0;
    step_ = round_ = 0;
    std::fill(best_.begin(), best_.end(), std::numeric_limits<double>::infinity());
}

void ThreadChoice::end_step() {
    if (candidates_.size() == 1)
        return;
    const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start_).count(); };
    if (!measuring_) {
        if (--until_restart_ == 0)
            return restart();
        if (now_ == 0 || ++step_ < watched)
            return;
        step_ = 0;
        if (seconds() / watched > patience * best_[0] / block)
            now_ = 0;
        return;
    }
    if (++step_ < block)
        return;
    step_ = 0;
    best_[now_] = std::min(best_[now_], seconds());
    if (++now_ < candidates_.size())
        return;
    now_ = 0;
    if (++round_ < rounds)
        return;
    for (std::size_t i = 1; i < best_.size(); ++i)
        if (best_[i] < worth * best_[now_])
            now_ = i;
    measuring_ = false;
    until_restart_ = steps_between;
}

} // namespace clothlab::sim
