// The simulation's thread goes back and forth in what it has done.
#include <catch2/catch_test_macros.hpp>
#include <numeric>

#include "support/simulation_thread.h"
#include "timeline/player.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// The simulation after so many steps of a straight run.
std::unique_ptr<sim::Simulation> after(std::uint64_t steps, const sim::Description& description = small_cloth()) {
    auto simulation = sim::Simulation::create(description);
    while (simulation->steps() < steps)
        simulation->step();
    return simulation;
}

sim::Description softer() {
    sim::Description d = small_cloth();
    d.cloth.ks = 1000;
    return d;
}

} // namespace

TEST_CASE("A step back, of a frame or a substep, shows what was shown before", "[threads]") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    thread.step_frames(4);
    thread.step(3); // of five
    REQUIRE(finished(thread).snapshot->steps == 23);
    thread.step_back(false);
    REQUIRE(shows(finished(thread), *after(22)));
    thread.step_back(true); // to the frame's begin
    REQUIRE(shows(finished(thread), *after(20)));
    thread.step_back(true);
    REQUIRE(shows(finished(thread), *after(15)));
    thread.jump_to_start();
    REQUIRE(shows(finished(thread), *after(0)));
    thread.step_back(true);
    thread.step_back(false);
    REQUIRE(shows(finished(thread), *after(0)));
    thread.jump_to_end();
    REQUIRE(shows(finished(thread), *after(23)));
    REQUIRE(thread.latest().playhead.at_end);
}

TEST_CASE("What a step costs is told of the steps that are taken, not of those that a seek takes again", "[threads]") {
    const auto told = [](const app::Published& published) {
        const sim::StageSeconds& s = published.snapshot->seconds_per_step;
        return std::accumulate(s.begin(), s.end(), 0.0);
    };
    app::SimulationThread thread;
    thread.start(small_cloth());
    thread.step(1);
    REQUIRE(told(finished(thread)) > 0);
    thread.step_frames(20);
    finished(thread);
    for (const std::uint64_t step : {3u, 90u}) {
        thread.seek(step);
        REQUIRE(told(finished(thread)) == 0);
    }
    thread.step(1);
    REQUIRE(told(finished(thread)) > 0);
}

TEST_CASE("A seek shows the step that was asked for last, and pauses", "[threads]") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    thread.step_frames(20);
    finished(thread);
    thread.play(true);
    for (const std::uint64_t step : {3u, 90u, 41u, 17u})
        thread.seek(step);
    const app::Published published = finished(thread);
    REQUIRE(shows(published, *after(17)));
    REQUIRE_FALSE(published.playing);
    REQUIRE(published.playhead.moment.step == 17);
    REQUIRE_FALSE(published.playhead.at_end);
    thread.step(1); // goes on from there
    REQUIRE(shows(finished(thread), *after(18)));
    thread.seek(1'000'000); // the nearest there is
    REQUIRE(finished(thread).playhead.at_end);
}

TEST_CASE("Playing on from a rewound state comes to the bits of a run that never stopped", "[threads]") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    thread.set_speed(1000);
    thread.step_frames(10);
    finished(thread);
    thread.seek(12);
    thread.play(true);
    wait_for(thread, [](const app::Published& p) { return p.snapshot && p.snapshot->steps > 80; });
    thread.play(false);
    const app::Published published = finished(thread);
    REQUIRE(shows(published, *after(published.snapshot->steps)));
}

TEST_CASE("Played backwards the run goes frame by frame to its start and stops there", "[threads]") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    thread.set_speed(1000);
    thread.step_frames(12);
    thread.step(2);
    finished(thread);
    thread.play(true, true);
    const app::Published at_start =
        wait_for(thread, [](const app::Published& p) { return p.snapshot && p.snapshot->steps == 0 && !p.playing; });
    REQUIRE(shows(at_start, *after(0)));
    REQUIRE(at_start.overview->end_frame == 12); // the future is still there
}

TEST_CASE("Playing goes round in a loop, forwards and backwards", "[threads]") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    thread.set_speed(1000);
    thread.step_frames(12);
    finished(thread);
    thread.set_loop(timeline::FrameRange{4, 6});
    thread.seek(20);
    for (const bool backwards : {false, true}) {
        finished(thread);
        thread.play(true, backwards);
        for (int round = 0; round < 2; ++round)
            for (const std::uint64_t frame : {6u, 4u})
                wait_for(thread, [&](const app::Published& p) {
                    REQUIRE(p.playhead.frame >= 4);
                    REQUIRE(p.playhead.frame <= 6);
                    return p.playhead.frame == frame && p.playhead.substep == 0;
                });
        thread.play(false);
    }
    REQUIRE(finished(thread).overview->end_frame == 12);
}

