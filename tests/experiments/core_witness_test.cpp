// Who sees that other work shares the cores.
#include "experiments/bench/core_witness.h"

#include <catch2/catch_test_macros.hpp>
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

TEST_CASE("Additions side by side are more per second than those that wait for each other", "[threads]") {
    const double clock = clock_rate();
    if (clock == 0)
        SKIP("this compiler cannot be told to add");
    REQUIRE(addition_rate(1) > 1.2 * clock); // by how many: two units at least, less what the loop and the rest take
    REQUIRE(addition_rate(2) > 0);
}
