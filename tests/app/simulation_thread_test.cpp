// The simulation's thread does what it is asked, in order.
#include <catch2/catch_test_macros.hpp>

#include "support/simulation_thread.h"

using namespace clothlab;
using namespace clothlab::test;

TEST_CASE("Who asks to play is told so at once, whatever the run is at", "[threads]") {
    app::SimulationThread thread;
    REQUIRE_FALSE(thread.latest().playing);
    sim::Description description;
    description.cloth.num_width_points = description.cloth.num_height_points = 150;
    thread.start(description);
    for (const bool on : {true, false, true, false}) {
        thread.play(on);
        REQUIRE(thread.latest().playing == on);
    }
    thread.play(true, true);
    REQUIRE(thread.latest().backwards);
    thread.play(false);
    thread.finish();
    REQUIRE_FALSE(thread.latest().playing);
}

TEST_CASE("Before a scene is given there is nothing to show, and commands do no harm", "[threads]") {
    app::SimulationThread thread;
    thread.play(true);
    thread.step(3);
    thread.step_frames(2);
    thread.set_speed(2);
    const app::Published published = finished(thread);
    REQUIRE(published.snapshot == nullptr);
    REQUIRE(published.run == 0);
    REQUIRE(published.error.empty());
}

TEST_CASE("A started scene is shown at time 0, paused", "[threads]") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    const app::Published published = finished(thread);
    REQUIRE(published.run == 1);
    REQUIRE_FALSE(published.playing);
    REQUIRE(published.error.empty());
    REQUIRE(shows(published, *sim::Simulation::create(small_cloth())));
}

TEST_CASE("Who waits for the ticket of a frame misses none, whatever else is published meanwhile", "[threads]") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    thread.play(true);
    std::uint64_t ticket = thread.step_frames(0); // pauses
    const std::uint64_t first =
        wait_for(thread, [&](const app::Published& p) { return p.done >= ticket; }).snapshot->frame;
    for (std::uint64_t frame = first + 3; frame < first + 60; frame += 3) {
        ticket = thread.step_frames(3);
        const app::Published published = wait_for(thread, [&](const app::Published& p) { return p.done >= ticket; });
        REQUIRE(published.snapshot->frame == frame);
        REQUIRE(published.snapshot->substep == 0);
    }
}

TEST_CASE("Steps and frames are taken to the last one, with the positions of a simulation without a thread",
          "[threads]") {
    for (const sim::Precision precision : {sim::Precision::single_precision, sim::Precision::double_precision}) {
        sim::Description description = small_cloth();
        description.stepping.precision = precision;
        const auto simulation = sim::Simulation::create(description);
        app::SimulationThread thread;
        thread.start(description);
        thread.step(1);
        simulation->step();
        REQUIRE(shows(finished(thread), *simulation));
        thread.step(3);
        thread.step(4);
        for (int n = 0; n < 7; ++n)
            simulation->step();
        REQUIRE(shows(finished(thread), *simulation));
        thread.step_frames(1); // to the end of the frame under way
        simulation->step_frame();
        REQUIRE(simulation->substep() == 0);
        REQUIRE(shows(finished(thread), *simulation));
        thread.step_frames(20);
        for (int n = 0; n < 20; ++n)
            simulation->step_frame();
        REQUIRE(shows(finished(thread), *simulation));
        REQUIRE_FALSE(thread.latest().playing);
    }
}

TEST_CASE("Frames and steps are taken in the order in which they were asked for, however late they are taken",
          "[threads]") {
    const auto simulation = sim::Simulation::create(small_cloth());
    app::SimulationThread thread;
    thread.start(small_cloth());
    for (int n = 0; n < 5; ++n) {
        thread.step_frames(1);
        thread.step(1);
        thread.step_frames(1);
        simulation->step_frame();
        simulation->step();
        simulation->step_frame();
    }
    REQUIRE(shows(finished(thread), *simulation));
}

TEST_CASE("No steps, or fewer than none, are no steps", "[threads]") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    thread.step(0);
    thread.step(-5);
    thread.step_frames(0);
    thread.step_frames(-3);
    REQUIRE(finished(thread).snapshot->steps == 0);
    thread.step(2); // and none of them is owed
    REQUIRE(finished(thread).snapshot->steps == 2);
}

