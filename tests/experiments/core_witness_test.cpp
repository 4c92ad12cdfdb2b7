// Who sees that other work shares the cores.
#include "experiments/bench/core_witness.h"

#include <atomic>
#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <thread>
#include <vector>

#include "experiments/bench/rate.h"

using namespace clothlab::experiments;

TEST_CASE("Threads are alone on their cores when they get nearly as much done as so many ever did") {
    std::vector<double> rates{100, 95, 60, 120, 200, 190};
    std::size_t asked = 0;
    CoreWitness witness([&](int) { return rates[asked++]; });
    const double first = witness.ask(1), second = witness.ask(1), third = witness.ask(1);
    REQUIRE(first == 100);
    REQUIRE(witness.alone(first, 1));
    REQUIRE(witness.alone(second, 1));
    REQUIRE_FALSE(witness.alone(third, 1));
    witness.ask(1); // more than ever: what was the best before was not
    REQUIRE_FALSE(witness.alone(first, 1));
    const double two = witness.ask(2), two_again = witness.ask(2); // compared with their like only
    REQUIRE(witness.alone(two, 2));
    REQUIRE(witness.alone(two_again, 2));
    REQUIRE(witness.alone(0, 3)); // where nothing is known
}

TEST_CASE("A rate is what all threads got done in the time from the first one's start to the last one's end",
          "[threads]") {
    std::atomic<int> prepared = 0, worked = 0;
    const double rate = best_rate(2, 3, [&] {
        ++prepared;
        return [&] {
            ++worked;
            std::this_thread::sleep_for(std::chrono::milliseconds(2)); // or longer
            return 1.0;
        };
    });
    REQUIRE(prepared == 2);
    REQUIRE(worked == 2 * 3);
    REQUIRE(rate > 0);
    REQUIRE(rate <= 2 / 0.002);
}

TEST_CASE("Additions are measured wherever the clock is", "[threads]") {
    REQUIRE((addition_rate(1) > 0) == (clock_rate() > 0));
    REQUIRE((addition_rate(2) > 0) == (clock_rate() > 0));
}
