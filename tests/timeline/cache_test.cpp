// The cache: what stays within the budget, and what goes first.
#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "support/effort.h"
#include "support/timelines.h"

using namespace clothlab;
using namespace clothlab::test;
using namespace clothlab::timeline;

TEST_CASE("Within the budget nothing is thinned out") {
    Timeline timeline = made_up(1 << 20, 100, 1000, 0.001);
    timeline.fit();
    const Branch& branch = timeline.branches()[0];
    REQUIRE(branch.keyframes.size() == 101);
    REQUIRE(widest_gap(branch) == 1);
}

TEST_CASE("Over the budget states thin out evenly, the older ones first, and every frame stays reachable") {
    Timeline timeline = made_up(100'000, 150, 1000, 0.00099);
    REQUIRE(timeline.memory() > 100'000);
    timeline.fit(); // ten frames are within a seek's time: gaps of five, then of ten
    REQUIRE(timeline.memory() <= 100'000);
    const Branch& branch = timeline.branches()[0];
    REQUIRE(widest_gap(branch) == 5);
    const auto stored_between = [&](std::uint64_t from, std::uint64_t to) {
        return std::count_if(branch.keyframes.begin(), branch.keyframes.end(),
                             [&](const Keyframe& k) { return k.step >= 30 * from && k.step < 30 * to; });
    };
    REQUIRE(stored_between(0, 50) == 10);
    REQUIRE(stored_between(100, 150) == 50);
    for (std::uint64_t step = 0; step <= branch.end; ++step)
        REQUIRE(timeline.reachable({branch.id, step}));
}

TEST_CASE("States thin out to as many frames as a seek may take before any frame is dropped") {
    for (const unsigned widest : {1u, 2u, 3u, 5u, 6u, 7u, 12u}) {
        INFO(widest << " frames are within a seek's time");
        Timeline timeline = made_up(1 << 20, 600, 1000, 0.01 / (widest + 0.1));
        CacheOptions options = timeline.options();
        const std::size_t state = timeline.memory() / 600;
        const std::size_t samples = 600 * sizeof(Sample), least = samples + state * (600 / widest + 1) * 21 / 20;
        // Less and less, as for a run that grows.
        for (options.budget = timeline.memory(); options.budget > least; options.budget -= state) {
            timeline.set_options(options);
            timeline.fit();
        }
        REQUIRE(timeline.branches()[0].samples.size() == 600);
        REQUIRE(widest_gap(timeline.branches()[0]) == widest);
    }
}

TEST_CASE("No seek becomes slower than it may: then the oldest states are dropped, and with them their frames") {
    for (const double frame_s : {0.001, 0.003, 0.1}) {
        Timeline timeline = made_up(20'000, 400, 1000, frame_s);
        timeline.fit();
        INFO(frame_s << " s for a frame");
        REQUIRE(timeline.memory() <= 20'000);
        const Branch& branch = timeline.branches()[0];
        REQUIRE(static_cast<double>(widest_gap(branch)) <= std::max(1.0, std::floor(0.0101 / frame_s)));
        REQUIRE(timeline.reachable({branch.id, branch.end})); // the newest
        REQUIRE(timeline.reachable({branch.id, 0}));          // a start costs nothing
        REQUIRE_FALSE(timeline.reachable({branch.id, 100 * 30}));
        // What is reachable has its samples, and what is not has none.
        for (const Sample& sample : branch.samples)
            REQUIRE(timeline.reachable({branch.id, 30 * sample.frame}));
        REQUIRE(branch.samples.back().frame == 400);
    }
}

TEST_CASE("Seconds that are to be kept are kept by slower seeks, of up to four times as long") {
    Timeline timeline = made_up(150'000, 600, 1000, 0.003, 5);
    timeline.fit(); // three frames in a seek's time; a stride of twelve keeps all, and so six of the seconds
    REQUIRE(timeline.memory() <= 150'000);
    REQUIRE(timeline.reach_s() >= 5);
    REQUIRE(widest_gap(timeline.branches()[0]) <= 12);
}

TEST_CASE("Bookmarked and marked states go last") {
    Timeline timeline = made_up(1 << 20, 400, 1000, 0.1);
    const BranchId id = timeline.branches()[0].id;
    timeline.add_bookmark({id, 30 * 100}, "fold", {});
    timeline.find(id)->marks.push_back({MarkKind::first_contact, 30 * 150, 150, 0, "contact"});
    timeline.refresh_kept(id);
    CacheOptions options = timeline.options();
    options.budget = 20'000;
    timeline.set_options(options);
    timeline.fit();
    REQUIRE(timeline.memory() <= 20'000);
    REQUIRE(timeline.reachable({id, 30 * 100}));
    REQUIRE(timeline.reachable({id, 30 * 150}));
    REQUIRE_FALSE(timeline.reachable({id, 30 * 120}));
    options.budget = 2'000; // not even for those
    timeline.set_options(options);
    timeline.fit();
    REQUIRE_FALSE(timeline.reachable({id, 30 * 100}));
    REQUIRE(timeline.reachable({id, 30 * 400}));
}

TEST_CASE("An hour of play stays within the budget, and what is reachable is right to the bit") {
    const std::uint64_t frames = sanitized ? 20'000 : 324'000; // at 90 a second
    const std::size_t budget = sanitized ? 300'000 : 4'000'000;
    Player player({.budget = budget, .seek_s = 1e-4});
    sim::Description description = tiny_cloth();
    player.start(description);
    const auto straight = sim::Simulation::create(description);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> hashes; // of some steps
    for (std::uint64_t frame = 0; frame < frames; ++frame) {
        if (frame % 5000 == 2500) { // somebody plays with the stiffness
            description.cloth.ks = 4000 + static_cast<double>(frame % 7) * 100;
            player.change(description);
            straight->change(description);
        }
        for (int n = 0; n < 2; ++n)
            player.step(), straight->step();
        if (frame % 1000 == 0)
            REQUIRE(player.memory() <= budget);
        if (frame % 997 == 0)
            hashes.emplace_back(straight->steps(), straight->hash());
    }
    REQUIRE(player.simulation().hash() == straight->hash());
    std::size_t reached = 0;
    for (const auto& [step, hash] : hashes)
        if (player.timeline().reachable({player.line(), step})) {
            ++reached;
            REQUIRE(hash_at(player, step) == hash);
        }
    REQUIRE(reached > 0);
    REQUIRE(reached < hashes.size()); // or the budget was no test
    REQUIRE(player.timeline().branches().size() == 1);
}

TEST_CASE("Where a frame takes longer than a seek may, states within it are stored as well") {
    for (const double seek_s : {1e-9, 10.0}) {
        Player player({.seek_s = seek_s});
        player.start(tiny_cloth());
        std::vector<std::uint64_t> hashes{player.simulation().hash()};
        for (int n = 0; n < 40; ++n) {
            player.step();
            hashes.push_back(player.simulation().hash());
        }
        const std::vector<Keyframe>& stored = player.timeline().branches()[0].keyframes;
        const auto within =
            std::count_if(stored.begin(), stored.end(), [](const Keyframe& k) { return k.step % 2 == 1; });
        REQUIRE((within > 0) == (seek_s < 1));
        for (std::uint64_t step = 0; step < hashes.size(); ++step)
            REQUIRE(hash_at(player, step) == hashes[step]);
    }
}

TEST_CASE("A gap is as wide as the frames in it took: dear ones lie closer together") {
    Timeline timeline = made_up(1 << 20, 600, 1000, 0.0011);
    const BranchId id = timeline.branches()[0].id;
    for (Sample& sample : timeline.find(id)->samples)
        if (sample.frame > 200 && sample.frame <= 260)
            sample = sample_of(sample.frame, 0.0032);
    CacheOptions options = timeline.options();
    const std::size_t state = timeline.memory() / 600;
    for (options.budget = timeline.memory(); options.budget > 130'000; options.budget -= state) {
        timeline.set_options(options);
        timeline.fit();
    }
    const Branch& branch = timeline.branches()[0];
    REQUIRE(std::abs(timeline.reach_s() - 600 / 90.0) < 1e-9);
    REQUIRE(widest_gap(branch) == 9);
    for (const Keyframe& keyframe : branch.keyframes) {
        const std::uint64_t first = keyframe.step / 30, last = keyframe.until / 30;
        const std::uint64_t dear =
            std::clamp<std::uint64_t>(last, 200, 260) - std::clamp<std::uint64_t>(first, 200, 260);
        INFO("frames " << first << " to " << last);
        REQUIRE(0.0032 * static_cast<double>(dear) + 0.0011 * static_cast<double>(last - first - dear) <= 0.0101);
    }
}

TEST_CASE("A frame that takes longer than a seek may has states within it, none of which is thinned out by default") {
    Player all({.seek_s = 1e-9});
    all.start(tiny_cloth());
    for (int n = 0; n < 600; ++n)
        all.step();
    Player player({.budget = all.memory() / 2, .seek_s = 1e-9});
    player.start(tiny_cloth());
    for (int n = 0; n < 600; ++n)
        player.step();
    REQUIRE(player.memory() <= player.options().budget);
    const Branch& branch = player.timeline().branches()[0];
    for (const Keyframe& keyframe : branch.keyframes)
        REQUIRE(keyframe.until <= keyframe.step + 1); // a step always takes longer than a nanosecond
    REQUIRE(player.timeline().reachable({player.line(), 600}));
    REQUIRE_FALSE(player.timeline().reachable({player.line(), 100}));
}

TEST_CASE("States within frames are thinned out before any frame of the seconds to be kept is lost") {
    Player all({.seek_s = 1e-9});
    all.start(tiny_cloth());
    for (int n = 0; n < 600; ++n)
        all.step();
    Player player({.budget = all.memory() * 5 / 6,
                   .seek_s = 1e-9,
                   .least_reach_s = 60}); // too little for both, enough for the frames
    player.start(tiny_cloth());
    for (int n = 0; n < 600; ++n)
        player.step();
    REQUIRE(player.memory() <= player.options().budget);
    for (std::uint64_t step = 0; step <= 600; ++step)
        REQUIRE(player.timeline().reachable({player.line(), step}));
}

TEST_CASE("A timeline that is taken over, as from a file, is thinned out by what its frames cost before any is lost") {
    Player recorded({.seek_s = 0}); // a state at every step
    recorded.start(tiny_cloth());
    for (int n = 0; n < 600; ++n)
        recorded.step();
    const std::uint64_t hash = recorded.simulation().hash();
    Player player({.budget = recorded.memory() / 3, .seek_s = 1});
    player.adopt(recorded.timeline(), recorded.moment());
    REQUIRE(player.memory() <= player.options().budget);
    for (std::uint64_t step = 0; step <= 600; ++step)
        REQUIRE(player.timeline().reachable({player.line(), step}));
    REQUIRE(hash_at(player, 300) != hash);
    REQUIRE(hash_at(player, 600) == hash);
}
