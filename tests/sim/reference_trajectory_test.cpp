// A trajectory of a third, independent implementation: ../shared/cs184-reference, of which tests/data has an extract.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <fstream>
#include <string>

#include "sim/simulation.h"
#include "support/sheet.h"

using namespace clothlab;

TEST_CASE("The supplied trajectory of pinned cloth is met within 1e-9 m at frame 10") {
    sim::Description description;
    description.cloth.width = description.cloth.height = 0.98; // that program spaces 50 points by 1/50 m
    description.cloth.density = 150 / (0.98 * 0.98);
    description.cloth.thickness = 1e-9;
    description.cloth.pinned = {{0, 0}, {49, 0}};
    description.stepping.precision = sim::Precision::double_precision;
    const auto simulation = sim::Simulation::create(description);

    std::ifstream file(CLOTHLAB_SOURCE_DIR "/tests/data/cs184-pinned2.txt");
    REQUIRE(file);
    std::uint64_t frame = 0;
    std::size_t index = 0, compared = 0, at_frame_10 = 0;
    double x = 0, y = 0, z = 0, worst = 0, lowest = 1;
    while (file >> frame >> index >> x >> y >> z) {
        while (simulation->frame() < frame)
            simulation->step_frame();
        REQUIRE(simulation->frame() == frame);
        worst = std::max(worst, test::norm(test::minus(simulation->position(index), {x, y, z})));
        lowest = std::min(lowest, y);
        ++compared;
        if (frame == 10)
            ++at_frame_10;
    }
    REQUIRE(file.eof());
    REQUIRE(compared == 2 * 834);
    REQUIRE(at_frame_10 == 834);
    REQUIRE(lowest < 0.95); // the cloth has fallen by then
    REQUIRE(worst < 1e-9);
}
