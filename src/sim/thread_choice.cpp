#include "sim/thread_choice.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace clothlab::sim {
namespace {

/// Each candidate is timed over so many steps at least, in so many rounds, and its fastest block counts: what else the
/// machine does only ever makes one slower.
constexpr int block = 8, rounds = 4;
/// Contacts come and go. A run looks again after so many steps at the latest, and before, where steps have become
/// another work: after `soon` steps, and later each time that it brings nothing. They have where they take so many
/// times as long as they did, or so many times less, without a break for so many times `watched` steps: what else the
/// machine does comes and goes.
constexpr int steps_between = 8192, soon = 512, without_break = 8;
constexpr double another = 1.4;
/// A block that takes so many times as long as with one thread is the last one: its threads are held up.
constexpr double hopeless = 3;
/// More threads have to be worth their cores.
constexpr double worth = 0.95;
/// While several threads are used, so many steps at least at a time are timed; if they take this much longer than with
/// one thread, something else needs the machine, and one thread goes on alone: for `soon` steps, and for twice as many
/// each time that it happens again. A moment's hold-up should not cost seconds, nor should looking again all the time.
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
    seconds_ = 0;
    std::fill(best_.begin(), best_.end(), std::numeric_limits<double>::infinity());
}

int ThreadChoice::next_time_alone() {
    return std::exchange(alone_for_, std::min(2 * alone_for_, steps_between));
}

void ThreadChoice::end_step(int steps) {
    if (candidates_.size() == 1)
        return;
    seconds_ += std::chrono::duration<double>(Clock::now() - start_).count();
    step_ += steps;
    if (!measuring_) {
        since_ += steps;
        if (since_ >= until_) {
            if (until_ == steps_between)
                alone_for_ = soon;
            return restart();
        }
        if (step_ < watched)
            return;
        const double now = std::exchange(seconds_, 0) / std::exchange(step_, 0), then = best_[now_];
        round_ = now > another * then || now * another < then ? round_ + 1 : 0;
        if (now_ != 0 && now > patience * best_[0]) {
            now_ = 0;
            since_ = 0;
            until_ = next_time_alone();
        } else if (since_ >= patient_for_ && round_ >= without_break)
            restart();
        return;
    }
    if (step_ < block)
        return;
    const double took = std::exchange(seconds_, 0) / std::exchange(step_, 0);
    const bool held_up = took > hopeless * best_[0];
    if (held_up)
        round_ = rounds - 1; // the last one
    best_[now_] = std::min(best_[now_], took);
    if (++now_ < candidates_.size())
        return;
    now_ = 0;
    if (++round_ < rounds)
        return;
    for (std::size_t i = 1; i < best_.size(); ++i)
        if (best_[i] < worth * best_[now_])
            now_ = i;
    if (!held_up) // which says nothing of what the steps are
        patient_for_ = now_ == before_ ? std::min(2 * patient_for_, steps_between) : soon;
    before_ = now_;
    measuring_ = false;
    round_ = since_ = 0;
    until_ = held_up ? next_time_alone() : steps_between;
}

} // namespace clothlab::sim
