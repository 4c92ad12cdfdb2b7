// A small pool of threads that belongs to one simulation: they wait for the next stage of a step, first spinning, since
// it comes within microseconds, then asleep.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

namespace clothlab::sim {

class ThreadPool {
public:
    /// A pool of so many threads, the caller's own among them.
    explicit ThreadPool(int threads);
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    int threads() const { return static_cast<int>(workers_.size()) + 1; }

    /// Calls task(0) here and task(1) ... task(count - 1) on the other threads, and returns when all are done. The
    /// tasks may not throw. To be called from one thread at a time.
    template <class Task>
    void run(int count, const Task& task) {
        if (count > 1)
            start(
                count, [](const void* context, int index) { (*static_cast<const Task*>(context))(index); }, &task);
        task(0);
        if (count > 1)
            finish();
    }

private:
    using Call = void (*)(const void*, int);
    void start(int count, Call call, const void* context);
    void finish();
    void work(int index);

    // Each on a cache line of its own: one is written by the caller, the other by the workers.
    alignas(64) std::atomic<std::uint64_t> ticket_{0}; ///< a running number, and how many threads it is for
    Call call_ = nullptr;
    const void* context_ = nullptr;
    alignas(64) std::atomic<int> unfinished_{0};
    alignas(64) std::vector<std::thread> workers_;
};

} // namespace clothlab::sim
