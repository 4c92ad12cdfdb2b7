// The same bits on every machine: hashes that are written down here, whatever computes them. They hold for every
// compiler and standard library, too: nothing in these scenes calls for more than the four operations and square roots.
#include <catch2/catch_test_macros.hpp>
#include <string>
#include <vector>

#include "sim/simulation.h"
#include "support/effort.h"
#include "support/every_execution.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

struct Stored {
    const char* what;
    std::uint64_t single_precision, double_precision; ///< after 20 frames of 10 substeps
    sim::Description (*scene)();
};

sim::Description cloth(int columns, int rows) {
    sim::Description d;
    d.cloth.num_width_points = columns;
    d.cloth.num_height_points = rows;
    d.stepping.substeps = 10;
    return d;
}

constexpr std::size_t count = 6;
const Stored stored[count] = {
    {"hangs from two corners, its limit active", 0xbc3584fece083483, 0x3847f84419090270,
     [] {
         sim::Description d = cloth(50, 50);
         d.cloth.pinned = {{0, 0}, {49, 0}};
         d.cloth.ks = 500;
         return d;
     }},
    {"stands, falls onto the plane and folds", 0x1c4989d1576bdb57, 0x86b274db89c53a3f,
     [] {
         sim::Description d = cloth(40, 50);
         d.cloth.orientation = sim::Orientation::vertical;
         d.cloth.ks = 100;
         d.cloth.thickness = 0.012;
         d.cloth.offset = {0, 0.001, 0};
         d.colliders = {sim::Plane{{0, 0, 0}, {0.02, 1, 0}, 0.5}};
         return d;
     }},
    {"falls onto a sphere", 0x8e714222256f4999, 0xbffd187e72fba412,
     [] {
         sim::Description d = cloth(37, 61);
         d.cloth.ks = 300;
         d.colliders = {sim::Sphere{{0.5, 0.79, 0.5}, 0.2, 0.3}};
         return d;
     }},
    {"thick points that touch from the start", 0x7d9173d31e82a0fa, 0x10d2f95044bcd7ef,
     [] {
         sim::Description d = cloth(64, 40);
         d.cloth.thickness = 0.015;
         d.cloth.pinned = {{10, 10}};
         return d;
     }},
    {"shear springs alone, no damping, no limit", 0x2a5dd2fcb203e4d5, 0xa8a2efa209969664,
     [] {
         sim::Description d = cloth(33, 20);
         d.cloth.enable_structural = d.cloth.enable_bending = false;
         d.cloth.damping = 0;
         d.rules.limit = sim::LimitRule::off;
         d.cloth.pinned = {{0, 0}, {32, 19}};
         return d;
     }},
    {"nothing but springs, many steps at once where there are threads", 0xb5d1a2a5cfa1bc8f, 0x0fe84903bf9a468d,
     [] {
         sim::Description d = cloth(50, 50);
         d.cloth.ks = 500;
         d.cloth.pinned = {{0, 0}, {49, 0}};
         d.rules.limit = sim::LimitRule::off;
         d.rules.self_collision = sim::SelfCollisionRule::none;
         return d;
     }},
};

} // namespace

TEST_CASE("Every instruction set and any number of threads gives the stored hash", "[threads]") {
    std::vector<sim::Execution> ways;
    for (const sim::InstructionSet set : supported_sets())
        for (const int threads : {1, 2, 3, 8})
            if (threads <= 2 || set == sim::resolve(sim::InstructionSet::automatic))
                ways.push_back(exactly(set, threads));
    std::size_t scene = 0;
    for (const Stored& expected : stored)
        for (const sim::Precision precision : {sim::Precision::single_precision, sim::Precision::double_precision}) {
            sim::Description description = expected.scene();
            description.stepping.precision = precision;
            ++scene;
            for (std::size_t way = 0; way < ways.size(); ++way) {
                if (sanitized && way != scene % ways.size()) // there each scene and each way once
                    continue;
                const auto simulation = sim::Simulation::create(description, ways[way]);
                for (int frame = 0; frame < 20; ++frame)
                    simulation->step_frame();
                INFO(expected.what << ", " << name_of(ways[way].instructions) << ", " << ways[way].threads
                                   << " threads, "
                                   << (precision == sim::Precision::single_precision ? "single" : "double")
                                   << " precision: 0x" << std::hex << simulation->hash());
                CHECK(simulation->hash() == (precision == sim::Precision::single_precision
                                                 ? expected.single_precision
                                                 : expected.double_precision));
            }
        }
}
