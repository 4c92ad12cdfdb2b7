#include "experiments/run_parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "experiments/findings.h"

namespace clothlab::experiments {

namespace {

constexpr std::chrono::milliseconds between_tells{100};

void run_here(std::size_t count, const std::function<void(std::size_t, const Check&)>& task,
              const std::function<void(std::size_t)>& tell) {
    std::size_t done = 0;
    auto told = std::chrono::steady_clock::now();
    tell(0);
    const Check check = [&] {
        const auto now = std::chrono::steady_clock::now();
        if (now - told < between_tells)
            return;
        told = now;
        tell(done);
    };
    for (; done < count; ++done)
        task(done, check);
    tell(count);
}

} // namespace

void run_parallel(std::size_t count, int threads, const std::function<void(std::size_t, const Check&)>& task,
                  const std::function<void(std::size_t)>& tell) {
    if (threads <= 1)
        return run_here(count, task, tell);
    std::atomic<bool> stop = false;
    std::mutex mutex;
    std::condition_variable ended;
    std::size_t next = 0, done = 0, failed = count, workers_left = 0; // under the mutex
    std::exception_ptr failure;
    const Check check = [&] {
        if (stop)
            throw Cancelled();
    };
    const auto work = [&] {
        std::unique_lock lock(mutex);
        while (next < count && !stop && failed == count) {
            const std::size_t i = next++;
            lock.unlock();
            std::exception_ptr thrown;
            try {
                task(i, check);
            } catch (...) {
                thrown = std::current_exception();
            }
            lock.lock();
            ++done;
            if (thrown && i < failed) {
                failed = i;
                failure = thrown;
            }
        }
        if (--workers_left == 0)
            ended.notify_one();
    };

    std::exception_ptr told;
    {
        std::vector<std::jthread> pool;
        const std::size_t wanted = std::min(count, static_cast<std::size_t>(threads));
        workers_left = wanted;
        for (std::size_t i = 0; i < wanted; ++i)
            pool.emplace_back(work);
        std::unique_lock lock(mutex);
        while (workers_left > 0) {
            const std::size_t now = done;
            lock.unlock();
            try {
                if (!told)
                    tell(now);
            } catch (...) {
                told = std::current_exception();
                stop = true;
            }
            lock.lock();
            ended.wait_for(lock, between_tells, [&] { return workers_left == 0; });
        }
    }
    if (told)
        std::rethrow_exception(told);
    if (failure)
        std::rethrow_exception(failure);
    tell(count);
}

int all_cores() {
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

} // namespace clothlab::experiments
