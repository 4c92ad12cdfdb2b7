// Where threads run that are to work at the same time.
#include "sim/processor.h"

#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <thread>

#include "sim/thread_pool.h"

#if defined(__linux__)
#include <sched.h>
#endif

using namespace clothlab;

namespace {

int usable_processors() {
#if defined(__linux__)
    cpu_set_t allowed;
    return sched_getaffinity(0, sizeof allowed, &allowed) == 0 ? CPU_COUNT(&allowed) : 1;
#else
    return 1;
#endif
}

} // namespace

TEST_CASE("A thread that leaves its processor is on another one, and may use all that it could before", "[threads]") {
    const int usable = usable_processors();
    if (usable < 2)
        SKIP("there is no other processor");
    constexpr int attempts = 100;
    int elsewhere = 0; // the scheduler may move the thread at any time, back too
    for (int n = 0; n < attempts; ++n) {
        const int before = sim::current_processor();
        sim::leave_processor(before);
        elsewhere += sim::current_processor() != before ? 1 : 0;
    }
    REQUIRE(elsewhere > attempts / 2);
    REQUIRE(usable_processors() == usable);
    sim::leave_processor(-1);
    sim::leave_processor(1 << 20); // no such processor: nothing happens
    REQUIRE(usable_processors() == usable);
}

TEST_CASE("Threads that are woken up work beside the one that woke them, not on its processor", "[threads]") {
    if (usable_processors() < 2)
        SKIP("there is no other processor");
    sim::ThreadPool pool(2);
    constexpr int attempts = 100;
    int beside = 0;
    for (int n = 0; n < attempts; ++n) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2)); // the other thread sleeps meanwhile
        const int callers = sim::current_processor();
        int workers = -1;
        const auto task = [&workers](int index) {
            if (index == 1)
                workers = sim::current_processor();
        };
        pool.run(2, task);
        beside += workers != callers ? 1 : 0;
    }
    REQUIRE(beside > attempts * 3 / 4);
}

TEST_CASE("A thread that waited for another one and slept goes on beside it, not on its processor", "[threads]") {
    if (usable_processors() < 2)
        SKIP("there is no other processor");
    sim::ThreadPool pool(2);
    constexpr int attempts = 100;
    int beside = 0;
    for (int n = 0; n < attempts; ++n) {
        int workers = -1;
        const auto task = [&workers](int index) {
            if (index == 0)
                return;
            const auto start = std::chrono::steady_clock::now();
            while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(1)) {
            }
            workers = sim::current_processor();
        };
        pool.run(2, task);
        beside += workers != sim::current_processor() ? 1 : 0;
    }
    REQUIRE(beside > attempts * 3 / 4);
}
