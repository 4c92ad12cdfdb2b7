// Determinism and resuming: equal runs have equal hashes, and a run that was saved and loaded goes on to the last bit.
#include <bit>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <cstring>
#include <stdexcept>

#include "sim/simulation.h"
#include "support/choices.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

sim::Description busy_scene(sim::Precision precision) {
    sim::Description description;
    description.cloth.num_width_points = 9;
    description.cloth.num_height_points = 8;
    description.cloth.ks = 200;
    description.cloth.thickness = 0.07;
    description.cloth.orientation = sim::Orientation::vertical;
    description.cloth.pinned = {{0, 0}};
    description.colliders = {sim::Sphere{{0.5, 0.4, 0.1}, 0.2, 0.2}, sim::Plane{{0, 0.01, 0}, {0, 1, 0.01}, 0.4}};
    description.wind.kind = sim::WindKind::course;
    description.wind.clock = sim::WindClock::time;
    description.stepping.precision = precision;
    description.stepping.seed = 4;
    return description;
}

std::vector<std::byte> with_flipped_bit(std::vector<std::byte> bytes, std::size_t bit) {
    bytes[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
    return bytes;
}

/// Expects that these bytes are refused with a sentence, and that nothing changes.
void require_refused(sim::Simulation& simulation, std::span<const std::byte> bytes) {
    const std::uint64_t before = simulation.hash(), frame = simulation.frame();
    const int substep = simulation.substep();
    std::string message;
    try {
        simulation.load_state(bytes);
        FAIL("bytes were taken that should be refused");
    } catch (const std::invalid_argument& error) {
        message = error.what();
    }
    REQUIRE(message.size() > 10);
    REQUIRE(simulation.hash() == before);
    REQUIRE(simulation.frame() == frame);
    REQUIRE(simulation.substep() == substep);
}

} // namespace

TEST_CASE("Two runs of one description have the same hash in every frame, and another seed has another") {
    for (const sim::Precision precision : both_precisions) {
        sim::Description description = busy_scene(precision);
        const auto first = sim::Simulation::create(description), second = sim::Simulation::create(description);
        description.stepping.seed = 5;
        const auto other = sim::Simulation::create(description);
        for (int frame = 0; frame < 20; ++frame) {
            REQUIRE(first->hash() == second->hash());
            REQUIRE(first->hash() != other->hash());
            const std::uint64_t before = first->hash();
            for (sim::Simulation* simulation : {first.get(), second.get(), other.get()})
                simulation->step_frame();
            REQUIRE(first->hash() != before);
        }
    }
}

TEST_CASE("Measuring, diagnosing and capturing do not change a run") {
    for (const sim::Precision precision : both_precisions) {
        const auto quiet = sim::Simulation::create(busy_scene(precision));
        const auto watched = sim::Simulation::create(busy_scene(precision));
        watched->time_stages(true);
        sim::Snapshot snapshot;
        for (int n = 0; n < 200; ++n) {
            quiet->step();
            watched->step();
            watched->capture(snapshot);
            REQUIRE(snapshot.steps == watched->steps());
        }
        REQUIRE(watched->hash() == quiet->hash());
        REQUIRE(snapshot.positions.size() == 3 * 72);
        REQUIRE(snapshot.positions[3 * 71 + 1] == static_cast<float>(watched->position(71).y));
    }
}

TEST_CASE("One flipped bit anywhere in the state changes its hash") {
    Sheet<float> sheet(bare_cloth(3, 4));
    const std::uint64_t original = sim::hash(sheet.state);
    for (auto* array : {&sheet.state.position, &sheet.state.previous}) {
        for (auto* axis : {&array->x, &array->y, &array->z}) {
            for (float& value : *axis) {
                const float kept = value;
                for (unsigned bit = 0; bit < 32; ++bit) {
                    value = std::bit_cast<float>(std::bit_cast<std::uint32_t>(kept) ^ (1u << bit));
                    REQUIRE(sim::hash(sheet.state) != original);
                }
                value = kept;
            }
        }
    }
    sheet.state.steps = 1;
    REQUIRE(sim::hash(sheet.state) != original);
    sheet.state.steps = 0;
    sheet.state.time = 1e-300;
    REQUIRE(sim::hash(sheet.state) != original);
    sheet.state.time = 0;
    REQUIRE(sim::hash(sheet.state) == original);
}

