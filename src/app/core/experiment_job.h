// An experiment of the lab's, in a thread of its own. No call of the window's waits for it.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "experiments/findings.h"

namespace clothlab::app {

class ExperimentJob {
public:
    using Work = std::function<experiments::Findings(const experiments::Progress&)>;

    ExperimentJob() = default;
    /// Cancels what is under way and waits until it has ended.
    ~ExperimentJob();
    ExperimentJob(const ExperimentJob&) = delete;
    ExperimentJob& operator=(const ExperimentJob&) = delete;

    /// False, and nothing happens, while another one is under way or its result has not been taken.
    bool start(Work work);
    /// Ends it as soon as it next tells its progress.
    void cancel() { cancelled_ = true; }

    struct Status {
        double share = 0; ///< done, 0 to 1
        std::string what; ///< is done now
        double elapsed_s = 0;
    };
    /// None when nothing is under way.
    std::optional<Status> status() const;

    struct Result {
        std::optional<experiments::Findings> findings;
        std::string error; ///< why there are none; empty when it was cancelled
    };
    /// Once, when it has ended.
    std::optional<Result> take_result();

private:
    using Clock = std::chrono::steady_clock;
    void run(const Work& work);

    mutable std::mutex mutex_; ///< held for moments only
    std::optional<Status> status_;
    std::optional<Result> result_;
    Clock::time_point begin_;
    std::atomic<bool> cancelled_ = false;
    std::thread thread_;
};

} // namespace clothlab::app
