// The yardsticks of the bench. What they measure is the machine's; that they measure something is not.
#include <array>
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <stdexcept>

#include "experiments/bench/machine_peak.h"

using namespace clothlab::experiments;

TEST_CASE("Every peak of the machine is measured, for every number of threads", "[threads]") {
    constexpr std::array threads{1, 2};
    const MachinePeak machine = measure_machine(threads);
    REQUIRE(machine.hardware_threads >= 1);
    REQUIRE(machine.clock_ghz >= 0);
    REQUIRE_FALSE(machine.vectors.empty());
    REQUIRE(machine.by_threads.size() == 2);
    for (const int count : threads) {
        const ThreadPeak& peak = machine.with(count);
        REQUIRE(peak.threads == count);
        REQUIRE(peak.single_gflops > 0);
        REQUIRE(peak.double_gflops > 0);
        for (const double bandwidth : peak.bandwidth)
            REQUIRE(bandwidth > 0);
    }
    REQUIRE_THROWS_AS(machine.with(3), std::out_of_range);
}

TEST_CASE("Bytes belong to the innermost level that holds them, of all the cores that share them out") {
    MachinePeak machine;
    machine.levels = {MemoryLevel{"L1", 1000, true}, MemoryLevel{"L2", 10'000, true}, MemoryLevel{"L3", 50'000, false},
                      MemoryLevel{"memory", 0, false}};
    REQUIRE(machine.level_of(1000, 1) == 0);
    REQUIRE(machine.level_of(1001, 1) == 1);
    REQUIRE(machine.level_of(2000, 2) == 0);
    REQUIRE(machine.level_of(20'000, 2) == 1);
    REQUIRE(machine.level_of(50'000, 2) == 2);
    REQUIRE(machine.level_of(50'001, 2) == 3);
}

TEST_CASE("Of two measurements the better one counts, and how far they are apart is told") {
    MachinePeak one;
    one.clock_ghz = 4;
    one.by_threads = {ThreadPeak{1, 100, 50, {500, 300, 100, 50}}, ThreadPeak{2, 200, 100, {900, 500, 200, 60}}};
    REQUIRE(best_of(one, one).steadiness == 1);
    MachinePeak other = one;
    other.clock_ghz = 3;
    other.by_threads[1] = ThreadPeak{2, 150, 110, {1000, 400, 200, 60}};
    const MachinePeak best = best_of(one, other);
    REQUIRE(best.steadiness == 0.75);
    REQUIRE(best.clock_ghz == 4);
    REQUIRE(best.with(2).single_gflops == 200);
    REQUIRE(best.with(2).double_gflops == 110);
    REQUIRE(best.with(2).bandwidth == std::array<double, memory_levels>{1000, 500, 200, 60});
}
