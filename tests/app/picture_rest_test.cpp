#include "app/core/picture_rest.h"

#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>

using namespace clothlab;

TEST_CASE("Pictures wait while the simulation is late, at most half of the time, and stop waiting when it is not") {
    app::PictureRest rest;
    const auto rest_after = [&](double seconds, double picture, bool late) {
        double last = 0;
        for (double passed = 0; passed < seconds; passed += picture + last)
            last = rest.after(picture, late);
        return last;
    };
    REQUIRE(rest_after(1, 0.03, false) == 0);
    REQUIRE(rest.after(0.03, true) < 0.003); // little at first
    REQUIRE(rest_after(1, 0.02, true) == Catch::Approx(0.02));
    REQUIRE(rest_after(0.5, 0.02, false) > 0.015); // not given back at once
    REQUIRE(rest_after(6, 0.03, false) == 0);
    REQUIRE(rest_after(2, 0.2, true) == Catch::Approx(0.025)); // a picture that takes long does not wait as long
}
