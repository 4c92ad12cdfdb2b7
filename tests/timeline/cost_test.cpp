// What the timeline costs: no claims, but the numbers of docs/timeline.md. `build/clothlab_tests "[timeline-cost]"`
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <cstdio>

#include "sim/random.h"
#include "timeline/player.h"

using namespace clothlab;
using namespace clothlab::timeline;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Steps of whole frames; the wall time of them all, in s.
template <class Step>
double play(int frames, int substeps, Step step) {
    const Clock::time_point begin = Clock::now();
    for (int n = 0; n < frames * substeps; ++n)
        step();
    return seconds_since(begin);
}

/// Median and largest time in ms of seeks to random moments. Each is gone to three times, in the same order, and its
/// fastest counts: what else the machine does only ever makes one slower.
std::pair<double, double> seek_ms(Player& player, std::uint64_t unit, std::size_t seeks) {
    const std::uint64_t end = player.timeline().find(player.line())->end;
    std::vector<double> times(seeks, 1e9);
    for (int round = 0; round < 3; ++round) {
        sim::SplitMix64 random(7);
        player.seek(0);
        for (double& time : times) {
            // Of those that are reachable.
            std::uint64_t step = 0;
            do
                step = random.next() % (end / unit + 1) * unit;
            while (!player.timeline().reachable({player.line(), step}));
            const Clock::time_point begin = Clock::now();
            player.seek(step);
            time = std::min(time, 1000 * seconds_since(begin));
        }
    }
    std::sort(times.begin(), times.end());
    return {times[times.size() / 2], times.back()};
}

void measure(const char* name, sim::Description description, int points, int frames, std::size_t budget_mb,
             double least_reach_s = 0, std::size_t disk_mb = 0) {
    description.cloth.num_width_points = description.cloth.num_height_points = points;
    if (!description.cloth.pinned.empty())
        description.cloth.pinned = {{0, 0}, {points - 1, 0}};
    for (const sim::Precision precision : {sim::Precision::single_precision, sim::Precision::double_precision}) {
        description.stepping.precision = precision;
        const int substeps = description.stepping.substeps;
        const auto plain = sim::Simulation::create(description);
        Player player({.budget = budget_mb << 20, .least_reach_s = least_reach_s, .disk = disk_mb << 20});
        player.start(description);
        double plain_s = 0, recorded_s = 0;
        for (int round = 0; round < 10; ++round) { // by turns, so that both meet the same machine
            plain_s += play(frames / 10, substeps, [&] { plain->step(); });
            recorded_s += play(frames / 10, substeps, [&] { player.step(); });
        }
        REQUIRE(player.simulation().hash() == plain->hash());
        const Branch& branch = player.timeline().branches()[0];
        std::size_t stored = 0;
        std::uint64_t widest = 0;
        for (const Keyframe& keyframe : branch.keyframes) {
            stored += keyframe.state ? std::max(keyframe.state->memory(), keyframe.state->on_disk()) : 0;
            widest = std::max(widest, (keyframe.until - keyframe.step) / static_cast<std::uint64_t>(substeps));
        }
        const std::size_t states = branch.keyframes.size() - 1;
        const auto frame_seek = seek_ms(player, static_cast<std::uint64_t>(substeps), 200);
        const auto step_seek = seek_ms(player, 1, 200);
        const double reach = player.timeline().reach_s();
        std::printf("%-9s %4d² %-6s  %5.2f ms/frame, recorded x %.3f;  raw %4zu kB, stored %5.1f kB; %4zu states, gap "
                    "<= %llu;  %5.1f s of %5.1f s in %3zu MB and %.0f on disk (%5.1f kB/frame);  seek to frame %5.1f "
                    "(<= %5.1f) ms, to step "
                    "%5.1f (<= %5.1f) ms\n",
                    name, points, precision == sim::Precision::single_precision ? "single" : "double",
                    1000 * plain_s / frames, recorded_s / plain_s, player.simulation().save_state().size() / 1000,
                    states > 0 ? static_cast<double>(stored) / 1000 / static_cast<double>(states) : 0.0, states,
                    static_cast<unsigned long long>(widest), reach, frames / 90.0, budget_mb,
                    static_cast<double>(player.timeline().on_disk()) / (1 << 20),
                    static_cast<double>(player.timeline().memory() + player.timeline().on_disk()) / 1000 / (reach * 90),
                    frame_seek.first, frame_seek.second, step_seek.first, step_seek.second);
        std::fflush(stdout);
    }
}

} // namespace

TEST_CASE("What the timeline costs", "[.][timeline-cost]") {
    sim::Description hanging; // the course's defaults
    hanging.cloth.pinned = {{0, 0}, {49, 0}};
    sim::Description falling;
    falling.cloth.orientation = sim::Orientation::vertical;
    falling.colliders = {sim::Plane{{0, 0, 0}, {0, 1, 0}, 0.5}};
    measure("hanging", hanging, 50, 5400, 64);
    measure("falling", falling, 50, 5400, 64);
    measure("hanging", hanging, 200, 120, 512);
    measure("falling", falling, 200, 120, 512);
    measure("falling, slow ones too", falling, 50, 5400, 64, 60);
    measure("falling, and on disk", falling, 50, 5400, 64, 0, 1024);
    measure("falling, and on disk", falling, 200, 120, 512, 0, 1024);
}
