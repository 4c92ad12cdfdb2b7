// The distance of two branches over time, computed in a thread of its own. Neither call of the window's ever waits for
// a frame.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "timeline/comparison.h"

namespace clothlab::app {

class ComparisonJob {
public:
    explicit ComparisonJob(const sim::Execution& execution = {});
    /// Ends after the frame under way.
    ~ComparisonJob();
    ComparisonJob(const ComparisonJob&) = delete;
    ComparisonJob& operator=(const ComparisonJob&) = delete;

    /// Compares two lines of a copy of a timeline. Another pair than before begins anew; for the same pair, in a newer
    /// copy of the same timeline, the curve goes on where it is. stop() before a copy of another timeline, whose
    /// branches may have the same numbers.
    void compare(timeline::Timeline timeline, timeline::BranchId a, timeline::BranchId b);
    /// Forgets the pair and its curve.
    void stop();

    struct Result {
        timeline::BranchId a = 0, b = 0;                                      ///< 0: nothing is compared
        std::shared_ptr<const std::vector<timeline::DistanceSample>> samples; ///< as far as computed; null: none yet
        double progress = 0;                                                  ///< 0 to 1
        std::string error; ///< a sentence, when a stored state could not be read; the curve ends there
    };
    Result latest() const;
    /// Waits until all that was asked for so far is computed: for tests, not for the window.
    void finish();

private:
    using Clock = std::chrono::steady_clock;
    struct Wanted {
        timeline::Timeline timeline;
        timeline::BranchId a = 0, b = 0; ///< 0: nothing
        std::uint64_t pair = 0;
    };
    void run();
    void work(std::uint64_t pair, std::optional<timeline::Comparison>& comparison);
    void publish(std::uint64_t pair, const timeline::Comparison& comparison, std::string error);

    sim::Execution execution_;
    mutable std::mutex mutex_; ///< held for moments only
    std::condition_variable wake_, idle_;
    std::optional<Wanted> wanted_;
    Result published_;
    std::uint64_t pair_ = 0;         ///< counts the pairs that were wanted
    Clock::time_point published_at_; ///< the thread's own
    bool busy_ = false, quit_ = false;
    std::thread thread_;
};

} // namespace clothlab::app
