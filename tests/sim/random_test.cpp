// The one random sequence that scenes rely on.
#include "sim/random.h"

#include <catch2/catch_test_macros.hpp>

#include "support/reference_simulator.h"

using clothlab::sim::SplitMix64;

TEST_CASE("SplitMix64 gives its published sequence") {
    SplitMix64 random(0);
    REQUIRE(random.next() == 0xe220a8397b1dcdafu);
    REQUIRE(random.next() == 0x6e789e6aa1b965f4u);
    REQUIRE(random.next() == 0x06c45d188009454fu);
    for (const std::uint64_t seed : {std::uint64_t{1}, std::uint64_t{42}, ~std::uint64_t{0}}) {
        SplitMix64 ours(seed);
        reference::SplitMix64 theirs(seed);
        for (int i = 0; i < 100; ++i)
            REQUIRE(ours.next() == theirs.next());
    }
}

TEST_CASE("Unit draws are the upper 53 bits: at least 0, below 1, and spread over it") {
    SplitMix64 random(5), bits(5);
    double low = 1, high = 0, sum = 0;
    for (int i = 0; i < 10000; ++i) {
        const double u = random.unit();
        REQUIRE(u == static_cast<double>(bits.next() >> 11) / 9007199254740992.0);
        low = std::min(low, u);
        high = std::max(high, u);
        sum += u;
    }
    REQUIRE(low >= 0);
    REQUIRE(low < 0.01);
    REQUIRE(high < 1);
    REQUIRE(high > 0.99);
    REQUIRE(std::abs(sum / 10000 - 0.5) < 0.02);
}
