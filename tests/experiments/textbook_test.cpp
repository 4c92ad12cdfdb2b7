// The textbook's simulator computes what the simulation computes: the bench compares cost, not results.
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "experiments/bench/textbook.h"
#include "scene/io.h"
#include "sim/simulation.h"
#include "support/files.h"

using namespace clothlab;
using namespace clothlab::test;
using experiments::CellMap;
using experiments::Textbook;

namespace {

sim::Description shipped(const std::string& name, int columns, int rows) {
    sim::Description d = scene::load_scene(checkout() / "scenes" / (name + ".json")).simulation;
    d.stepping.precision = sim::Precision::double_precision;
    const double finer = columns / 50.0;
    d.cloth.density *= finer * finer;
    d.cloth.thickness /= finer;
    for (sim::GridPoint& pin : d.cloth.pinned)
        pin = {pin[0] == d.cloth.num_width_points - 1 ? columns - 1 : 0, 0};
    d.cloth.num_width_points = columns;
    d.cloth.num_height_points = rows;
    return d;
}

std::vector<sim::Vec3> positions(const auto& run) {
    std::vector<sim::Vec3> result;
    for (std::size_t i = 0; i < run.points(); ++i)
        result.push_back(run.position(i));
    return result;
}

/// Runs both; all bits and all counts of every step must agree. Returns the sums of the counts.
sim::StepCounts require_same_bits(const sim::Description& description, int frames) {
    const auto simulation = sim::Simulation::create(description);
    Textbook textbook(description), handout(description, CellMap::handout);
    REQUIRE(positions(textbook) == positions(*simulation));
    sim::StepCounts sum;
    for (int frame = 0; frame < frames; ++frame) {
        for (int step = 0; step < description.stepping.substeps; ++step) {
            const sim::StepCounts a = simulation->step(), b = textbook.step(), c = handout.step();
            INFO("step " << simulation->steps());
            REQUIRE(a.self_contacts == b.self_contacts);
            REQUIRE(a.self_contacts == c.self_contacts);
            REQUIRE(a.contacts == b.contacts);
            REQUIRE(a.shortened_springs == b.shortened_springs);
            sum.self_contacts += a.self_contacts;
            sum.contacts += a.contacts;
            sum.shortened_springs += a.shortened_springs;
        }
        INFO("frame " << simulation->frame());
        REQUIRE(positions(textbook) == positions(*simulation));
        REQUIRE(positions(handout) == positions(*simulation));
    }
    return sum;
}

} // namespace

TEST_CASE("The textbook's simulator equals the simulation to the last bit where cloth falls on a plane and itself") {
    const sim::StepCounts sum = require_same_bits(shipped("self-collision", 24, 24), 80);
    REQUIRE(sum.self_contacts > 1000);
    REQUIRE(sum.contacts > 100);
}

TEST_CASE("The textbook's simulator equals the simulation to the last bit where the stretch limit is active") {
    sim::Description d = shipped("two-pins", 20, 25);
    d.cloth.ks = 300;
    REQUIRE(require_same_bits(d, 40).shortened_springs > 1000);
    d.rules.limit = sim::LimitRule::off;
    REQUIRE(require_same_bits(d, 20).shortened_springs == 0);
}

TEST_CASE("The textbook's simulator equals the simulation to the last bit on spheres and tilted planes") {
    sim::Description d = shipped("sphere-soft", 21, 17);
    d.colliders.push_back(sim::Plane{{0, 0.3, 0}, {1, 2, 3}, 0.4});
    const sim::StepCounts sum = require_same_bits(d, 60);
    REQUIRE(sum.contacts > 1000);
    REQUIRE(require_same_bits(shipped("colliders", 20, 20), 40).contacts > 100);
}

TEST_CASE("The textbook's simulator equals the simulation to the last bit for any springs and accelerations") {
    sim::Description d = shipped("four-pins", 9, 13);
    d.cloth.width = 0.7;
    d.cloth.offset = {-0.4, 0.1, -0.3}; // cells on both sides of zero
    d.cloth.thickness = 0.08;
    d.stepping.accelerations = {{0.7, 0.1, -2.3}, {1e-3, 5, 0.9}};
    for (const int off : {0, 1, 2}) {
        d.cloth.enable_structural = off != 0;
        d.cloth.enable_shearing = off != 1;
        d.cloth.enable_bending = off != 2;
        REQUIRE(require_same_bits(d, 5).self_contacts > 100);
    }
}

TEST_CASE("A textbook's simulator goes on to the bit from where another one is placed") {
    const sim::Description d = shipped("self-collision", 16, 16);
    Textbook first(d), second(d);
    for (int i = 0; i < 600; ++i)
        first.step();
    const std::vector<sim::Vec3> last = positions(first);
    first.step();
    second.place(positions(first), last);
    for (int i = 0; i < 300; ++i) {
        first.step();
        second.step();
    }
    REQUIRE(positions(first) == positions(second));
    REQUIRE_THROWS_AS(second.place(last, {}), std::invalid_argument);
}

TEST_CASE("A textbook's simulator times its stages when asked, counts its memory and its cells") {
    const CellMap map = GENERATE(CellMap::fast, CellMap::handout);
    Textbook textbook(shipped("self-collision", 10, 10), map);
    REQUIRE(textbook.springs() == 2 * 10 * 9 + 2 * 9 * 9 + 2 * 10 * 8);
    textbook.step();
    REQUIRE(textbook.stage_seconds() == sim::StageSeconds{});
    textbook.time_stages(true);
    textbook.step();
    for (const double seconds : textbook.stage_seconds())
        REQUIRE(seconds > 0);
    REQUIRE(textbook.memory_bytes() > 100 * textbook.points());
    // Three by three points to a cell, more or less; a cell at the edge may hold one.
    REQUIRE(textbook.points_per_cell() > 1);
    REQUIRE(textbook.points_per_cell() < 12);
}

TEST_CASE("The textbook's simulator survives points that are nowhere") {
    const sim::Description d = shipped("self-collision", 5, 5);
    for (const CellMap map : {CellMap::fast, CellMap::handout}) {
        Textbook textbook(d, map);
        std::vector<sim::Vec3> places = positions(textbook);
        places[7].y = std::nan("");
        textbook.place(places, places);
        REQUIRE(textbook.step().self_contacts == 0);
        REQUIRE(std::isnan(textbook.position(7).y));
    }
}

TEST_CASE("The textbook's simulator refuses what it does not have") {
    const auto refuses = [](auto change) {
        sim::Description d = shipped("two-pins", 5, 5);
        change(d);
        REQUIRE_THROWS_AS(Textbook(d), std::invalid_argument);
    };
    refuses([](sim::Description& d) { d.wind.kind = sim::WindKind::course; });
    refuses([](sim::Description& d) { d.wind.kind = sim::WindKind::physical; });
    refuses([](sim::Description& d) { d.cloth.num_width_points = 1; });
    refuses([](sim::Description& d) { d.cloth.height = 0; });
    refuses([](sim::Description& d) { d.cloth.pinned = {{5, 0}}; });
    refuses([](sim::Description& d) { d.cloth.density = 0; });
    refuses([](sim::Description& d) { d.stepping.substeps = 0; });
    refuses([](sim::Description& d) { d.colliders = {sim::Plane{{}, {0, 0, 0}, 0}}; });
}
