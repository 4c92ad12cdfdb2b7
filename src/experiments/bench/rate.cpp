#include "experiments/bench/rate.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>
#include <utility>
#include <vector>

#include "sim/processor.h"

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
    explicit Gate(int threads) : threads_(threads) {}
    /// Returns when all threads have come for the nth time, n from 1 on.
    void pass(int n) {
        arrived_.fetch_add(1, std::memory_order_acq_rel);
        for (int i = 0; arrived_.load(std::memory_order_acquire) < n * threads_; ++i)
            if (i > 1000)
                std::this_thread::yield(); // more threads than processors
    }

private:
    int threads_;
    std::atomic<int> arrived_ = 0;
};

} // namespace

double best_rate(int threads, int tries, const std::function<std::function<double()>()>& prepare) {
    struct Try {
        Clock::time_point start, end;
        double work = 0;
    };
    std::vector<std::vector<Try>> all(static_cast<std::size_t>(threads),
                                      std::vector<Try>(static_cast<std::size_t>(tries)));
    Gate together(threads);
    const auto run = [&](std::vector<Try>& own) {
        const std::function<double()> work = prepare();
        int number = 0;
        for (Try& t : own) {
            together.pass(++number);
            t.start = Clock::now();
            t.work = work();
            t.end = Clock::now();
        }
    };
    {
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < all.size(); ++i)
            others.emplace_back([&run, &own = all[i], callers = sim::current_processor()] {
                if (sim::current_processor() == callers)
                    sim::leave_processor(callers);
                run(own);
            });
        run(all.front());
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
