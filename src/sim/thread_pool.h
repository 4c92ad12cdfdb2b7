// A small pool of threads that belongs to one simulation: they wait for the next stage of a step, first spinning, since
// it comes within microseconds, then asleep.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <thread>
#include <type_traits>
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

    /// Calls task(0) here and task(1) ... task(count - 1) on the other threads, and returns when all are done:
    /// whether the others still were at work when the calling thread had done its own. The tasks may not throw. To be
    /// called from one thread at a time.
    ///
    /// The task is copied for the others: what it holds by value reaches them at once, where references to the caller's
    /// stack would have to be fetched one after the other, from lines that the caller goes on writing to: 3 % of the
    /// sweep of 50 x 50 points on two threads.
    template <class Task>
    bool run(int count, const Task& task) {
        static_assert(std::is_trivially_copyable_v<Task> && sizeof(Task) <= task_room && alignof(Task) <= 64);
        if (count > 1) {
            std::memcpy(task_.data(), &task, sizeof task);
            start(count, [](const void* copy, int index) { (*static_cast<const Task*>(copy))(index); });
        }
        task(0);
        return count > 1 && finish();
    }

private:
    using Call = void (*)(const void*, int);
    void start(int count, Call call);
    bool finish();
    void work(int index);

    static constexpr std::size_t task_room = 320; ///< bytes

    // Each on cache lines of its own: what the workers watch, what they read then, and what they write.
    alignas(64) std::atomic<std::uint64_t> ticket_{0}; ///< a running number, and how many threads it is for
    alignas(64) std::array<std::byte, task_room> task_{};
    Call call_ = nullptr;
    // Who is woken up and finds itself on the processor of the one who woke it moves away: both are to work at the same
    // time.
    int callers_processor_ = -1;
    alignas(64) std::atomic<int> unfinished_{0};
    std::atomic<int> finishers_processor_{-1}; ///< of the worker that was done last
    alignas(64) std::vector<std::thread> workers_;
};

} // namespace clothlab::sim
