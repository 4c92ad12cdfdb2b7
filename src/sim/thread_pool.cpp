#include "sim/thread_pool.h"

#include <algorithm>

#include "sim/processor.h"
#include "sim/spin.h"

namespace clothlab::sim {
namespace {

constexpr std::uint64_t count_bits = 16, count_mask = (1u << count_bits) - 1, quit = count_mask;

/// Waits until the value is another than `old`; returns it.
template <class T>
T await_change(const std::atomic<T>& value, T old) {
    Spin spin;
    do {
        if (const T now = value.load(std::memory_order_acquire); now != old)
            return now;
    } while (spin.again());
    value.wait(old, std::memory_order_acquire);
    return value.load(std::memory_order_acquire);
}

void leave_if_on(int processor) {
    if (current_processor() == processor)
        leave_processor(processor);
}

} // namespace

ThreadPool::ThreadPool(int threads) {
    for (int i = 1; i < std::min(threads, static_cast<int>(count_mask) - 1); ++i)
        workers_.emplace_back([this, i] { work(i); });
}

ThreadPool::~ThreadPool() {
    ticket_.fetch_or(quit);
    ticket_.notify_all();
    for (std::thread& worker : workers_)
        worker.join();
}

void ThreadPool::start(int count, Call call) {
    call_ = call;
    callers_processor_ = current_processor();
    unfinished_.store(count - 1, std::memory_order_relaxed);
    const std::uint64_t number = (ticket_.load(std::memory_order_relaxed) >> count_bits) + 1;
    ticket_.store((number << count_bits) | static_cast<std::uint64_t>(count));
    ticket_.notify_all();
}

bool ThreadPool::finish() {
    int left = unfinished_.load(std::memory_order_acquire);
    const bool others_were_last = left != 0;
    while (left != 0)
        left = await_change(unfinished_, left);
    if (others_were_last)
        leave_if_on(finishers_processor_.load(std::memory_order_relaxed));
    return others_were_last;
}

void ThreadPool::work(int index) {
    for (std::uint64_t seen = 0;;) {
        seen = await_change(ticket_, seen);
        const std::uint64_t count = seen & count_mask;
        if (count == quit)
            return;
        // A ticket that is not for this thread may be replaced by the next at any time: nothing else may be read then.
        if (static_cast<std::uint64_t>(index) >= count)
            continue;
        leave_if_on(callers_processor_);
        call_(task_.data(), index);
        finishers_processor_.store(current_processor(), std::memory_order_relaxed);
        if (unfinished_.fetch_sub(1, std::memory_order_acq_rel) == 1)
            unfinished_.notify_one();
    }
}

} // namespace clothlab::sim
