// The timeline's buttons and keys: each asks the app for one thing.
#include <imgui.h>

#include <catch2/catch_test_macros.hpp>
#include <string>

#include "made_up_timeline.h"
#include "panel_driver.h"
#include "ui/panels.h"

namespace clothlab::test {
namespace {

/// A request as a short text.
struct Told {
    std::string operator()(const ui::Play& r) const { return r.on ? "play" : "pause"; }
    std::string operator()(const ui::StepFrame&) const { return "frame"; }
    std::string operator()(const ui::StepSubstep&) const { return "substep"; }
    std::string operator()(const ui::Restart&) const { return "restart"; }
    std::string operator()(const ui::SetSpeed& r) const { return "speed " + std::to_string(r.speed); }
    std::string operator()(const ui::TimelineRequest& r) const { return std::visit(*this, r); }
    std::string operator()(const ui::PlayBackwards&) const { return "backwards"; }
    std::string operator()(const ui::StepBack& r) const { return r.frame ? "frame back" : "substep back"; }
    std::string operator()(const ui::JumpToStart&) const { return "start"; }
    std::string operator()(const ui::JumpToEnd&) const { return "end"; }
    std::string operator()(const ui::AddBookmark& r) const { return "bookmark" + r.name; }
    std::string operator()(const ui::SetLoop& r) const {
        return r.range ? "loop " + std::to_string(r.range->first) + " " + std::to_string(r.range->last) : "no loop";
    }
    std::string operator()(const ui::GoToMoment& r) const {
        return "go " + std::to_string(r.moment.branch) + " " + std::to_string(r.moment.step) +
               (r.camera ? " camera" : "");
    }
    template <class Other>
    std::string operator()(const Other&) const {
        return "something else";
    }
};

std::string told(const PanelDriver& driver) {
    std::string all;
    for (const ui::Request& r : driver.requests)
        all += (all.empty() ? "" : ", ") + std::visit(Told{}, r);
    return all;
}

std::string press(PanelDriver& driver, ImGuiKeyChord key) {
    REQUIRE(driver.act([&](ImGuiTestContext* user) { user->KeyPress(key); }));
    return told(driver);
}

std::string click(PanelDriver& driver, const std::string& button) {
    REQUIRE(driver.act([&](ImGuiTestContext* user) { user->ItemClick(("###Timeline/###" + button).c_str()); }));
    return told(driver);
}

} // namespace

TEST_CASE("Every button of the transport asks for what its tooltip says") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    driver.lab.timeline.loop.reset();
    driver.settle();
    CHECK(click(driver, "start") == "start");
    CHECK(click(driver, "frame back") == "frame back");
    CHECK(click(driver, "substep back") == "substep back");
    CHECK(click(driver, "backwards") == "backwards");
    CHECK(click(driver, "play") == "play");
    CHECK(click(driver, "substep") == "substep");
    CHECK(click(driver, "frame") == "frame");
    CHECK(click(driver, "end") == "end");
    CHECK(click(driver, "loop") == "loop 0 2000");
    CHECK(click(driver, "restart") == "restart");
}

TEST_CASE("The play buttons pause what they started and turn what plays the other way") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    driver.lab.playing = true;
    CHECK(click(driver, "play") == "pause");
    CHECK(click(driver, "backwards") == "backwards");
    driver.lab.timeline.backwards = true;
    CHECK(click(driver, "play") == "play");
    CHECK(click(driver, "backwards") == "pause");
}

