// What did not pay is left alone for longer and longer.
#include "sim/collision/back_off.h"

#include <catch2/catch_test_macros.hpp>

using namespace clothlab;

namespace {

int steps_without(sim::BackOff& rests) {
    int steps = 0;
    while (rests.waits())
        ++steps;
    return steps;
}

} // namespace

TEST_CASE("What never pays is tried again after 32 steps, 64, and so on, and after 512 from then on") {
    sim::BackOff rests;
    REQUIRE_FALSE(rests.waits());
    for (const int steps : {32, 64, 128, 256, 512, 512, 512}) {
        rests.leave();
        REQUIRE(steps_without(rests) == steps);
    }
    rests.pays();
    REQUIRE_FALSE(rests.waits());
    rests.leave();
    REQUIRE(steps_without(rests) == 32);
}
