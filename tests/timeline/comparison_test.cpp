// How far two branches are apart: each point's distance, and the curve over the frames that both have.
#include "timeline/comparison.h"

#include <algorithm>
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>
#include <limits>

#include "sim/random.h"
#include "support/branches.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinRel;
using timeline::BranchId;
using timeline::DistanceSample;

namespace {

std::vector<DistanceSample> curve(timeline::Comparison comparison) {
    while (comparison.advance())
        ;
    return comparison.samples();
}

void require_same(const std::vector<DistanceSample>& a, const std::vector<DistanceSample>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        CHECK(a[i].frame == b[i].frame);
        CHECK(std::abs(a[i].time - b[i].time) < 1e-12);
        CHECK(a[i].distance.rms == b[i].distance.rms);
        CHECK(a[i].distance.max == b[i].distance.max);
    }
}

std::vector<float> positions(const sim::Simulation& simulation) {
    sim::Snapshot snapshot;
    simulation.capture(snapshot);
    return snapshot.positions;
}

} // namespace

TEST_CASE("The distance of clouds of points is that of each, with its mean square and its maximum", "[comparison]") {
    for (const std::size_t points : {1u, 7u, 8u, 9u, 2500u}) {
        sim::SplitMix64 random(points);
        std::vector<float> a, b;
        for (std::size_t i = 0; i < 3 * points; ++i) {
            a.push_back(static_cast<float>(random.unit()));
            b.push_back(static_cast<float>(random.unit()));
        }
        std::vector<float> each;
        const timeline::Distance d = timeline::distance(a, b, each);
        REQUIRE(each.size() == points);
        double sum = 0, most = 0;
        for (std::size_t i = 0; i < points; ++i) {
            const auto along = [&](std::size_t axis) {
                return static_cast<double>(a[3 * i + axis]) - static_cast<double>(b[3 * i + axis]);
            };
            const double length = std::sqrt(along(0) * along(0) + along(1) * along(1) + along(2) * along(2));
            REQUIRE(each[i] == static_cast<float>(length));
            sum += length * length;
            most = std::max(most, length);
        }
        REQUIRE_THAT(d.rms, WithinRel(std::sqrt(sum / static_cast<double>(points)), 1e-14));
        REQUIRE(d.max == most);
    }
}

TEST_CASE("A micrometre is measured at a kilometre", "[comparison]") {
    std::vector<float> a{1000, 1000, 1000}, b = a, each;
    b[1] = std::nextafter(b[1], 2000.f);
    const double step = static_cast<double>(b[1]) - 1000;
    const timeline::Distance d = timeline::distance(a, b, each);
    CHECK(d.rms == step);
    CHECK(d.max == step);
    CHECK(each[0] == static_cast<float>(step));
}

TEST_CASE("Points that are not finite count as no distance, and other numbers of points are refused", "[comparison]") {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    std::vector<float> a(30, 0.f), b(30, 0.f), each;
    a[0] = nan;
    b[4] = inf;
    a[8] = b[8] = inf;
    a[27] = 2;
    const timeline::Distance d = timeline::distance(a, b, each);
    CHECK(d.max == 2);
    CHECK_THAT(d.rms, WithinRel(2 / std::sqrt(10.0), 1e-15));
    CHECK(std::count(each.begin(), each.end(), 0.f) == 9);
    CHECK_THROWS_AS(timeline::distance(a, std::vector<float>(27), each), std::invalid_argument);
    const timeline::Distance nothing = timeline::distance({}, {}, each);
    CHECK(nothing.rms == 0);
    CHECK(each.empty());
}

TEST_CASE("The curve of two branches is what two simulations of their own give", "[comparison]") {
    Branches made(20, 5, 0.3, 12);
    const auto samples = curve({made.player.timeline(), made.stiff, made.soft});
    const auto a = sim::Simulation::create(made.description), b = sim::Simulation::create(made.description);
    std::vector<DistanceSample> expected;
    std::vector<float> each;
    for (std::uint64_t frame = 0; frame <= 12; ++frame) {
        if (frame >= 5)
            expected.push_back({frame, a->time(), timeline::distance(positions(*a), positions(*b), each)});
        if (frame == 5)
            b->change(made.softer);
        a->step_frame();
        b->step_frame();
    }
    require_same(samples, expected);
    REQUIRE(samples.front().distance.max == 0);
    REQUIRE(samples.back().distance.max > 1e-4);
    require_same(curve({made.player.timeline(), made.soft, made.stiff}), expected); // they are as far apart either way
}

