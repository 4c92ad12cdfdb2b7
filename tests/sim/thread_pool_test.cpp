// The pool of threads of a simulation, and how many of them it uses.
#include "sim/thread_pool.h"

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <vector>

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
