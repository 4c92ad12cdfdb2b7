#include "experiments/bench/rate.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>
#include <utility>
#include <vector>

#include "sim/processor.h"
#include "sim/spin.h"

namespace clothlab::experiments {
namespace {

using Clock = std::chrono::steady_clock;

#if defined(__GNUC__)
/// Additions in so many chains side by side. Returns their number.
template <std::size_t... chain>
double add(int rounds, std::index_sequence<chain...>) {
    constexpr int unrolled = 4;
    unsigned long x[] = {chain...}, step = 3;
    asm volatile("" : "+r"(step)); // not a constant: some processors add constants in no time
    const auto once = [&](unsigned long& sum) __attribute__((always_inline)) {
        sum += step;
        asm volatile("" : "+r"(sum)); // the compiler must do each addition
    };
    for (int n = 0; n < rounds; ++n)
        for (int i = 0; i < unrolled; ++i)
            (once(x[chain]), ...);
    return static_cast<double>(rounds) * unrolled * sizeof...(chain);
}
#endif

template <std::size_t chains>
double additions(int threads, int tries, int rounds) {
#if defined(__GNUC__)
    return best_rate(threads, tries, [=] { return [=] { return add(rounds, std::make_index_sequence<chains>()); }; });
#else
    return 0;
#endif
}

/// Where threads wait for each other without going to sleep: who is woken up is put on the processor of the one who
/// wakes it, now and then, and stays there for some milliseconds.
class Gate {
public:
    explicit Gate(std::size_t threads) : processors_(threads) {}
    /// A thread's pass, its nth one, n from 1 on: returns when all have come, each on a processor of its own, if there
    /// are enough.
    void pass(std::size_t thread, std::size_t n) {
        const int here = sim::current_processor();
        processors_[thread].store(here, std::memory_order_relaxed);
        wait_for_all(2 * n - 1);
        const auto taken = [&](const std::atomic<int>& other) { return other.load(std::memory_order_relaxed) == here; };
        if (std::any_of(processors_.begin(), processors_.begin() + static_cast<std::ptrdiff_t>(thread), taken))
            sim::leave_processor(here);
        wait_for_all(2 * n);
    }

private:
    void wait_for_all(std::size_t times) {
        arrived_.fetch_add(1, std::memory_order_acq_rel);
        for (sim::Spin spin; arrived_.load(std::memory_order_acquire) < times * processors_.size();)
            spin.again();
    }
    std::vector<std::atomic<int>> processors_; ///< by thread
    std::atomic<std::size_t> arrived_ = 0;
};

} // namespace

double best_rate(int threads, int tries, const std::function<std::function<double()>()>& prepare) {
    struct Try {
        Clock::time_point start, end;
        double work = 0;
    };
    std::vector<std::vector<Try>> all(static_cast<std::size_t>(threads),
                                      std::vector<Try>(static_cast<std::size_t>(tries)));
    Gate together(all.size());
    const auto run = [&](std::size_t thread) {
        const std::function<double()> work = prepare();
        for (std::size_t n = 0; n < all[thread].size(); ++n) {
            Try& t = all[thread][n];
            together.pass(thread, n + 1);
            t.start = Clock::now();
            t.work = work();
            t.end = Clock::now();
        }
    };
    {
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < all.size(); ++i)
            others.emplace_back([&run, i] { run(i); });
        run(0);
    }
    double best = 0;
    for (std::size_t n = 0; n < static_cast<std::size_t>(tries); ++n) {
        Try total = all.front()[n];
        for (std::size_t i = 1; i < all.size(); ++i) {
            total.start = std::min(total.start, all[i][n].start);
            total.end = std::max(total.end, all[i][n].end);
            total.work += all[i][n].work;
        }
        best = std::max(best, total.work / std::chrono::duration<double>(total.end - total.start).count());
    }
    return best;
}

double clock_rate() {
    return additions<1>(1, 8, 800'000);
}

double addition_rate(int threads) {
    return additions<8>(threads, 3, 1 << 17); // threads that have just begun start the first together but roughly
}

} // namespace clothlab::experiments
