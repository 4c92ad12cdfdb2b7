// How much of a stage's points each thread gets. Threads that share out a stage evenly wait for the slowest of them: a
// core may be slower than another by its kind, or since half of it does something else, and it begins a little later.
#pragma once

#include <algorithm>
#include <cstddef>

namespace clothlab::sim {

/// The pace of the calling thread of a pool as against that of the others, learned from who is done last with work that
/// takes as long for each point. It costs no look at a clock, and changes no bit of a result.
class Pace {
public:
    /// Where part `index` of `count` begins, of `total` points. Part 0 is the calling thread's.
    std::size_t from(std::size_t index, std::size_t count, std::size_t total) const {
        if (index == 0 || index >= count)
            return index == 0 ? 0 : total;
        const auto others = static_cast<double>(count - 1);
        const auto first = static_cast<std::size_t>(static_cast<double>(total) * pace_ / (pace_ + others));
        return first + (total - first) * (index - 1) / (count - 1);
    }
    /// To be told after each such stage whether the others were still at work when the calling thread was done.
    void learn(bool others_were_last) {
        in_a_row_ = others_were_last == others_before_ ? std::min(in_a_row_ + 1, enough) : 1;
        others_before_ = others_were_last;
        if (in_a_row_ == enough)
            pace_ = std::clamp(others_were_last ? pace_ * more : pace_ / more, slowest, fastest);
    }
    double pace() const { return pace_; }
    /// How many points part `index` of `count` can come to have at the most, whatever is learned.
    static std::size_t most(std::size_t index, std::size_t count, std::size_t total) {
        const auto others = static_cast<double>(count - 1);
        const double share = index == 0 ? fastest / (fastest + others) : 1 / (slowest + others);
        return std::min(static_cast<std::size_t>(static_cast<double>(total) * share) + 2, total);
    }

private:
    static constexpr double slowest = 0.5, fastest = 2;
    /// Near the right pace either is last by chance; what has not been so this often in a row changes nothing, since
    /// points that go to another thread have to be fetched by it.
    static constexpr int enough = 3;
    static constexpr double more = 1.02;
    double pace_ = 1;
    bool others_before_ = false; ///< what was told before
    int in_a_row_ = 0;           ///< so many times, and not more than enough
};

} // namespace clothlab::sim
