// The pool of threads of a simulation, and how many of them it uses.
#include "sim/thread_pool.h"

#include <array>
#include <atomic>
#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <cmath>
#include <vector>

#include "sim/pace.h"
#include "sim/thread_choice.h"
#include "support/effort.h"

using namespace clothlab::sim;
using clothlab::test::attempts;

TEST_CASE("Each task of a round is done once, by as many threads as asked for, and all is done when run returns",
          "[threads]") {
    ThreadPool pool(4);
    REQUIRE(pool.threads() == 4);
    std::array<int, 4> done{};
    std::array<std::thread::id, 4> by;
    constexpr int rounds = attempts(20000);
    for (int round = 0; round < rounds; ++round) {
        const int count = 1 + round % 4;
        const auto task = [&](int index) {
            ++done[static_cast<std::size_t>(index)];
            by[static_cast<std::size_t>(index)] = std::this_thread::get_id();
        };
        pool.run(count, task);
    }
    REQUIRE(done == std::array{rounds, rounds / 4 * 3, rounds / 2, rounds / 4});
    REQUIRE(by[0] == std::this_thread::get_id());
    for (const std::size_t i : {1u, 2u, 3u})
        REQUIRE(by[i] != by[0]);
}

TEST_CASE("Threads that have gone to sleep wake up for the next round", "[threads]") {
    ThreadPool pool(3);
    std::array<int, 3> done{};
    for (int round = 0; round < 5; ++round) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        const auto task = [&](int index) { ++done[static_cast<std::size_t>(index)]; };
        pool.run(3, task);
    }
    REQUIRE(done == std::array{5, 5, 5});
}

TEST_CASE("A pool of one thread starts none and does everything itself") {
    ThreadPool pool(1);
    REQUIRE(pool.threads() == 1);
    int done = 0;
    pool.run(1, [&](int) { ++done; });
    REQUIRE(done == 1);
}

TEST_CASE("A pool says whether the others were still at work when the calling thread was done", "[threads]") {
    ThreadPool pool(3);
    std::atomic<int> begun{0};
    const auto until_all_have_begun = [&] {
        ++begun;
        while (begun < 3)
            std::this_thread::yield();
    };
    const auto others_last = [&](int index) {
        until_all_have_begun();
        if (index == 2)
            std::this_thread::sleep_for(std::chrono::milliseconds(30));
    };
    REQUIRE(pool.run(3, others_last));
    begun = 0;
    const auto caller_last = [&](int index) {
        until_all_have_begun();
        if (index == 0)
            std::this_thread::sleep_for(std::chrono::milliseconds(300));
    };
    REQUIRE_FALSE(pool.run(3, caller_last));
    REQUIRE_FALSE(pool.run(1, [](int) {}));
}

TEST_CASE(
    "Parts cover all points whatever the pace, and none has less than half of an even share or more than it may") {
    Pace pace;
    for (const bool slower : {true, false}) {
        for (int i = 0; i < 200; ++i) {
            pace.learn(slower);
            for (const std::size_t count : {2u, 3u, 8u}) {
                REQUIRE(pace.from(0, count, 1000) == 0);
                REQUIRE(pace.from(count, count, 1000) == 1000);
                for (std::size_t part = 0; part < count; ++part) {
                    const std::size_t points = pace.from(part + 1, count, 1000) - pace.from(part, count, 1000);
                    REQUIRE(2 * count * points >= 1000);
                    REQUIRE(points <= Pace::most(part, count, 1000));
                }
            }
        }
        REQUIRE(pace.pace() == (slower ? 2.0 : 0.5));
    }
}

TEST_CASE("A thread that takes longer for a point comes to have as many points fewer") {
    for (const double others_slower : {0.7, 1.0, 1.5}) {
        Pace pace;
        constexpr std::size_t points = 1000000;
        for (int step = 0; step < 300; ++step) {
            const std::size_t own = pace.from(1, 2, points);
            pace.learn(others_slower * static_cast<double>(points - own) > static_cast<double>(own));
        }
        REQUIRE(std::abs(pace.pace() / others_slower - 1) < 0.05);
    }
}

TEST_CASE("Who is last by turns changes no thread's share") {
    Pace pace;
    for (int step = 0; step < 1000; ++step)
        pace.learn(step % 4 < 2);
    REQUIRE(pace.pace() == 1);
}

