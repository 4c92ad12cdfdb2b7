// Nobody waits for the simulation's thread, and it waits for nobody; whatever it is asked.
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <memory>

#include "support/random_scene.h"
#include "support/simulation_thread.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// A cloth whose step takes a hundred times as long as a look at it: all points are in one cell of the self-collision.
sim::Description slow_cloth() {
    sim::Description d;
    d.cloth.width = 100;
    d.cloth.num_width_points = 2;
    d.cloth.num_height_points = sanitized ? 800 : 2048;
    d.cloth.thickness = 1e-6;
    return d;
}

/// How often a window that asks every now and then gets the newest snapshot and gives a command, until `enough` says
/// so.
template <class Enough>
long count_calls(app::SimulationThread& thread, Enough enough) {
    long calls = 0;
    // With a rest between the calls, as a thread that asks all the time would keep the lock from the one that steps.
    for (; !enough(thread.latest()); ++calls) {
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        thread.set_speed(1);
    }
    return calls;
}

} // namespace

TEST_CASE("The newest snapshot can be had, and commands be given, as often during steps as between them", "[threads]") {
    using Clock = std::chrono::steady_clock;
    app::SimulationThread thread;
    thread.start(slow_cloth());
    thread.play(true);
    const auto stepping = [](const app::Published& p) { return p.snapshot && p.snapshot->steps > 0; };
    const auto first = wait_for(thread, stepping).snapshot;

    const auto begin = Clock::now();
    const long playing =
        count_calls(thread, [&](const app::Published& p) { return p.snapshot->steps >= first->steps + 6; });
    const auto duration = Clock::now() - begin;
    REQUIRE(playing > 50);

    // For as long with nothing to wait for. Were a call to wait for the step under way, there would be a hundred times
    // as many now; a busy machine makes a difference of two or three.
    thread.play(false);
    thread.finish();
    const auto again = Clock::now();
    const long paused = count_calls(thread, [&](const app::Published&) { return Clock::now() - again >= duration; });
    REQUIRE(playing > paused / 4);
}

TEST_CASE("Slow motion waits for the next frame, and shows the one it has meanwhile", "[threads]") {
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

TEST_CASE("A blow-up pauses, with its cause to be seen, and a new start plays again", "[threads]") {
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

TEST_CASE("A jitter pauses once where that is wanted, and not where it is not, nor need a divergence pause",
          "[threads]") {
    sim::Description stiff = small_cloth();
    stiff.cloth.ks = 1.03 * sim::Simulation::create(stiff)->stability().ks_max; // the stretch limit holds that back
    app::SimulationThread thread;
    thread.start(stiff);
    thread.pause_on_trouble(true, true);
    thread.step_frames(500);
    const app::Published paused = finished(thread);
    REQUIRE(paused.snapshot->diagnostics.status == sim::Status::jitter);
    REQUIRE(paused.snapshot->frame == paused.snapshot->trouble->frame);
    thread.step_frames(3);
    REQUIRE(finished(thread).snapshot->frame == paused.snapshot->frame + 3);

    thread.pause_on_trouble(true, false);
    thread.start(stiff);
    thread.step_frames(500);
    REQUIRE(finished(thread).snapshot->frame == 500);
    REQUIRE(thread.latest().snapshot->diagnostics.status == sim::Status::jitter);

    stiff.cloth.ks = 1e9;
    stiff.rules.limit = sim::LimitRule::off;
    thread.start(stiff);
    thread.step_frames(5);
    REQUIRE(finished(thread).snapshot->frame == 1);
    thread.pause_on_trouble(false, false);
    thread.step_frames(5);
    REQUIRE(finished(thread).snapshot->frame == 6);
}

TEST_CASE("The stability margin is in the snapshots while it is wanted: of the state itself when paused", "[threads]") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    REQUIRE_FALSE(finished(thread).snapshot->stability);
    thread.watch_stability(true);
    const auto simulation = sim::Simulation::create(small_cloth());
    REQUIRE(finished(thread).snapshot->stability == simulation->stability());
    thread.step(7);
    for (int i = 0; i < 7; ++i)
        simulation->step();
    REQUIRE(finished(thread).snapshot->stability == simulation->stability());
    sim::Description heavy = small_cloth();
    heavy.cloth.density *= 4;
    thread.change(heavy);
    simulation->change(heavy);
    REQUIRE(finished(thread).snapshot->stability == simulation->stability());
    thread.play(true);
    wait_for(thread, [&](const app::Published& p) { return p.snapshot->frame > 20 && p.snapshot->stability; });
    thread.play(false);
    thread.watch_stability(false);
    REQUIRE_FALSE(finished(thread).snapshot->stability);
}

TEST_CASE("The point quantity is in the snapshots while it is wanted", "[threads]") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    REQUIRE(finished(thread).snapshot->quantity.empty());
    thread.watch_quantity(sim::PointQuantity::speed);
    thread.step(7);
    const auto simulation = sim::Simulation::create(small_cloth());
    for (int i = 0; i < 7; ++i)
        simulation->step();
    sim::Snapshot expected;
    simulation->capture(expected, {.quantity = sim::PointQuantity::speed});
    REQUIRE(finished(thread).snapshot->quantity_kind == sim::PointQuantity::speed);
    REQUIRE(finished(thread).snapshot->quantity == expected.quantity);
    thread.watch_quantity(sim::PointQuantity::none);
    REQUIRE(finished(thread).snapshot->quantity.empty());
}

TEST_CASE("A new start drops the steps that were still to be taken", "[threads]") {
    app::SimulationThread thread;
    thread.start(big_cloth());
    thread.step(1'000'000);
    thread.start(small_cloth());
    const app::Published published = finished(thread);
    REQUIRE(published.run == 2);
    REQUIRE(published.snapshot->steps == 0);
}

TEST_CASE("Pausing drops the steps that were still to be taken", "[threads]") {
    app::SimulationThread thread;
    thread.start(big_cloth());
    thread.step_frames(1'000'000);
    thread.step(1'000'000);
    thread.play(false);
    REQUIRE_FALSE(finished(thread).playing);
}

TEST_CASE("The thread ends while it plays, with changes of a big scene still to be made", "[threads]") {
    const auto thread = std::make_unique<app::SimulationThread>();
    thread->start(big_cloth());
    thread->play(true);
    wait_for(*thread, [](const app::Published& p) { return p.snapshot && p.snapshot->steps > 0; });
    sim::Description description = big_cloth();
    for (int n = 0; n < 20; ++n) {
        description.cloth.ks += 1;
        thread->change(description);
    }
    thread->step(1'000'000);
    // Its destruction here must not hang.
}

TEST_CASE("Any commands in any order leave a thread that does as it is told", "[threads]") {
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
