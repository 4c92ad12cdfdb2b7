// The timeline's track and the curves under it, worked with the mouse.
#include <imgui.h>

#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "made_up_timeline.h"
#include "panel_driver.h"
#include "ui/icons.h"

namespace clothlab::test {
namespace {

constexpr const char* track = "###Timeline/track";
constexpr float band = 0.64f; ///< share of the track's height where the cache is drawn, below the rulers

struct Track {
    PanelDriver driver;
    Track() {
        show_made_up_timeline(driver.lab);
        driver.settle();
    }
    /// Where a frame is, at a share of the height.
    ImVec2 at(ImGuiTestContext* user, double frame, float height = band, const char* item = track) const {
        const ImRect r = user->ItemInfo(item).RectFull;
        const ui::TimelineView& view = driver.lab.timeline_view;
        const double share = (frame - view.first) / (view.last - view.first);
        return {r.Min.x + static_cast<float>(share) * r.GetWidth(), r.Min.y + height * r.GetHeight()};
    }
    std::vector<ui::SeekStep> seeks() const { return driver.asked<ui::SeekStep>(); }
};

constexpr float places = 0.9f, loop = 0.06f, ruler = 0.3f;

} // namespace

TEST_CASE("Dragging on the track seeks the frames that the mouse comes to, each once") {
    Track t;
    REQUIRE(t.driver.act([&](ImGuiTestContext* user) {
        user->MouseMoveToPos(t.at(user, 1100));
        user->MouseDown(0);
        user->Yield(3); // held: nothing new
        user->MouseMoveToPos(t.at(user, 1300));
        user->MouseMoveToPos(t.at(user, 1500));
        user->MouseUp(0);
        user->MouseMoveToPos(t.at(user, 1200)); // no longer
    }));
    const auto seeks = t.seeks();
    REQUIRE(seeks.size() >= 3);
    for (std::size_t i = 0; i < seeks.size(); ++i) {
        CHECK(seeks[i].step % 30 == 0); // a pixel is wider than a frame: frames' ends
        CHECK((i == 0 || seeks[i].step != seeks[i - 1].step));
    }
    CHECK(std::abs(static_cast<double>(seeks.front().step) - 1100 * 30) < 4 * 30);
    CHECK(std::abs(static_cast<double>(seeks.back().step) - 1500 * 30) < 4 * 30);
    CHECK(t.driver.requests.size() == seeks.size());
}

TEST_CASE("The rulers scrub as well, and beyond the ends it is the ends") {
    Track t;
    REQUIRE(t.driver.act([&](ImGuiTestContext* user) {
        user->MouseMoveToPos(t.at(user, 1200, ruler));
        user->MouseDown(0);
        ImVec2 left = t.at(user, 0, ruler), right = t.at(user, 2000, ruler);
        user->MouseMoveToPos({right.x + 30, right.y});
        user->MouseMoveToPos({left.x - 300, left.y});
        user->MouseUp(0);
    }));
    const auto seeks = t.seeks();
    REQUIRE(seeks.size() >= 3);
    CHECK(seeks[1].step == made_up_frames * 30);
    CHECK(seeks.back().step == 0);
}

TEST_CASE("Near a mark the very step of the mark is sought") {
    Track t;
    REQUIRE(t.driver.act([&](ImGuiTestContext* user) {
        ImVec2 near = t.at(user, 1830 / 30.0);
        near.x += 3;
        user->MouseMoveToPos(near);
        user->MouseClick(0);
    }));
    REQUIRE(t.seeks().size() == 1);
    CHECK(t.seeks()[0].step == 1830);
}

TEST_CASE("A click on an icon goes to its step, and on a flag with its camera") {
    Track t;
    REQUIRE(t.driver.act([&](ImGuiTestContext* user) {
        user->MouseMoveToPos(t.at(user, 10800 / 30.0, places));
        user->MouseClick(0);
        user->MouseMoveToPos(t.at(user, 13500 / 30.0, places));
        user->MouseClick(0);
    }));
    const auto gone = t.driver.asked<ui::GoToMoment>();
    REQUIRE(gone.size() == 2);
    CHECK(gone[0].moment == timeline::Moment{2, 10800});
    CHECK_FALSE(gone[0].camera);
    CHECK(gone[1].moment == timeline::Moment{2, 13500});
    CHECK(gone[1].camera);
    CHECK(t.seeks().empty());
}

TEST_CASE("The wheel zooms about the mouse, the right button moves the track, and a button shows all again") {
    Track t;
    ui::TimelineView& view = t.driver.lab.timeline_view;
    CHECK(view.first == 0);
    CHECK(view.last == made_up_frames);
    REQUIRE(t.driver.act([&](ImGuiTestContext* user) {
        user->MouseMoveToPos(t.at(user, 1000));
        user->MouseWheelY(5);
    }));
    const double first = view.first, span = view.last - view.first;
    CHECK(span < 800);
    CHECK(std::abs((1000 - first) / span - 0.5) < 0.02);
    REQUIRE(t.driver.act([&](ImGuiTestContext* user) {
        user->MouseMoveToPos(t.at(user, 1000));
        user->MouseDragWithDelta({-100, 0}, ImGuiMouseButton_Right);
    }));
    CHECK(view.first > first + 50);
    CHECK(std::abs(view.last - view.first - span) < 1e-6);
    CHECK(t.driver.requests.empty());
    REQUIRE(t.driver.act([&](ImGuiTestContext* user) {
        const double before = view.first;
        user->KeyDown(ImGuiMod_Shift);
        user->MouseWheelY(2);
        user->KeyUp(ImGuiMod_Shift);
        IM_CHECK(view.first < before);
        IM_CHECK(std::abs(view.last - view.first - span) < 1e-6);
        user->ItemClick("###Timeline/" ICON_FA_LEFT_RIGHT "##fit");
    }));
    CHECK(view.first == 0);
    CHECK(view.last == made_up_frames);
}

TEST_CASE("Zoomed in, every substep can be sought") {
    Track t;
    ui::TimelineView& view = t.driver.lab.timeline_view;
    view.fit = false;
    view.first = 700;
    view.last = 704;
    t.driver.settle();
    REQUIRE(t.driver.act([&](ImGuiTestContext* user) {
        user->MouseMoveToPos(t.at(user, 702 + 7.0 / 30));
        user->MouseClick(0);
    }));
    REQUIRE(t.seeks().size() == 1);
    CHECK(t.seeks()[0].step == 702 * 30 + 7);
}

TEST_CASE("Zoomed in, the track follows the playhead") {
    Track t;
    ui::TimelineView& view = t.driver.lab.timeline_view;
    view.fit = false;
    view.first = 650;
    view.last = 750;
    t.driver.settle();
    CHECK(view.first == 650);
    show_made_up_timeline(t.driver.lab, 1600);
    t.driver.settle();
    CHECK(view.first < 1600);
    CHECK(view.last > 1600);
    CHECK(std::abs(view.last - view.first - 100) < 1e-9);
}

TEST_CASE("The upper lane makes a loop, moves its ends, and moves all of it") {
    Track t;
    const auto drag = [&](double from, double to) {
        REQUIRE(t.driver.act([&](ImGuiTestContext* user) {
            user->MouseMoveToPos(t.at(user, from, loop));
            user->MouseDown(0);
            user->MouseMoveToPos(t.at(user, to, loop));
            user->MouseUp(0);
        }));
        const auto set = t.driver.asked<ui::SetLoop>();
        REQUIRE(set.size() == 1); // when it is let go
        CHECK(t.driver.requests.size() == 1);
        REQUIRE(set[0].range);
        t.driver.lab.timeline.loop = set[0].range;
        t.driver.settle();
    };
    const auto is = [&](double first, double last) {
        const timeline::FrameRange& range = *t.driver.lab.timeline.loop;
        return std::abs(static_cast<double>(range.first) - first) < 5 &&
               std::abs(static_cast<double>(range.last) - last) < 5;
    };
    drag(1000, 600);
    CHECK(is(600, 1000));
    drag(1000, 1200);
    CHECK(is(600, 1200));
    drag(600, 500);
    CHECK(is(500, 1200));
    drag(800, 900);
    CHECK(is(600, 1300));
    drag(900, 2000);
    CHECK(is(1300, 2000)); // as long as before, and not beyond the end
    drag(1998, 100);
    CHECK(t.driver.lab.timeline.loop->last == t.driver.lab.timeline.loop->first + 1);
}

TEST_CASE("A click in the upper lane changes nothing") {
    Track t;
    REQUIRE(t.driver.act([&](ImGuiTestContext* user) {
        user->MouseMoveToPos(t.at(user, 800, loop));
        user->MouseClick(0);
    }));
    CHECK(t.driver.requests.empty());
}

TEST_CASE("The curves scrub and zoom as the track does, at the same places") {
    Track t;
    constexpr const char* plot = "###Timeline/$$0/plot";
    ui::TimelineView& view = t.driver.lab.timeline_view;
    REQUIRE(t.driver.act([&](ImGuiTestContext* user) {
        IM_CHECK_EQ(user->ItemInfo(plot).RectFull.Min.x, user->ItemInfo(track).RectFull.Min.x);
        IM_CHECK_EQ(user->ItemInfo(plot).RectFull.Max.x, user->ItemInfo(track).RectFull.Max.x);
        user->MouseMoveToPos(t.at(user, 1100, 0.5f, plot));
        user->MouseDown(0);
        user->MouseMoveToPos(t.at(user, 1400, 0.5f, plot));
        user->MouseUp(0);
    }));
    REQUIRE(t.seeks().size() >= 2);
    CHECK(std::abs(static_cast<double>(t.seeks().back().step) - 1400 * 30) < 4 * 30);
    REQUIRE(t.driver.act([&](ImGuiTestContext* user) {
        user->MouseMoveToPos(t.at(user, 1400, 0.5f, plot));
        user->MouseWheelY(3);
        IM_CHECK(view.hovered && std::abs(*view.hovered - 1400) < 4);
    }));
    CHECK(view.last - view.first < 1200);
}

TEST_CASE("Curves are chosen from a list, and each is hidden by a click on its name") {
    Track t;
    ui::TimelineView& view = t.driver.lab.timeline_view;
    REQUIRE(t.driver.act([&](ImGuiTestContext* user) {
        user->ItemClick("###Timeline/" ICON_FA_CHART_LINE "##curves");
        user->ItemClick("//$FOCUSED/###Largest strain");
        user->ItemClick("//$FOCUSED/###Ghost");
        user->KeyPress(ImGuiKey_Escape);
        user->ItemClick("###Timeline/$$0/kinetic");
    }));
    CHECK(view.rows == std::array<bool, ui::curve_rows>{true, true, false, false, false});
    CHECK(view.hidden[0] == 2);
    CHECK(t.driver.requests.empty());
}

TEST_CASE("A curve is computed again when the timeline or the view is another, and only then") {
    Track t;
    const ui::TimelineView::Drawn& drawn = t.driver.lab.timeline_view.drawn[0];
    REQUIRE(drawn.curves.size() == 4);
    const double* before = drawn.curves[0].y.data();
    t.driver.settle();
    CHECK(drawn.curves[0].y.data() == before);
    auto other = made_up_overview();
    other->version = 2;
    other->samples.resize(50);
    t.driver.lab.timeline.overview = other;
    t.driver.settle();
    CHECK(drawn.curves[0].x.back() == 50);
}

TEST_CASE("A long run's curve follows within half a second, and at once when the view is another") {
    Track t;
    const ui::TimelineView::Drawn& drawn = t.driver.lab.timeline_view.drawn[0];
    const auto grow = [&](std::uint64_t frames) {
        auto o = made_up_overview();
        o->version = frames;
        o->end_frame = frames;
        o->end_step = frames * 30;
        o->reachable = {{0, frames}};
        const timeline::Sample last = o->samples.back();
        while (o->samples.back().frame < frames) {
            o->samples.push_back(last);
            o->samples.back().frame = o->samples[o->samples.size() - 2].frame + 1;
        }
        t.driver.lab.timeline.overview = o;
    };
    grow(40'000);
    t.driver.frame();
    CHECK(drawn.version == 40'000);
    grow(40'001);
    for (double end = ImGui::GetTime() + 0.5; ImGui::GetTime() < end;)
        t.driver.frame();
    CHECK(drawn.version == 40'001);
    grow(40'002);
    t.driver.lab.timeline_view.fit = false;
    t.driver.lab.timeline_view.first = 20'000;
    t.driver.lab.timeline_view.last = 40'002;
    t.driver.frame();
    CHECK(drawn.version == 40'002);
}

TEST_CASE("A timeline with nothing in it yet is drawn") {
    PanelDriver driver;
    driver.lab.timeline.overview = std::make_shared<timeline::Overview>();
    driver.settle();
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->MouseMove("###Timeline/track");
        user->MouseWheelY(3);
        user->MouseClick(0);
    }));
    for (const ui::SeekStep& seek : driver.asked<ui::SeekStep>())
        CHECK(seek.step == 0);
}

} // namespace clothlab::test
