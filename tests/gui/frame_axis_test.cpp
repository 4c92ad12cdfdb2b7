// Where steps lie on the timeline's track, and which moments are on the line shown.
#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "made_up_timeline.h"
#include "ui/frame_axis.h"

namespace clothlab::test {
namespace {

timeline::DescriptionPtr stepping(int substeps, double frames_per_second) {
    sim::Description d;
    d.stepping.substeps = substeps;
    d.stepping.frames_per_second = frames_per_second;
    return std::make_shared<const sim::Description>(d);
}

/// 10 frames of 30 substeps at 90 frames/s, then 10 of 60 substeps, then 10 at 45 frames/s.
ui::FrameAxis changing_axis() {
    timeline::Overview o;
    const auto a = stepping(30, 90), b = stepping(60, 90), c = stepping(60, 45);
    o.end_step = 300 + 600 + 600;
    o.end_frame = 30;
    o.changes = {{300, 10, 0, 1, a, b}, {900, 20, 0, 1, b, c}};
    return {o, {}};
}

} // namespace

TEST_CASE("Steps and frames go together over changes of the substeps, and back") {
    const ui::FrameAxis axis = changing_axis();
    CHECK(axis.frame_of(0) == 0);
    CHECK(axis.frame_of(15) == 0.5);
    CHECK(axis.frame_of(300) == 10);
    CHECK(axis.frame_of(330) == 10.5);
    CHECK(axis.frame_of(900) == 20);
    CHECK(axis.end() == 30);
    for (std::uint64_t step = 0; step <= 1500; ++step)
        CHECK(axis.step_of(axis.frame_of(step)) == step);
    CHECK(axis.substeps_at(5) == 30);
    CHECK(axis.substeps_at(15) == 60);
}

TEST_CASE("Steps are never before the start nor after the end") {
    const ui::FrameAxis axis = changing_axis();
    CHECK(axis.step_of(-3) == 0);
    CHECK(axis.step_of(99) == 1500);
}

TEST_CASE("Frames and seconds go together over changes of the frame rate, and back") {
    const ui::FrameAxis axis = changing_axis();
    CHECK(std::abs(axis.time_of(20) - 20.0 / 90) < 1e-12);
    CHECK(std::abs(axis.time_of(30) - (20.0 / 90 + 10.0 / 45)) < 1e-12);
    for (const double frame : {0.0, 7.5, 10.0, 19.9, 25.0, 30.0})
        CHECK(std::abs(axis.frame_at(axis.time_of(frame)) - frame) < 1e-9);
}

TEST_CASE("A frame that is left with fewer substeps than it has taken is over") {
    timeline::Overview o;
    o.changes = {{25, 0, 25, 1, stepping(30, 90), stepping(10, 90)}};
    o.end_step = 35;
    const ui::FrameAxis axis(o, {});
    CHECK(axis.frame_of(25) == 1);
    CHECK(axis.frame_of(35) == 2);
}

TEST_CASE("What lies before a fork is on the lines of both branches, what comes after it only on its own") {
    const auto o = made_up_overview(); // branch 2 is shown; 3 left it at frame 900, it left 1 at frame 400
    CHECK(ui::on_line(*o, {2, 30000}));
    CHECK(ui::on_line(*o, {1, 400 * 30}));
    CHECK_FALSE(ui::on_line(*o, {1, 400 * 30 + 1}));
    CHECK(ui::on_line(*o, {3, 900 * 30}));
    CHECK_FALSE(ui::on_line(*o, {3, 900 * 30 + 1}));
    CHECK(ui::on_line(*o, {3, 60}));
    CHECK_FALSE(ui::on_line(*o, {7, 60}));
}

TEST_CASE("Ticks are at 1, 2 or 5 times a power of ten") {
    CHECK(ui::round_step(1) == 1);
    CHECK(ui::round_step(1.01) == 2);
    CHECK(ui::round_step(3) == 5);
    CHECK(ui::round_step(51) == 100);
    CHECK(std::abs(ui::round_step(0.013) - 0.02) < 1e-12);
}

} // namespace clothlab::test