TEST_CASE("Every key of the timeline asks for what the list of keys says") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    driver.settle();
    constexpr auto shift = ImGuiMod_Shift;
    CHECK(press(driver, ImGuiKey_Space) == "play");
    CHECK(press(driver, ImGuiKey_P) == "play");
    CHECK(press(driver, ImGuiKey_B) == "backwards");
    CHECK(press(driver, ImGuiKey_N) == "frame");
    CHECK(press(driver, ImGuiKey_RightArrow) == "frame");
    CHECK(press(driver, shift | ImGuiKey_N) == "substep");
    CHECK(press(driver, shift | ImGuiKey_RightArrow) == "substep");
    CHECK(press(driver, ImGuiKey_LeftArrow) == "frame back");
    CHECK(press(driver, shift | ImGuiKey_LeftArrow) == "substep back");
    CHECK(press(driver, ImGuiKey_Home) == "start");
    CHECK(press(driver, ImGuiKey_End) == "end");
    CHECK(press(driver, ImGuiKey_L) == "loop 0 2000");
    CHECK(press(driver, ImGuiKey_LeftBracket) == "loop 700 2000");
    CHECK(press(driver, ImGuiKey_RightBracket) == "loop 0 700");
    CHECK(press(driver, ImGuiKey_Minus) == "speed " + std::to_string(0.5));
    CHECK(press(driver, ImGuiKey_Equal) == "speed " + std::to_string(2.0));
    CHECK(press(driver, ImGuiKey_M) == "bookmark");
    CHECK(press(driver, ImGuiKey_R) == "restart");
}

TEST_CASE("Comma and full stop go to the previous and the next event or bookmark of the line shown") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab); // at step 21000: events at 1830 ... 15012, a bookmark at 13500
    driver.settle();
    CHECK(press(driver, ImGuiKey_Comma) == "go 2 15012");
    CHECK(press(driver, ImGuiKey_Period).empty()); // what comes later is another branch's
    driver.lab.timeline.playhead.moment.step = 15012;
    CHECK(press(driver, ImGuiKey_Comma) == "go 2 13500 camera");
    driver.lab.timeline.playhead.moment.step = 1829;
    CHECK(press(driver, ImGuiKey_Period) == "go 2 1830");
    CHECK(press(driver, ImGuiKey_Comma).empty());
}

TEST_CASE("L switches the loop off and the same loop on again") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    driver.lab.timeline.loop = timeline::FrameRange{40, 90};
    driver.settle();
    CHECK(press(driver, ImGuiKey_L) == "no loop");
    driver.lab.timeline.loop.reset();
    CHECK(press(driver, ImGuiKey_L) == "loop 40 90");
}

TEST_CASE("The ends of the loop never cross") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab); // at frame 700
    driver.lab.timeline.loop = timeline::FrameRange{800, 900};
    driver.settle();
    CHECK(press(driver, ImGuiKey_LeftBracket) == "loop 700 900");
    CHECK(press(driver, ImGuiKey_RightBracket) == "loop 0 700");
    driver.lab.timeline.loop = timeline::FrameRange{200, 400};
    CHECK(press(driver, ImGuiKey_LeftBracket) == "loop 700 2000");
}

TEST_CASE("Speeds end at 1/64 and 16") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    driver.lab.speed = 16;
    CHECK(press(driver, ImGuiKey_Equal).empty());
    driver.lab.speed = 1.0 / 64;
    CHECK(press(driver, ImGuiKey_Minus).empty());
    CHECK(press(driver, ImGuiKey_Equal) == "speed " + std::to_string(1.0 / 32));
}

TEST_CASE("Keys that are typed into a text field reach nothing else") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->WindowFocus("###Moments");
        user->Yield(2);
        user->ItemClick("###Moments/bookmarks/##name");
        for (const ImGuiKey key :
             {ImGuiKey_Space, ImGuiKey_P, ImGuiKey_B, ImGuiKey_N, ImGuiKey_LeftArrow, ImGuiKey_RightArrow,
              ImGuiKey_Home, ImGuiKey_End, ImGuiKey_L, ImGuiKey_LeftBracket, ImGuiKey_RightBracket, ImGuiKey_Minus,
              ImGuiKey_Equal, ImGuiKey_M, ImGuiKey_Comma, ImGuiKey_Period, ImGuiKey_R})
            user->KeyPress(key);
        user->KeyPress(ImGuiMod_Shift | ImGuiKey_LeftArrow);
        user->KeyPress(ImGuiMod_Shift | ImGuiKey_RightArrow);
    }));
    CHECK(told(driver).empty());
}