TEST_CASE("A change after a rewind makes a branch, and the old future can be gone back to", "[threads]") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    thread.step_frames(10);
    finished(thread);
    thread.seek(25);
    const std::uint64_t ticket = thread.change(softer());
    const app::Published changed = finished(thread);
    REQUIRE(changed.taken >= ticket);
    REQUIRE(changed.description->cloth.ks == 1000);
    REQUIRE(changed.overview->branches.size() == 2);
    thread.step_frames(1);
    const auto straight = after(25);
    straight->change(softer());
    straight->step_frame();
    REQUIRE(shows(finished(thread), *straight));

    const timeline::BranchId first = changed.overview->branches[0].id;
    thread.with_player([first](timeline::Player& player) { player.switch_to(first); });
    app::Published back = finished(thread);
    REQUIRE(shows(back, *after(30)));
    REQUIRE(back.description->cloth.ks == 5000);
    thread.jump_to_end();
    REQUIRE(shows(finished(thread), *after(50)));
}

TEST_CASE("Over a change on the line the description follows, in both directions", "[threads]") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    thread.step_frames(3);
    finished(thread);
    thread.change(softer());
    thread.step_frames(3);
    REQUIRE(finished(thread).description->cloth.ks == 1000);
    thread.seek(7);
    REQUIRE(finished(thread).description->cloth.ks == 5000);
    thread.seek(15); // of the change itself: it has been made
    REQUIRE(finished(thread).description->cloth.ks == 1000);
    thread.step_back(false);
    REQUIRE(finished(thread).description->cloth.ks == 5000);
    thread.step(1);
    REQUIRE(finished(thread).description->cloth.ks == 1000);
    REQUIRE(finished(thread).overview->branches.size() == 1);
}

TEST_CASE("A breakpoint pauses after the step that makes its condition true, or before it, and then lets it pass",
          "[threads]") {
    // The step in which the lowest corner of the hanging cloth falls below 0.9 m.
    const auto straight = sim::Simulation::create(small_cloth());
    const std::size_t corner = straight->points() - 1;
    while (straight->position(corner).y >= 0.9)
        straight->step();
    for (const bool before : {false, true}) {
        app::SimulationThread thread;
        thread.start(small_cloth());
        thread.set_speed(1000);
        thread.set_breakpoints({{timeline::BreakpointKind::point_falls, 0.9, {7, 6}, before, true}});
        thread.play(true);
        const app::Published hit = wait_for(thread, [](const app::Published& p) { return p.hit.has_value(); });
        REQUIRE_FALSE(hit.playing);
        REQUIRE(hit.snapshot->steps == straight->steps() - (before ? 1 : 0));
        thread.step(1);
        REQUIRE_FALSE(finished(thread).hit);
        REQUIRE(finished(thread).snapshot->steps == straight->steps() + (before ? 0 : 1));
        thread.play(true);
        wait_for(thread, [&](const app::Published& p) { return p.snapshot->steps > straight->steps() + 20; });
        // Rewound and played again it hits again.
        thread.seek(straight->steps() - 10);
        thread.play(true);
        const app::Published again = wait_for(thread, [](const app::Published& p) { return p.hit.has_value(); });
        REQUIRE(again.snapshot->steps == hit.snapshot->steps);
    }
}

TEST_CASE("The ghost is the other branch at the same time", "[threads]") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    thread.step_frames(10);
    finished(thread);
    thread.seek(25);
    thread.change(softer());
    thread.step_frames(3);
    const app::Published branched = finished(thread);
    thread.show_ghost(branched.overview->branches[0].id);
    const app::Published shown = finished(thread);
    REQUIRE(shown.ghost);
    sim::Snapshot expected;
    after(40)->capture(expected);
    REQUIRE(shown.ghost->positions == expected.positions);
    REQUIRE(shown.ghost->positions != shown.snapshot->positions);
    thread.step_frames(20); // beyond the other's end
    REQUIRE_FALSE(finished(thread).ghost);
    thread.seek(30);
    REQUIRE(finished(thread).ghost);
    thread.show_ghost(0);
    REQUIRE_FALSE(finished(thread).ghost);
}

TEST_CASE("A restart is a run of its own beside the others, and a new scene forgets them all", "[threads]") {
    app::SimulationThread thread;
    thread.start(small_cloth());
    thread.step_frames(5);
    thread.restart(small_cloth()); // the same run: its start
    REQUIRE(finished(thread).overview->branches.size() == 1);
    REQUIRE(finished(thread).snapshot->steps == 0);
    thread.restart(softer());
    REQUIRE(finished(thread).overview->branches.size() == 2);
    sim::Description finer = softer();
    finer.cloth.num_width_points = 10; // cannot be changed live
    thread.change(finer);
    REQUIRE(finished(thread).overview->branches.size() == 3);
    REQUIRE(finished(thread).snapshot->columns == 10);
    thread.start(small_cloth());
    REQUIRE(finished(thread).overview->branches.size() == 1);
}