TEST_CASE("A run that is told to uses all its threads, in every step") {
    ThreadChoice choice(6, false);
    for (int i = 0; i < 1000; ++i) {
        REQUIRE(choice.threads() == 6);
        choice.begin_step();
        choice.end_step();
    }
}

TEST_CASE("A run that may choose tries one thread, two, four and all, and keeps to the fastest") {
    for (const int fastest : {1, 4, 6}) {
        ThreadChoice choice(6, true);
        std::vector<int> tried;
        const auto step = [&] {
            const int threads = choice.threads();
            if (tried.empty() || tried.back() != threads)
                tried.push_back(threads);
            choice.begin_step();
            if (threads != fastest)
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            choice.end_step();
        };
        for (int i = 0; i < 4 * 4 * 8; ++i)
            step();
        REQUIRE(std::vector<int>(tried.begin(), tried.begin() + 5) == std::vector{1, 2, 4, 6, 1});
        for (int i = 0; i < 100; ++i) {
            REQUIRE(choice.threads() == fastest);
            choice.begin_step();
            choice.end_step();
        }
    }
}

TEST_CASE("Steps that are taken many at once are compared with single ones by the time of each") {
    ThreadChoice choice(2, true);
    const auto go_on = [&] { // two threads take ten steps in the time in which one takes two
        choice.begin_step();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        choice.end_step(choice.threads() == 1 ? 2 : 10);
    };
    for (int i = 0; i < 4 * (4 + 1); ++i)
        go_on();
    for (int i = 0; i < 100; ++i) {
        REQUIRE(choice.threads() == 2);
        go_on();
    }
}

TEST_CASE("A run whose threads are held up goes on with one") {
    ThreadChoice choice(2, true);
    bool held_up = false;
    const auto step = [&] {
        choice.begin_step();
        if (choice.threads() == 1 || held_up)
            std::this_thread::sleep_for(std::chrono::milliseconds(choice.threads() == 1 ? 1 : 5));
        choice.end_step();
    };
    for (int i = 0; i < 2 * 4 * 8; ++i)
        step();
    REQUIRE(choice.threads() == 2);
    for (int i = 0; i < 200; ++i)
        step();
    REQUIRE(choice.threads() == 2);
    held_up = true;
    for (int i = 0; i < 64; ++i)
        step();
    REQUIRE(choice.threads() == 1);
}

TEST_CASE("A run whose threads were held up for a moment goes back to them before long, and later each time") {
    ThreadChoice choice(2, true);
    const auto go_on = [&](int milliseconds) { // by 32 steps at once
        choice.begin_step();
        std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
        choice.end_step(32);
    };
    const auto as_usual = [&] { go_on(choice.threads() == 1 ? 6 : 2); };
    as_usual();
    for (const int alone : {512, 1024, 2048}) { // first while they are measured
        REQUIRE(choice.threads() == 2);
        go_on(60);
        for (int steps = 0; steps < alone; steps += 32) {
            REQUIRE(choice.threads() == 1);
            as_usual();
        }
        for (int block = 0; block < 2 * 4; ++block)
            as_usual();
    }
}

TEST_CASE("A run whose steps have become another work looks again before long") {
    ThreadChoice choice(2, true);
    bool folded = false;
    const auto step = [&] {
        const int microseconds = folded ? (choice.threads() == 1 ? 4000 : 1000) : (choice.threads() == 1 ? 100 : 1000);
        choice.begin_step();
        std::this_thread::sleep_for(std::chrono::microseconds(microseconds));
        choice.end_step();
    };
    for (int i = 0; i < 2 * 4 * 8 + 600; ++i)
        step();
    REQUIRE(choice.threads() == 1);
    folded = true;
    for (int i = 0; i < 9 * 32 + 2 * 4 * 8; ++i)
        step();
    REQUIRE(choice.threads() == 2);
}

TEST_CASE("What passes between two steps is not their time: a run at the pace of the clock keeps its threads") {
    ThreadChoice choice(2, true);
    for (int i = 0; i < 2 * 4 * 8 + 200; ++i) {
        choice.begin_step();
        std::this_thread::sleep_for(std::chrono::microseconds(choice.threads() == 1 ? 500 : 200));
        choice.end_step();
        if (i % 20 == 19)
            std::this_thread::sleep_for(std::chrono::milliseconds(30));
    }
    REQUIRE(choice.threads() == 2);
}