TEST_CASE("Playing goes on until it is paused, and stepping pauses it", "[threads]") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    thread.play(true);
    const app::Published playing =
        wait_for(thread, [](const app::Published& p) { return p.snapshot && p.snapshot->steps > 20; });
    REQUIRE(playing.playing);
    thread.play(false);
    const app::Published paused = finished(thread);
    REQUIRE_FALSE(paused.playing);
    REQUIRE(paused.snapshot->steps >= playing.snapshot->steps);
    REQUIRE(finished(thread).snapshot == paused.snapshot); // it stands still

    thread.play(true);
    wait_for(thread, [&](const app::Published& p) { return p.snapshot->steps > paused.snapshot->steps; });
    thread.step(1);
    const app::Published stepped = finished(thread);
    REQUIRE_FALSE(stepped.playing);
    const auto simulation = sim::Simulation::create(small_cloth());
    while (simulation->steps() < stepped.snapshot->steps)
        simulation->step();
    REQUIRE(shows(stepped, *simulation)); // however it was paced, these are the same steps
}

TEST_CASE("A live change keeps time and steps and acts from the next step on", "[threads]") {
    sim::Description description = small_cloth();
    const auto simulation = sim::Simulation::create(description);
    app::SimulationThread thread;
    thread.start(description);
    thread.step(12);
    thread.finish(); // a change acts at once, not after the steps that are still to be taken
    description.cloth.ks = 20;
    description.stepping.gravity = {1, 0, 0};
    description.stepping.substeps = 9;
    thread.change(description);
    thread.step(8);
    for (int n = 0; n < 12; ++n)
        simulation->step();
    simulation->change(description);
    for (int n = 0; n < 8; ++n)
        simulation->step();
    const app::Published published = finished(thread);
    REQUIRE(published.run == 1);
    REQUIRE(published.snapshot->steps == 20);
    REQUIRE(shows(published, *simulation));
}

TEST_CASE("A change of the grid starts anew, paused or playing as before", "[threads]") {
    sim::Description description = small_cloth();
    app::SimulationThread thread;
    thread.start(description);
    thread.step(12);
    description.cloth.num_width_points = 9;
    thread.change(description);
    app::Published published = finished(thread);
    REQUIRE(published.run == 2);
    REQUIRE_FALSE(published.playing);
    REQUIRE(shows(published, *sim::Simulation::create(description)));
    thread.play(true);
    description.cloth.num_width_points = 10;
    thread.change(description);
    published = wait_for(thread, [](const app::Published& p) { return p.run == 3 && p.snapshot->steps > 0; });
    REQUIRE(published.playing);
    REQUIRE(published.snapshot->columns == 10);
}

TEST_CASE("A description without meaning is refused with a reason, and the run goes on", "[threads]") {
    const sim::Description good = small_cloth();
    const auto simulation = sim::Simulation::create(good);
    app::SimulationThread thread;
    thread.start(good);
    thread.step(4);
    for (int n = 0; n < 4; ++n)
        simulation->step();

    std::vector<sim::Description> bad(4, good);
    bad[0].cloth.pinned = {{8, 0}};
    bad[1].cloth.density = 0;
    bad[2].cloth.num_width_points = 1; // another grid, so a new start
    bad[3].stepping.substeps = 0;
    for (const sim::Description& description : bad) {
        for (const bool anew : {false, true}) {
            if (anew)
                thread.start(description);
            else
                thread.change(description);
            const app::Published refused = finished(thread);
            REQUIRE(refused.error.size() > 10);
            REQUIRE(refused.run == 1);
            REQUIRE(shows(refused, *simulation));
            thread.step(1);
            simulation->step();
            REQUIRE(shows(finished(thread), *simulation));
        }
    }
    thread.change(good);
    REQUIRE(finished(thread).error.empty());
}

TEST_CASE("A first description without meaning is refused, and the next one is taken", "[threads]") {
    app::SimulationThread thread;
    sim::Description bad = small_cloth();
    bad.cloth.density = 0;
    thread.start(bad);
    REQUIRE(finished(thread).error.size() > 10);
    REQUIRE(thread.latest().snapshot == nullptr);
    thread.change(small_cloth());
    REQUIRE(finished(thread).error.empty());
    REQUIRE(shows(thread.latest(), *sim::Simulation::create(small_cloth())));
}
