// The simulation's thread does what it is asked, in order, and never makes anybody wait for a step.
#include "app/core/simulation_thread.h"

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <chrono>

#include "sim/simulation.h"
#include "support/effort.h"
#include "support/random_scene.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

sim::Description small_cloth() {
    sim::Description d;
    d.cloth.num_width_points = 8;
    d.cloth.num_height_points = 7;
    d.cloth.pinned = {{0, 0}};
    d.stepping.substeps = 5;
    return d;
}

/// A cloth whose steps take long.
sim::Description big_cloth() {
    sim::Description d;
    d.cloth.num_width_points = d.cloth.num_height_points = sanitized ? 250 : 600;
    return d;
}

/// Whether what is shown is, to the bit, what the simulation has after as many steps.
bool shows(const app::Published& published, const sim::Simulation& simulation) {
    sim::Snapshot expected;
    simulation.capture(expected);
    return published.snapshot && published.snapshot->positions == expected.positions &&
           published.snapshot->steps == expected.steps && published.snapshot->frame == expected.frame &&
           published.snapshot->substep == expected.substep && published.snapshot->time == expected.time;
}

app::Published finished(app::SimulationThread& thread) {
    thread.finish();
    return thread.latest();
}

/// Waits until the thread shows something that is wanted; a thread that never does hangs the test.
template <class Wanted>
app::Published wait_for(const app::SimulationThread& thread, Wanted wanted) {
    for (;;) {
        app::Published published = thread.latest();
        if (wanted(published))
            return published;
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
}

} // namespace

TEST_CASE("Before a scene is given there is nothing to show, and commands do no harm") {
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

TEST_CASE("A started scene is shown at time 0, paused") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    const app::Published published = finished(thread);
    REQUIRE(published.run == 1);
    REQUIRE_FALSE(published.playing);
    REQUIRE(published.error.empty());
    REQUIRE(shows(published, *sim::Simulation::create(small_cloth())));
}

TEST_CASE("Steps and frames are taken to the last one, with the positions of a simulation without a thread") {
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

TEST_CASE("No steps, or fewer than none, are no steps") {
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

TEST_CASE("Playing goes on until it is paused, and stepping pauses it") {
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

TEST_CASE("A live change keeps time and steps and acts from the next step on") {
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

TEST_CASE("A change of the grid starts anew, paused or playing as before") {
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

TEST_CASE("A new start drops the steps that were still to be taken") {
    app::SimulationThread thread;
    thread.start(big_cloth());
    thread.step(1'000'000);
    thread.start(small_cloth());
    const app::Published published = finished(thread);
    REQUIRE(published.run == 2);
    REQUIRE(published.snapshot->steps == 0);
}

TEST_CASE("Pausing drops the steps that were still to be taken") {
    app::SimulationThread thread;
    thread.start(big_cloth());
    thread.step_frames(1'000'000);
    thread.step(1'000'000);
    thread.play(false);
    REQUIRE_FALSE(finished(thread).playing);
}

TEST_CASE("A description without meaning is refused with a reason, and the run goes on") {
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

TEST_CASE("A first description without meaning is refused, and the next one is taken") {
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

TEST_CASE("Slow motion waits for the next frame, and shows the one it has meanwhile") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    thread.set_speed(1e-6); // the next frame is due in three hours
    thread.play(true);
    wait_for(thread, [](const app::Published& p) { return p.snapshot && p.snapshot->frame == 1; });
    REQUIRE(finished(thread).snapshot->frame == 1); // it waits, so that finish() returns
    REQUIRE(thread.latest().playing);
    thread.set_speed(1e9);
    wait_for(thread, [](const app::Published& p) { return p.snapshot->frame > 20; });
}

TEST_CASE("A blow-up pauses, with its cause to be seen, and a new start plays again") {
    sim::Description description = small_cloth();
    description.cloth.ks = 1e9;
    description.rules.limit = sim::LimitRule::off;
    app::SimulationThread thread;
    thread.start(description);
    thread.play(true);
    const app::Published published = wait_for(thread, [](const app::Published& p) {
        return p.snapshot && p.snapshot->diagnostics.status == sim::Status::diverged && !p.playing;
    });
    REQUIRE_FALSE(published.snapshot->diagnostics.cause.empty());
    REQUIRE(finished(thread).snapshot->steps == published.snapshot->steps);
    thread.start(small_cloth());
    REQUIRE(finished(thread).snapshot->diagnostics.status == sim::Status::ok);
    thread.play(true);
    wait_for(thread, [](const app::Published& p) { return p.run == 2 && p.snapshot->steps > 0; });
}

TEST_CASE("Looking at the newest snapshot never waits for a step") {
    app::SimulationThread thread;
    thread.start(big_cloth());
    thread.play(true);
    wait_for(thread, [](const app::Published& p) { return p.snapshot && p.snapshot->steps > 0; });
    // Were latest() to wait for a step, each call would see new steps.
    int most = 0;
    for (int publication = 0; publication < 5; ++publication) {
        const auto before = thread.latest().snapshot;
        int calls = 0;
        while (thread.latest().snapshot == before)
            ++calls;
        most = std::max(most, calls);
    }
    REQUIRE(most > 50);
}

TEST_CASE("Commands are taken while a step is under way, and the thread ends while it plays") {
    const auto thread = std::make_unique<app::SimulationThread>();
    thread->start(big_cloth());
    thread->play(true);
    wait_for(*thread, [](const app::Published& p) { return p.snapshot && p.snapshot->steps > 0; });
    const auto before = thread->latest().snapshot;
    sim::Description description = big_cloth();
    int taken = 0;
    for (; taken < 200 && thread->latest().snapshot == before; ++taken) {
        description.cloth.ks += 1;
        thread->change(description);
    }
    REQUIRE(taken > 50); // had each waited for a step, there would have been as many publications
    // Its destruction here must not hang.
}

TEST_CASE("Any commands in any order leave a thread that does as it is told") {
    for (int seed = 0; seed < attempts(60); ++seed) {
        INFO("seed " << seed);
        RandomScene random(static_cast<std::uint64_t>(seed));
        app::SimulationThread thread;
        sim::Description description = small_cloth();
        std::uint64_t shown_run = 0;
        for (int n = 0; n < 60; ++n) {
            const int amount = static_cast<int>(random.below(12)) - 2;
            switch (random.below(9)) {
            case 0:
                thread.start(description);
                break;
            case 1:
                description.cloth.ks = std::abs(random.number());
                thread.change(description);
                break;
            case 2:
                description.cloth.num_height_points = 1 + static_cast<int>(random.below(8)); // 1 is refused
                thread.change(description);
                break;
            case 3:
                thread.play(random.below(2) == 0);
                break;
            case 4:
                thread.step(amount);
                break;
            case 5:
                thread.step_frames(amount);
                break;
            case 6:
                thread.set_speed(1e-3 + 100 * static_cast<double>(random.below(100)));
                break;
            default: {
                const app::Published published = thread.latest();
                REQUIRE(published.run >= shown_run);
                shown_run = published.run;
                if (published.snapshot)
                    REQUIRE(published.snapshot->positions.size() ==
                            3u * static_cast<unsigned>(published.snapshot->columns * published.snapshot->rows));
            }
            }
        }
        thread.play(false);
        description = small_cloth();
        thread.start(description);
        thread.step(7);
        const auto simulation = sim::Simulation::create(description);
        for (int n = 0; n < 7; ++n)
            simulation->step();
        REQUIRE(shows(finished(thread), *simulation));
        REQUIRE(thread.latest().error.empty());
    }
}
