#include "app/core/experiment_job.h"

#include <utility>

namespace clothlab::app {

ExperimentJob::~ExperimentJob() {
    cancel();
    if (thread_.joinable())
        thread_.join();
}

bool ExperimentJob::start(Work work) {
    {
        const std::lock_guard lock(mutex_);
        if (status_ || result_)
            return false;
        status_ = Status{};
        begin_ = Clock::now();
    }
    if (thread_.joinable())
        thread_.join(); // has ended
    cancelled_ = false;
    thread_ = std::thread([this, work = std::move(work)] { run(work); });
    return true;
}

void ExperimentJob::run(const Work& work) {
    Result result;
    const experiments::Progress progress{[this](double share, const std::string& what) {
        const std::lock_guard lock(mutex_);
        status_->share = share;
        status_->what = what;
        return !cancelled_;
    }};
    try {
        result.findings = work(progress);
    } catch (const experiments::Cancelled&) {
    } catch (const std::exception& e) {
        result.error = e.what();
    }
    const std::lock_guard lock(mutex_);
    result_ = std::move(result);
    status_.reset();
}

std::optional<ExperimentJob::Status> ExperimentJob::status() const {
    const std::lock_guard lock(mutex_);
    std::optional<Status> now = status_;
    if (now)
        now->elapsed_s = std::chrono::duration<double>(Clock::now() - begin_).count();
    return now;
}

std::optional<ExperimentJob::Result> ExperimentJob::take_result() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

} // namespace clothlab::app