TEST_CASE("Arrow keys step also after a click on a button or a slider, and change nothing there") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    click(driver, "start");
    CHECK(press(driver, ImGuiKey_RightArrow) == "frame");
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->ItemClick("###Parameters/**/cloth.damping/##value"); }));
    const scene::Scene clicked = driver.lab.scene;
    CHECK(press(driver, ImGuiKey_LeftArrow) == "frame back");
    CHECK(press(driver, ImGuiKey_Home) == "start");
    CHECK(driver.lab.scene == clicked);
}

TEST_CASE("A slider whose value is being typed keeps the arrow keys") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->ItemInput("###Parameters/**/cloth.damping/##value");
        user->KeyPress(ImGuiKey_LeftArrow, 2);
        user->KeyPress(ImGuiKey_Home);
        user->KeyPress(ImGuiKey_Minus);
    }));
    CHECK(told(driver).empty());
}

TEST_CASE("A speed is chosen from the list") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->ItemClick("###Timeline/##speed");
        user->ItemClick("//$FOCUSED/1\\/64 speed");
    }));
    CHECK(told(driver) == "speed " + std::to_string(1.0 / 64));
}

TEST_CASE("The cache's memory is changed where it is shown") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->ItemClick("###Timeline/###cache");
        user->ItemInputValue("//$FOCUSED/MB in memory", 64);
        user->ItemClick("//$FOCUSED/###Set");
    }));
    const auto asked = driver.asked<ui::SetCacheBudget>();
    REQUIRE(asked.size() == 1);
    CHECK(asked[0].bytes == std::size_t{64} << 20);
    CHECK(asked[0].least_reach_s == 0);
    CHECK(asked[0].disk == std::size_t{1} << 30);
}

TEST_CASE("What may lie on disk is set beside the memory, and what is wrong with the disk is said there") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->ItemClick("###Timeline/###cache");
        user->ItemInputValue("//$FOCUSED/MB on disk", 2048);
        user->ItemClick("//$FOCUSED/###Set");
    }));
    CHECK(driver.asked<ui::SetCacheBudget>().at(0).disk == std::size_t{2} << 30);

    auto o = std::make_shared<timeline::Overview>(*driver.lab.timeline.overview);
    o->disk = std::size_t{2} << 30;
    o->disk_trouble = "/var/tmp: No space left on device";
    driver.lab.timeline.overview = o;
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->ItemClick("###Timeline/###cache");
        user->ItemClick("//$FOCUSED/###Set"); // another try with the same
    }));
    const auto asked = driver.asked<ui::SetCacheBudget>();
    REQUIRE(asked.size() == 1);
    CHECK(asked[0].disk == std::size_t{2} << 30);
}

TEST_CASE("How many seconds are kept though they are slow to go to is set beside the memory") {
    PanelDriver driver;
    show_made_up_timeline(driver.lab);
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->ItemClick("###Timeline/###cache");
        user->ItemInputValue("//$FOCUSED/s at least, even if slow to go to", 60);
        user->ItemClick("//$FOCUSED/###Set");
    }));
    const auto asked = driver.asked<ui::SetCacheBudget>();
    REQUIRE(asked.size() == 1);
    CHECK(asked[0].bytes == std::size_t{512} << 20);
    CHECK(asked[0].least_reach_s == 60);
}

TEST_CASE("Without a timeline the transport is there all the same") {
    PanelDriver driver;
    CHECK(click(driver, "play") == "play");
    CHECK(press(driver, ImGuiKey_L).empty());
    CHECK(press(driver, ImGuiKey_Comma).empty());
    CHECK(press(driver, ImGuiKey_LeftBracket).empty());
}

} // namespace clothlab::test