TEST_CASE("A run that is saved and loaded at random moments ends as one that never stopped") {
    for (const sim::Precision precision : both_precisions) {
        sim::SplitMix64 random(6);
        auto running = sim::Simulation::create(busy_scene(precision));
        const auto straight = sim::Simulation::create(busy_scene(precision));
        for (int stop = 0; stop < 12; ++stop) {
            const int steps = 1 + static_cast<int>(uniform(random, 0, 70));
            for (int n = 0; n < steps; ++n) {
                running->step();
                straight->step();
            }
            const std::vector<std::byte> bytes = running->save_state();
            auto resumed = sim::Simulation::create(busy_scene(precision));
            for (int n = 0; n < stop; ++n)
                resumed->step(); // whatever it did before
            resumed->load_state(bytes);
            REQUIRE(resumed->hash() == straight->hash());
            REQUIRE(resumed->time() == straight->time());
            REQUIRE(resumed->steps() == straight->steps());
            REQUIRE(resumed->frame() == straight->frame());
            REQUIRE(resumed->substep() == straight->substep());
            REQUIRE(resumed->save_state() == bytes);
            running = std::move(resumed);
        }
        running->step_frame();
        straight->step_frame();
        REQUIRE(running->hash() == straight->hash());
        REQUIRE(running->frame() == straight->frame());
    }
}

TEST_CASE("A state saved before and after a change of the step length is resumed to the last bit") {
    sim::Description description = busy_scene(sim::Precision::double_precision);
    const auto straight = sim::Simulation::create(description);
    for (int n = 0; n < 37; ++n)
        straight->step();
    description.stepping.substeps = 41;
    straight->change(description);
    for (int n = 0; n < 53; ++n)
        straight->step();
    const auto resumed = sim::Simulation::create(description);
    resumed->load_state(straight->save_state());
    REQUIRE(resumed->time() == straight->time());
    for (int n = 0; n < 100; ++n) {
        straight->step();
        resumed->step();
    }
    REQUIRE(resumed->hash() == straight->hash());
}

TEST_CASE("A state with any one bit flipped is refused and changes nothing") {
    sim::Description description = busy_scene(sim::Precision::single_precision);
    description.cloth.num_width_points = 3;
    description.cloth.num_height_points = 3;
    const auto simulation = sim::Simulation::create(description);
    simulation->step_frame();
    const std::vector<std::byte> bytes = simulation->save_state();
    simulation->step();
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit)
        require_refused(*simulation, with_flipped_bit(bytes, bit));
    REQUIRE_NOTHROW(simulation->load_state(bytes));
}

TEST_CASE("A truncated, overlong or empty state is refused and changes nothing") {
    for (const sim::Precision precision : both_precisions) {
        const auto simulation = sim::Simulation::create(busy_scene(precision));
        simulation->step();
        std::vector<std::byte> bytes = simulation->save_state();
        for (std::size_t size = 0; size < bytes.size(); size += size < 100 ? 1 : 97)
            require_refused(*simulation, std::span(bytes).first(size));
        bytes.push_back(std::byte{0});
        require_refused(*simulation, bytes);
        require_refused(*simulation, std::vector<std::byte>(bytes.size(), std::byte{0x5a}));
    }
}

TEST_CASE("A state of another precision or grid is refused and changes nothing") {
    sim::Description description = busy_scene(sim::Precision::double_precision);
    const auto simulation = sim::Simulation::create(description);
    require_refused(*simulation, sim::Simulation::create(busy_scene(sim::Precision::single_precision))->save_state());
    std::swap(description.cloth.num_width_points, description.cloth.num_height_points);
    description.cloth.pinned.clear();
    require_refused(*simulation, sim::Simulation::create(description)->save_state()); // as many points
    description.cloth.num_height_points = 4;
    require_refused(*simulation, sim::Simulation::create(description)->save_state());
}
