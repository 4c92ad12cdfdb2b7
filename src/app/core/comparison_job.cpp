#include "app/core/comparison_job.h"

#include <chrono>
#include <utility>

namespace clothlab::app {
namespace {

/// Not more often: each publication is a copy.
constexpr std::chrono::milliseconds publish_interval{100};

} // namespace

ComparisonJob::ComparisonJob(const sim::Execution& execution) : execution_(execution), thread_([this] { run(); }) {}

ComparisonJob::~ComparisonJob() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void ComparisonJob::compare(timeline::Timeline timeline, timeline::BranchId a, timeline::BranchId b) {
    {
        const std::lock_guard lock(mutex_);
        if (published_.a != a || published_.b != b) {
            ++pair_;
            published_ = {a, b, nullptr, 0, ""};
        }
        wanted_ = Wanted{std::move(timeline), a, b, pair_};
    }
    wake_.notify_one();
}

void ComparisonJob::stop() {
    {
        const std::lock_guard lock(mutex_);
        ++pair_;
        published_ = {};
        wanted_ = Wanted{timeline::Timeline(), 0, 0, pair_};
    }
    wake_.notify_one();
}

ComparisonJob::Result ComparisonJob::latest() const {
    const std::lock_guard lock(mutex_);
    return published_;
}

void ComparisonJob::finish() {
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [this] { return !wanted_ && !busy_; });
}

void ComparisonJob::publish(std::uint64_t pair, const timeline::Comparison& comparison, std::string error) {
    auto samples = std::make_shared<const std::vector<timeline::DistanceSample>>(comparison.samples());
    const double progress = error.empty() ? comparison.progress() : 1;
    published_at_ = Clock::now();
    const std::lock_guard lock(mutex_);
    if (pair != pair_) // nobody wants that any more
        return;
    published_.samples = std::move(samples);
    published_.progress = progress;
    published_.error = std::move(error);
}

void ComparisonJob::work(std::uint64_t pair, std::optional<timeline::Comparison>& comparison) {
    const auto called = [this] {
        const std::lock_guard lock(mutex_);
        return quit_ || wanted_;
    };
    try {
        while (comparison->advance()) {
            if (Clock::now() - published_at_ >= publish_interval)
                publish(pair, *comparison, "");
            if (called())
                return;
        }
        publish(pair, *comparison, "");
    } catch (const std::exception& e) {
        publish(pair, *comparison, e.what());
        comparison.reset();
    }
}

void ComparisonJob::run() {
    std::optional<timeline::Comparison> comparison;
    std::uint64_t pair = 0; // that it is of
    for (;;) {
        Wanted wanted;
        {
            std::unique_lock lock(mutex_);
            busy_ = false;
            if (!wanted_)
                idle_.notify_all();
            wake_.wait(lock, [this] { return quit_ || wanted_; });
            if (quit_)
                return;
            wanted = std::move(*wanted_);
            wanted_.reset();
            busy_ = true;
        }
        if (wanted.pair != pair) {
            comparison.reset();
            pair = wanted.pair;
            if (wanted.a != 0)
                comparison.emplace(std::move(wanted.timeline), wanted.a, wanted.b, execution_);
        } else if (comparison) {
            comparison->grow(std::move(wanted.timeline));
        }
        if (comparison)
            work(pair, comparison);
    }
}

} // namespace clothlab::app
