// The timeline's panels in windows of several sizes: no control is cut off at the sides or covers another.
#include <imgui.h>
#include <imgui_internal.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>

#include "made_up_timeline.h"
#include "panel_driver.h"

namespace clothlab::test {
namespace {

struct Size {
    int width, height;
    float scale;
};

struct Control {
    std::string name;
    ImRect rect;
};

/// What can be clicked in a window, with how it lies on the screen; and the window's own room.
std::vector<Control> controls(PanelDriver& driver, const char* window, ImRect& room) {
    std::vector<Control> found;
    REQUIRE(driver.act([&](ImGuiTestContext* user) {
        user->WindowFocus(window);
        user->Yield(3);
        ImGuiTestItemList items;
        user->GatherItems(&items, window, 99);
        for (const ImGuiTestItemInfo& item : items)
            found.push_back({item.DebugLabel, item.RectFull});
        room = user->GetWindowByRef(window)->InnerRect;
    }));
    return found;
}

} // namespace

TEST_CASE("Nothing in the timeline's panels is cut off at the sides or covers anything else") {
    const Size size = GENERATE(Size{1440, 900, 1}, Size{1280, 800, 1}, Size{1024, 768, 1}, Size{800, 600, 1},
                               Size{1440, 900, 1.5f}, Size{2160, 1350, 1.5f});
    PanelDriver driver(size.width, size.height, size.scale);
    show_made_up_timeline(driver.lab);
    driver.settle();
    INFO(size.width << " x " << size.height << " at " << size.scale);
    for (const char* window : {"###Timeline", "###Branches", "###Moments"}) {
        INFO(window);
        ImRect room;
        const std::vector<Control> all = controls(driver, window, room);
        CHECK(all.size() >= 9);
        for (std::size_t i = 0; i < all.size(); ++i) {
            INFO(all[i].name);
            CHECK(all[i].rect.Min.x >= room.Min.x);
            CHECK(all[i].rect.Max.x <= room.Max.x);
            for (std::size_t j = 0; j < i; ++j) {
                INFO(all[j].name);
                ImRect common = all[i].rect;
                common.ClipWith(all[j].rect);
                // A plot and what takes its mouse are at the same place.
                const bool same = all[i].rect.Contains(all[j].rect) && all[j].rect.Contains(all[i].rect);
                CHECK((same || common.GetWidth() <= 0 || common.GetHeight() <= 0));
            }
        }
    }
}

TEST_CASE("At 840 pixels the whole transport is one line") {
    PanelDriver driver(840 + 300 + 362 + 6, 900); // with the columns at the sides
    show_made_up_timeline(driver.lab);
    driver.settle();
    CHECK(driver.report(ui::PanelId::timeline).width <= 842);
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        const float first = user->ItemInfo("###Timeline/###start").RectFull.Min.y;
        for (const char* button : {"###end", "###loop", "###restart", "##speed", "###cache"})
            IM_CHECK_EQ(user->ItemInfo((std::string("###Timeline/") + button).c_str()).RectFull.Min.y, first);
    }));
}

} // namespace clothlab::test
