// The panel that shows the inside of a step, driven as a user does.
#include <algorithm>
#include <set>

#include <catch2/catch_test_macros.hpp>

#include "gui/step_lab.h"
#include "ui/icons.h"
#include "ui/panels.h"

namespace clothlab::test {
namespace {

constexpr int integrate = static_cast<int>(sim::Stage::integrate), colliders = static_cast<int>(sim::Stage::colliders),
              limit = static_cast<int>(sim::Stage::limit);

void click(StepLab& s, const std::string& item) {
    REQUIRE(s.driver.act([&](ImGuiTestContext* user) { user->ItemClick(("###Inside a step/" + item).c_str()); }));
}
void press(StepLab& s, ImGuiKeyChord key) {
    REQUIRE(s.driver.act([&](ImGuiTestContext* user) { user->KeyPress(key); }));
}

} // namespace

TEST_CASE("The lab looks into steps as long as the panel is seen and the run is paused") {
    StepLab s;
    CHECK_FALSE(s.work().inspecting);
    s.look_into();
    CHECK(s.panel().drawn);
    CHECK(s.work().inspecting);
    s.lab().open[static_cast<std::size_t>(ui::PanelId::step)] = false;
    s.driver.settle();
    CHECK_FALSE(s.work().inspecting);
    CHECK(ui::shown_trace(s.lab()) == nullptr);
    s.look_into();
    CHECK(ui::shown_trace(s.lab()) == s.work().trace.get());

    s.show(sim::Stage::integrate);
    s.lab().ask(ui::Play{true});
    s.driver.frame();
    for (int i = 0; i < 500 && s.work().inspecting; ++i)
        s.driver.frame();
    CHECK_FALSE(s.work().inspecting);
    CHECK(s.work().stage == -1);
    click(s, ICON_FA_PAUSE "  Pause###pause");
    CHECK_FALSE(s.lab().playing);
    CHECK(s.work().inspecting);
}

TEST_CASE("A trace of another moment is not shown") {
    StepLab s;
    s.look_into();
    s.show(sim::Stage::integrate);
    CHECK(s.driver.app().draw_report().arrows > 0);
    const auto old = s.work().trace;
    s.go(0, 1);
    CHECK(ui::shown_trace(s.lab()) != nullptr);
    s.work().trace = old;
    CHECK(ui::shown_trace(s.lab()) == nullptr);
}

TEST_CASE("Buttons, rows and keys go through the stages, and the picture follows") {
    StepLab s;
    s.go(49);
    s.look_into();
    while (s.trace().moved[static_cast<std::size_t>(colliders)] == 0) {
        s.go(0, 1);
        s.trace_again();
    }
    REQUIRE(s.trace().active == std::array{true, true, true, true, true});
    const auto arrows = [&] { return s.driver.app().draw_report().arrows; };
    CHECK(arrows() == 0);
    click(s, "###stage1");
    CHECK(s.work().stage == integrate);
    CHECK(arrows() == s.trace().moved[static_cast<std::size_t>(integrate)]);
    std::vector<int> stages;
    REQUIRE(s.driver.act([&](ImGuiTestContext* user) {
        user->SetRef("###Inside a step");
        const auto note = [&] { stages.push_back(s.work().stage); };
        for (int n = 0; n < 2; ++n) {
            user->ItemClick(ICON_FA_CHEVRON_LEFT "##previous stage");
            note();
        }
        for (int n = 0; n < 6; ++n) {
            user->KeyPress(ImGuiMod_Ctrl | ImGuiKey_RightArrow);
            note();
        }
        user->ItemClick(ICON_FA_CHEVRON_LEFT "##previous stage");
        user->ItemClick(ICON_FA_CHEVRON_RIGHT "##next stage");
        note();
        user->ItemClick("###stage-1");
        note();
        user->ItemClick("**/###row4");
        note();
        user->KeyPress(ImGuiMod_Ctrl | ImGuiKey_LeftArrow);
        note();
    }));
    CHECK(stages == std::vector{0, -1, 0, 1, 2, 3, 4, 4, 4, -1, 4, colliders});
    CHECK(arrows() == s.trace().moved[static_cast<std::size_t>(colliders)]);
    CHECK(arrows() > 0);
    CHECK(arrows() < StepLab::points);
}

TEST_CASE("Stages that the scene does not have cannot be gone to") {
    StepLab s;
    s.lab().scene.simulation.colliders.clear();
    s.driver.settle();
    s.look_into();
    REQUIRE_FALSE(s.trace().active[static_cast<std::size_t>(colliders)]);
    s.show(sim::Stage::self_collision);
    press(s, ImGuiMod_Ctrl | ImGuiKey_RightArrow);
    CHECK(s.work().stage == limit);
    s.show(sim::Stage::colliders); // as it may have been in the scene before
    CHECK(s.work().stage == static_cast<int>(sim::Stage::self_collision));
}

TEST_CASE("Taking the step takes it, and ends where its last stage was") {
    StepLab s;
    s.go(3, 4);
    s.look_into();
    const sim::StepTrace trace = s.trace();
    s.show(sim::Stage::limit);
    click(s, "###take");
    CHECK(s.lab().snapshot->steps == trace.step + 1);
    CHECK(s.lab().snapshot->positions == trace.after.back());
    CHECK(s.work().stage == -1);
}

TEST_CASE("A point is picked in the viewport, in the panel, and unpicked") {
    StepLab s;
    s.look_into({10, 330}, {720, 300});
    s.show(sim::Stage::integrate);
    const ui::PanelReport& viewport = s.lab().report[static_cast<std::size_t>(ui::PanelId::viewport)];
    // The cloth is far above the panel: somewhere there is one of its points.
    const render::PixelBox box = s.driver.app().draw_report().cloth_box;
    const float top = viewport.y + viewport.height - static_cast<float>(s.lab().viewport_height);
    const ImVec2 middle{viewport.x + static_cast<float>(box.min_x + box.max_x) / 2,
                        top + static_cast<float>(box.min_y + box.max_y) / 2};
    const scene::Camera camera = ui::heading(s.lab());
    REQUIRE(s.driver.act([&](ImGuiTestContext* user) {
        user->MouseMoveToPos(middle);
        user->KeyDown(ImGuiMod_Shift);
        user->MouseClick();
        user->KeyUp(ImGuiMod_Shift);
    }));
    REQUIRE(s.work().picked);
    CHECK(ui::heading(s.lab()) == camera);
    CHECK(s.work().picked == ui::pick_point(camera, static_cast<float>(s.lab().viewport_width),
                                            static_cast<float>(s.lab().viewport_height), s.trace().after[1],
                                            middle.x - viewport.x, middle.y - top));
    CHECK(s.driver.app().draw_report().arrows == 1);
    REQUIRE(s.driver.act([&](ImGuiTestContext* user) { // a drag moves the camera and picks nothing
        user->ItemClick("###Inside a step/All points");
        user->MouseMoveToPos(middle);
        user->KeyDown(ImGuiMod_Shift);
        user->MouseDragWithDelta({40, 10});
        user->KeyUp(ImGuiMod_Shift);
    }));
    CHECK_FALSE(s.work().picked);
    CHECK(s.driver.app().draw_report().arrows == StepLab::points);
    CHECK(ui::heading(s.lab()) != camera);

    REQUIRE(s.driver.act([](ImGuiTestContext* user) {
        user->ItemInputValue("###Inside a step/column", 7);
        user->ItemInputValue("###Inside a step/row", 900);
    }));
    CHECK(s.work().picked == 11u * small_side + 7);
    click(s, "Furthest");
    CHECK(s.work().picked == s.trace().furthest[integrate]);
    s.work().picked = StepLab::points - 1;
    s.lab().scene.simulation.cloth.num_width_points = 5;
    s.lab().scene.simulation.cloth.num_height_points = 5;
    s.driver.settle();
    s.trace_again();
    CHECK_FALSE(s.work().picked); // there is no such point any more
}

TEST_CASE("Arrows fit until their slider is moved, and the picture is drawn anew") {
    StepLab s;
    s.go(20);
    s.look_into();
    s.show(sim::Stage::integrate);
    const float of_motion = s.work().arrow_scale;
    CHECK(of_motion > 1);
    s.show(sim::Stage::forces);
    CHECK(s.work().arrow_scale != of_motion);
    CHECK(s.work().fit_arrows);
    REQUIRE(s.driver.act([](ImGuiTestContext* user) { user->ItemInputValue("###Inside a step/##arrow scale", 25.f); }));
    CHECK_FALSE(s.work().fit_arrows);
    CHECK(s.work().arrow_scale == 25);
    const render::Image small = s.driver.app().picture();
    s.work().arrow_scale = 250;
    s.driver.settle();
    CHECK(s.driver.app().picture().rgba != small.rgba);
    s.show(sim::Stage::integrate);
    CHECK(s.work().arrow_scale == 250);
    click(s, "Fit");
    CHECK(s.work().arrow_scale == of_motion);
}

TEST_CASE("The colours of the stages differ, and the keys of the panel are among the keys of the help") {
    std::set<std::array<float, 3>> colours(ui::stage_colours.begin(), ui::stage_colours.end());
    CHECK(colours.size() == ui::stage_colours.size());
    const auto& list = ui::shortcuts();
    for (const std::string keys : {"Ctrl+Left, Ctrl+Right", "Shift+click"})
        CHECK(std::any_of(list.begin(), list.end(), [&](const ui::Shortcut& s) { return s.keys == keys; }));
}

} // namespace clothlab::test