TEST_CASE("Lines of other steps are compared at the same time", "[comparison]") {
    Branches made(20, 5, 1, 12, 7); // the same cloth in 7 steps per frame, not 4
    const timeline::Timeline& all = made.player.timeline();
    const auto there = timeline::same_time(all, {made.stiff, 40}, made.soft);
    REQUIRE(there);
    CHECK(there->branch == made.soft);
    CHECK(there->step == 20 + 35);
    for (std::uint64_t step = 0; step <= 48; ++step) {
        const auto moment = timeline::same_time(all, {made.stiff, step}, made.soft);
        REQUIRE(moment);
        const double away = all.frame_time(*moment).time - all.frame_time({made.stiff, step}).time;
        CHECK(std::abs(away) <= 0.501 / 90 / 7);
        if (step <= 20)
            CHECK(moment->step == step);
    }
    CHECK_FALSE(timeline::same_time(all, {made.stiff, 60}, made.soft)); // it has nothing so late
    CHECK_FALSE(timeline::same_time(all, {made.stiff, 60}, 77));
    const auto samples = curve({all, made.stiff, made.soft});
    REQUIRE(samples.size() == 8);
    CHECK(samples.front().frame == 5);
    CHECK(samples.back().frame == 12);
    CHECK(samples.back().distance.max > 0);
    CHECK(samples.back().distance.max < 0.01);
}

TEST_CASE("Lines of another grid are not compared", "[comparison]") {
    Branches made(6, 3, 0.3, 5);
    sim::Description finer = made.description;
    finer.cloth.num_width_points = 9;
    made.player.start(finer);
    made.play(4);
    const BranchId other = made.player.line();
    REQUIRE(other != made.stiff);
    CHECK_FALSE(timeline::same_time(made.player.timeline(), {made.stiff, 8}, other));
    timeline::Comparison comparison(made.player.timeline(), made.stiff, other);
    CHECK_FALSE(comparison.advance());
    CHECK(comparison.progress() == 1);
    CHECK_FALSE(timeline::Comparison(made.player.timeline(), made.stiff, 99).advance());
}

TEST_CASE("Two runs with starts of their own are compared from the start", "[comparison]") {
    Branches made(6, 3, 0.3, 5);
    sim::Description higher = made.description;
    higher.cloth.offset = {0, 0.25, 0};
    made.player.start(higher);
    made.play(4);
    const auto samples = curve({made.player.timeline(), made.stiff, made.player.line()});
    REQUIRE(samples.size() == 5);
    CHECK(samples.front().frame == 0);
    CHECK(samples.front().time == 0);
    CHECK_THAT(samples.front().distance.rms, WithinRel(0.25, 1e-6));
    CHECK_THAT(samples.front().distance.max, WithinRel(0.25, 1e-6));
}

TEST_CASE("Frames that one of the lines has dropped are left out of the curve", "[comparison]") {
    Branches made(20, 5, 0.3, 20);
    const auto whole = curve({made.player.timeline(), made.stiff, made.soft});
    for (const BranchId gone_of : {made.stiff, made.soft}) {
        timeline::Timeline holed = made.player.timeline();
        timeline::Branch& branch = *holed.find(gone_of);
        made.store_every_frame(holed, gone_of);
        std::erase_if(branch.keyframes, [](const timeline::Keyframe& k) { return k.step >= 40 && k.step < 60; });
        const auto rest = curve({holed, made.stiff, made.soft});
        std::vector<DistanceSample> expected;
        std::copy_if(whole.begin(), whole.end(), std::back_inserter(expected), [&](const DistanceSample& s) {
            return holed.reachable({gone_of, 4 * s.frame});
        });
        REQUIRE(expected.size() < whole.size());
        REQUIRE(expected.back().frame == 20);
        require_same(rest, expected);
        CHECK_FALSE(timeline::same_time(holed, {made.stiff == gone_of ? made.soft : made.stiff, 46}, gone_of));
    }
}

TEST_CASE("A curve grows with its lines and is then the same as one computed at once", "[comparison]") {
    Branches made(8, 3, 0.3, 6);
    timeline::Comparison comparison(made.player.timeline(), made.soft, made.stiff);
    REQUIRE(comparison.advance());
    CHECK(comparison.progress() > 0);
    while (comparison.advance())
        ;
    CHECK(comparison.progress() == 1);
    const std::size_t before = comparison.samples().size();
    sim::Description again = made.softer;
    again.cloth.ks = 900;
    made.player.switch_to(made.soft);
    made.player.seek(made.player.timeline().find(made.soft)->end);
    made.player.change(again); // where the comparison's reader stands
    REQUIRE(made.player.line() == made.soft);
    made.play(2);
    comparison.grow(made.player.timeline());
    REQUIRE(comparison.progress() < 1);
    while (comparison.advance())
        ;
    REQUIRE(comparison.samples().size() == before + 2);
    require_same(comparison.samples(), curve({made.player.timeline(), made.soft, made.stiff}));
}
