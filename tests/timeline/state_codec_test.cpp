// Compressed states: smaller, and the very same bytes again, whatever they are.
#include "timeline/state_codec.h"

#include <bit>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "sim/integrators/integrator.h"
#include "sim/random.h"
#include "sim/saved_state.h"
#include "sim/simulation.h"
#include "support/choices.h"
#include "support/effort.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

using Bytes = std::vector<std::byte>;
sim::Description hanging(int columns, int rows, sim::Precision precision) {
    sim::Description description;
    description.cloth.num_width_points = columns;
    description.cloth.num_height_points = rows;
    description.cloth.pinned = {{0, 0}};
    description.stepping.precision = precision;
    return description;
}

/// A state of random bits, or of numbers that are no coordinates.
Bytes strange_state(int columns, int rows, std::uint32_t real_size, std::uint32_t velocities, std::uint64_t seed) {
    sim::StateHeader header;
    header.real_size = real_size;
    header.columns = columns;
    header.rows = rows;
    header.velocities = velocities;
    Bytes bytes(header.bytes());
    std::memcpy(bytes.data(), &header, sizeof header);
    sim::SplitMix64 random(seed);
    const double special[] = {std::numeric_limits<double>::quiet_NaN(),
                              -std::numeric_limits<double>::signaling_NaN(),
                              std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity(),
                              0.0,
                              -0.0,
                              std::numeric_limits<double>::denorm_min(),
                              -std::numeric_limits<double>::max()};
    for (std::size_t at = sizeof header; at + 8 < bytes.size(); at += real_size) {
        const std::uint64_t word = random.next();
        const std::uint64_t bits = word % 3 == 0 ? word : std::bit_cast<std::uint64_t>(special[word >> 61]);
        const std::uint32_t half = static_cast<std::uint32_t>(word % 3 == 0 ? word : bits >> 32 << 3 | word >> 63);
        if (real_size == 8)
            std::memcpy(bytes.data() + at, &bits, 8);
        else
            std::memcpy(bytes.data() + at, &half, 4);
    }
    const std::uint64_t sum = sim::checksum(std::span(bytes).first(bytes.size() - sizeof sum));
    std::memcpy(bytes.data() + bytes.size() - sizeof sum, &sum, sizeof sum);
    return bytes;
}

bool refused(const Bytes& bytes) {
    try {
        timeline::expand_state(bytes);
        return false;
    } catch (const std::invalid_argument& e) {
        return std::strlen(e.what()) > 10;
    }
}

} // namespace

TEST_CASE("A compressed state expands to the very same bytes, for every method and both precisions") {
    for (const sim::IntegratorInfo& method : sim::integrators())
        for (const sim::Precision precision : both_precisions) {
            sim::Description description = hanging(9, 8, precision);
            description.stepping.integrator = method.id;
            description.stepping.substeps = 3;
            const auto simulation = sim::Simulation::create(description);
            for (int step = 0; step < 4; ++step) {
                const Bytes state = simulation->save_state();
                INFO(method.name << ", step " << step);
                REQUIRE(timeline::expand_state(timeline::compress_state(state)) == state);
                simulation->step();
            }
        }
}

TEST_CASE("Numbers that are no coordinates survive compression to the bit") {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const Bytes state = strange_state(1 + static_cast<int>(seed % 7), 1 + static_cast<int>(seed % 5),
                                          seed % 2 ? 4 : 8, static_cast<std::uint32_t>(seed % 3), seed);
        REQUIRE(timeline::expand_state(timeline::compress_state(state)) == state);
    }
}

TEST_CASE("A state of moving cloth takes less than three quarters of its bytes in single precision") {
    const auto simulation = sim::Simulation::create(hanging(50, 50, sim::Precision::single_precision));
    for (int frame = 0; frame < attempts(60); ++frame)
        simulation->step_frame();
    const Bytes state = simulation->save_state(), compressed = timeline::compress_state(state);
    REQUIRE(compressed.size() * 4 < state.size() * 3);
    const timeline::StoredStatePtr stored = timeline::keep_in_memory(compressed);
    REQUIRE(stored->compressed() == compressed);
    REQUIRE(stored->memory() >= compressed.size());
    REQUIRE(stored->memory() < compressed.size() + 200);
}

TEST_CASE("Bytes that no simulation saved are not compressed") {
    Bytes state = strange_state(3, 4, 8, 1, 5);
    REQUIRE_THROWS_AS(timeline::compress_state({}), std::invalid_argument);
    REQUIRE_THROWS_AS(timeline::compress_state(std::span(state).first(state.size() - 1)), std::invalid_argument);
    state[100] ^= std::byte{4};
    REQUIRE_THROWS_AS(timeline::compress_state(state), std::invalid_argument);
}

TEST_CASE("A compressed state that is cut anywhere or has any bit flipped is refused") {
    for (const sim::Precision precision : both_precisions) {
        const Bytes whole = timeline::compress_state(sim::Simulation::create(hanging(5, 4, precision))->save_state());
        REQUIRE_FALSE(refused(whole));
        for (std::size_t size = 0; size < whole.size(); ++size)
            REQUIRE(refused(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))));
        for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
            Bytes flipped = whole;
            flipped[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
            // LZ4 may say the same in two ways: then it is no damage.
            bool same = false;
            try {
                same = timeline::expand_state(flipped) == timeline::expand_state(whole);
            } catch (const std::invalid_argument&) {
            }
            INFO("bit " << bit);
            REQUIRE((same || refused(flipped)));
        }
    }
}
