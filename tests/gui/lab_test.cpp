// What a lecturer does in the window, done by the test engine.
#include <imgui.h>
#include <imgui_test_engine/imgui_te_internal.h>

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <fstream>

#include "lab_driver.h"
#include "scene/fields.h"
#include "support/files.h"
#include "ui/icons.h"

namespace clothlab::test {
namespace {

namespace fs = std::filesystem;

/// The key presses and clicks that follow go to nothing in particular.
void leave_widgets(ImGuiTestContext* user) {
    user->MouseMoveToPos({700, 300});
}

fs::path temporary(const char* name) {
    static const TemporaryFolder folder;
    return folder / name;
}

const scene::Field& field(const char* key) {
    return *scene::find_field(key);
}

} // namespace

TEST_CASE("Every panel that is open at the start is there when the lab opens, and the status bar") {
    LabDriver driver;
    for (std::size_t i = 0; i < ui::panel_count; ++i) {
        const ui::PanelReport& panel = driver.lab().report[i];
        INFO(panel.name);
        if (!ui::open_at_start[i]) {
            CHECK_FALSE(panel.drawn);
            continue;
        }
        CHECK((panel.drawn || panel.behind)); // another tab is in front
        if (panel.behind)
            continue;
        CHECK(panel.width > 100);
        CHECK(panel.height > 50);
    }
    CHECK(driver.lab().status_bar_drawn);
    CHECK(driver.lab().messages.empty());
}

TEST_CASE("Space and P play and pause") {
    LabDriver driver;
    REQUIRE_FALSE(driver.lab().playing);
    for (const ImGuiKey key : {ImGuiKey_Space, ImGuiKey_P}) {
        REQUIRE(driver.act([&](ImGuiTestContext* user) { user->KeyPress(key); }));
        // Playing never finishes: frames until the thread says so.
        for (int i = 0; i < 1000 && !driver.lab().playing; ++i)
            driver.frame();
        CHECK(driver.lab().playing);
        const std::uint64_t steps = driver.lab().snapshot->steps;
        for (int i = 0; i < 10000 && driver.lab().snapshot->steps == steps; ++i)
            driver.frame();
        CHECK(driver.lab().snapshot->steps > steps);
        driver.app().simulation().play(false);
        driver.settle();
        CHECK_FALSE(driver.lab().playing);
    }
}

TEST_CASE("N goes one frame further, Shift+N one substep, R back to the start") {
    LabDriver driver;
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->KeyPress(ImGuiKey_N); }));
    CHECK(driver.lab().snapshot->frame == 1);
    CHECK(driver.lab().snapshot->substep == 0);
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->KeyPress(ImGuiMod_Shift | ImGuiKey_N, 3); }));
    CHECK(driver.lab().snapshot->frame == 1);
    CHECK(driver.lab().snapshot->substep == 3);
    CHECK(driver.lab().snapshot->steps == 33);
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->KeyPress(ImGuiKey_R); }));
    CHECK(driver.lab().snapshot->steps == 0);
}

TEST_CASE("The transport's buttons do the same") {
    LabDriver driver;
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->SetRef("###Timeline");
        user->ItemClick("###frame");
        user->ItemClick("###substep");
    }));
    CHECK(driver.lab().snapshot->steps == 31);
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->ItemClick("###Timeline/###restart"); }));
    CHECK(driver.lab().snapshot->steps == 0);
}

TEST_CASE("Space plays also after a click on a button, and does not click it again") {
    LabDriver driver;
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->ItemClick("###Timeline/###frame"); }));
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->KeyPress(ImGuiKey_Space);
        user->Yield(2);
        user->KeyPress(ImGuiKey_Space);
    }));
    for (int i = 0; i < 1000 && driver.lab().playing; ++i)
        driver.frame();
    CHECK_FALSE(driver.lab().playing);
    CHECK(driver.lab().snapshot->steps > 30); // played, and not to the end of one frame as the button would
}

TEST_CASE("A value typed into a slider reaches the running simulation, and reset brings the scene's back") {
    LabDriver driver;
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->KeyPress(ImGuiKey_N);
        user->ItemInputValue("###Parameters/**/cloth.ks/##value", "1234.5");
    }));
    CHECK(driver.lab().scene.simulation.cloth.ks == 1234.5);
    CHECK(driver.lab().snapshot->steps == 30); // live: no restart
    CHECK(ui::modified(driver.lab()));
    REQUIRE(driver.act(
        [](ImGuiTestContext* user) { user->ItemClick("###Parameters/**/cloth.ks/" ICON_FA_ROTATE_LEFT "##reset"); }));
    CHECK(driver.lab().scene.simulation.cloth.ks == 5000);
    CHECK_FALSE(ui::modified(driver.lab()));
}

TEST_CASE("A density is typed in g/cm² and kept in kg/m², negative ones too, zero is refused with a sentence") {
    LabDriver driver;
    const char* density = "###Parameters/**/cloth.density/##value";
    REQUIRE(driver.act([&](ImGuiTestContext* user) { user->ItemInputValue(density, "7"); }));
    CHECK(driver.lab().scene.simulation.cloth.density == 70);
    REQUIRE(driver.act([&](ImGuiTestContext* user) { user->ItemInputValue(density, "-15"); }));
    CHECK(driver.lab().scene.simulation.cloth.density == -150);
    CHECK(driver.lab().messages.empty());
    REQUIRE(driver.act([&](ImGuiTestContext* user) { user->ItemInputValue(density, "0"); }));
    CHECK(driver.lab().scene.simulation.cloth.density == -150);
    REQUIRE(driver.lab().messages.size() == 1);
    CHECK(driver.lab().messages.front().text.find("other than 0") != std::string::npos);
}

TEST_CASE("Every switch of the parameter panel changes its parameter and nothing else") {
    LabDriver driver;
    for (const char* key : {"cloth.enable_structural", "cloth.enable_shearing", "cloth.enable_bending"}) {
        INFO(key);
        const scene::Scene before = driver.lab().scene;
        REQUIRE(driver.act([&](ImGuiTestContext* user) {
            user->ItemClick((std::string("###Parameters/**/") + key + "/##value").c_str());
        }));
        CHECK(field(key).get(driver.lab().scene) != field(key).get(before));
        scene::Scene rest = driver.lab().scene;
        field(key).set(rest, field(key).get(before));
        CHECK(rest == before);
    }
}

TEST_CASE("Undo and redo go through the edits, and the camera is no edit") {
    LabDriver driver;
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->ItemInputValue("###Parameters/**/cloth.ks/##value", "100");
        user->ItemInputValue("###Parameters/**/cloth.damping/##value", "1");
        user->MouseMoveToPos({600, 300});
        user->MouseDragWithDelta({50, 20});
        leave_widgets(user);
        user->KeyPress(ImGuiMod_Ctrl | ImGuiKey_Z);
    }));
    CHECK(driver.lab().scene.simulation.cloth.damping == 0.2);
    CHECK(driver.lab().scene.simulation.cloth.ks == 100);
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->KeyPress(ImGuiMod_Ctrl | ImGuiKey_Z); }));
    CHECK(driver.lab().scene.simulation.cloth.ks == 5000);
    CHECK(driver.lab().scene.camera != driver.lab().loaded.camera);
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->KeyPress(ImGuiMod_Ctrl | ImGuiMod_Shift | ImGuiKey_Z, 2); }));
    CHECK(driver.lab().scene.simulation.cloth.damping == 1);
    CHECK(driver.lab().scene.simulation.cloth.ks == 100);
}

TEST_CASE("Dragging in the viewport turns, pans and zooms the camera, dragging in a panel does not") {
    LabDriver driver;
    const scene::Camera start = *driver.lab().scene.camera;
    const auto camera = [&] { return *driver.lab().scene.camera; };
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->MouseMoveToPos({600, 300});
        user->MouseDragWithDelta({80, 30});
    }));
    CHECK(camera().yaw != start.yaw);
    CHECK(camera().pitch > start.pitch);
    CHECK(camera().target == start.target);

    const scene::Camera turned = camera();
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->MouseMoveToPos({600, 300});
        user->MouseDragWithDelta({80, 30}, ImGuiMouseButton_Right);
    }));
    CHECK(camera().target != turned.target);
    CHECK(camera().yaw == turned.yaw);

    const scene::Camera panned = camera();
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->MouseMoveToPos({600, 300});
        user->MouseWheelY(2);
    }));
    CHECK(camera().distance < panned.distance);

    const scene::Camera zoomed = camera();
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->MouseMove("###Parameters/**/cloth.ks/##value");
        user->MouseDragWithDelta({20, 200});
        user->MouseWheelY(-3);
    }));
    CHECK(camera() == zoomed);
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        leave_widgets(user);
        user->KeyPress(ImGuiKey_9);
        user->KeyPress(ImGuiKey_F);
    }));
    CHECK(camera() == scene::fitting_camera(driver.lab().scene.simulation));
}

TEST_CASE("A pen that is put down elsewhere than it was does not turn the camera, and then drags it") {
    LabDriver driver;
    const auto camera = [&] { return *driver.lab().scene.camera; };
    const scene::Camera start = camera();
    scene::Camera pressed;
    REQUIRE(driver.act([&](ImGuiTestContext* user) {
        user->MouseMoveToPos({500, 200});
        user->Inputs->MousePosValue = {700, 400}; // there and down within one frame
        user->MouseDown(ImGuiMouseButton_Left);
        pressed = camera();
        user->MouseMoveToPos({710, 400});
        user->MouseUp(ImGuiMouseButton_Left);
    }));
    CHECK(pressed == start);
    CHECK(camera().yaw == std::remainder(start.yaw - 3.5, 360.0));
    CHECK(camera().pitch == start.pitch);
}

TEST_CASE("A scene is opened from the list") {
    LabDriver driver("sphere-medium", 1280, 1000); // high enough for all of the list
    REQUIRE(driver.act([&](ImGuiTestContext* user) { user->ItemClick("###Scenes/**/Two pins"); }));
    CHECK(driver.lab().file == app::scene_path("two-pins"));
    CHECK(driver.lab().scene.simulation.cloth.pinned.size() == 2);
    CHECK(driver.app().draw_report().pins == 2);
}

TEST_CASE("A bad scene leaves the open one open, and the lab says why") {
    LabDriver driver;
    const fs::path bad = temporary("bad.json");
    std::ofstream(bad) << "{\n  \"cloth\": {\n    \"kss\": 5000\n  }\n}\n";
    const scene::Scene before = driver.lab().scene;
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->KeyPress(ImGuiKey_N);
        user->KeyPress(ImGuiMod_Ctrl | ImGuiKey_O);
        user->Yield(3);
        user->SetRef("//$FOCUSED");
        user->ItemInputValue("##path", (temporary("bad.json").string()).c_str());
    }));
    CHECK(driver.lab().scene == before);
    CHECK(driver.lab().snapshot->steps == 30);
    REQUIRE(driver.lab().messages.size() == 1);
    CHECK(driver.lab().messages.front().error);
    CHECK(driver.lab().messages.front().text.find("bad.json:3: cloth.kss: unknown key; did you mean \"ks\"?") !=
          std::string::npos);
    // The message goes when it is dismissed.
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->ItemClick("###Viewport/**/" ICON_FA_XMARK); }));
    CHECK(driver.lab().messages.empty());
}

TEST_CASE("A changed scene is saved under a new name and opens again as it was") {
    LabDriver driver;
    const fs::path file = temporary("saved.json");
    REQUIRE(driver.act([&](ImGuiTestContext* user) {
        user->ItemInputValue("###Parameters/**/cloth.ks/##value", "777");
        leave_widgets(user);
        user->KeyPress(ImGuiMod_Ctrl | ImGuiKey_S); // a shipped scene: asks for a name
        user->Yield(3);
        user->SetRef("//$FOCUSED");
        user->ItemInputValue("##path", file.string().c_str());
    }));
    REQUIRE(fs::exists(file));
    CHECK(driver.lab().file == file);
    CHECK_FALSE(ui::modified(driver.lab()));
    CHECK(scene::load_scene(file) == driver.lab().scene);
    CHECK(driver.lab().scene.simulation.cloth.ks == 777);
}

TEST_CASE("Saving over another file takes a click on Replace: Enter alone does not") {
    LabDriver driver;
    const fs::path other = temporary("other.json");
    std::ofstream(other) << "precious";
    std::string after_enter;
    REQUIRE(driver.act([&](ImGuiTestContext* user) {
        leave_widgets(user);
        user->KeyPress(ImGuiMod_Ctrl | ImGuiMod_Shift | ImGuiKey_S);
        user->Yield(3);
        user->SetRef("//$FOCUSED");
        user->ItemInputValue("##path", other.string().c_str());
        user->Yield(3);
        after_enter = scene::read_text_file(other);
        user->ItemClick("###done");
    }));
    CHECK(after_enter == "precious");
    CHECK(scene::load_scene(other) == driver.lab().scene);
}

TEST_CASE("Fewer points along the width restart the run with the pins where they belong") {
    LabDriver driver("four-pins");
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->KeyPress(ImGuiKey_N);
        user->ItemClick("###Parameters/Grid and precision");
        user->ItemInputValue("###Parameters/**/cloth.num_width_points/##value", "20");
    }));
    CHECK(driver.lab().scene.simulation.cloth.num_width_points == 20);
    CHECK(driver.lab().snapshot->columns == 20);
    CHECK(driver.lab().snapshot->steps == 0);
    CHECK(driver.lab().scene.simulation.cloth.pinned ==
          std::vector<sim::GridPoint>{{0, 0}, {0, 49}, {19, 0}, {19, 49}});
    CHECK(driver.lab().messages.empty());
}

TEST_CASE("A blow-up pauses the run and is explained") {
    LabDriver driver;
    driver.lab().scene.simulation.cloth.ks = 1e9;
    driver.lab().scene.simulation.rules.limit = sim::LimitRule::off;
    driver.settle();
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->KeyPress(ImGuiKey_N, 30); }));
    CHECK(driver.lab().snapshot->diagnostics.status == sim::Status::diverged);
    REQUIRE_FALSE(driver.lab().messages.empty());
    CHECK(driver.lab().messages.front().text.find("too stiff") != std::string::npos);
    CHECK(driver.app().draw_report().width > 0); // still drawn
}

TEST_CASE("The wireframe draws every enabled spring kind, and the look panel switches each") {
    LabDriver driver;
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->KeyPress(ImGuiKey_W); }));
    const auto all = driver.app().draw_report();
    const std::size_t n = 50;
    CHECK(all.springs == std::array{2 * n * (n - 1), 2 * (n - 1) * (n - 1), 2 * n * (n - 2)});
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->ItemClick("###Look/Shear"); }));
    CHECK(driver.app().draw_report().springs == std::array{all.springs[0], std::size_t{0}, all.springs[2]});
}

TEST_CASE("A window of one pixel is drawn, and the lab comes back from it") {
    LabDriver driver("sphere-medium", 1, 1);
    driver.settle();
    CHECK(driver.app().picture().width == 1);
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->KeyPress(ImGuiKey_N); }));
    CHECK(driver.lab().snapshot->frame == 1);
}

TEST_CASE("At twice the scale everything is twice as large, the default layout too") {
    const auto reports = [](float scale) {
        app::LabOptions options;
        options.window = app::Window::Kind::offscreen;
        options.width = static_cast<int>(1280 * scale);
        options.height = static_cast<int>(800 * scale);
        options.keep_layout = false;
        options.scale = scale;
        const auto file = app::scene_path("two-pins");
        app::LabApp app(options, scene::load_scene(file), file);
        app.show_frame(1);
        CHECK(ImGui::GetStyle().FontScaleDpi == scale);
        return app.lab().report;
    };
    const auto once = reports(1), twice = reports(2);
    for (std::size_t i = 0; i < ui::panel_count; ++i) {
        INFO(once[i].name);
        CHECK((twice[i].drawn || twice[i].behind) == ui::open_at_start[i]);
        CHECK(std::abs(twice[i].width - 2 * once[i].width) < 8);
        CHECK(std::abs(twice[i].height - 2 * once[i].height) < 8);
    }
}

TEST_CASE("A layout that the user changed is there again when the lab is reopened") {
    const fs::path home = temporary("config");
    fs::remove_all(home);
    ::setenv("XDG_CONFIG_HOME", home.c_str(), 1);
    const auto parameters = [](LabDriver& driver) {
        return driver.lab().report[static_cast<std::size_t>(ui::PanelId::parameters)];
    };
    float width = 0;
    {
        LabDriver driver("two-pins", 1280, 800, true);
        const ui::PanelReport usual = parameters(driver);
        REQUIRE(driver.act([&](ImGuiTestContext* user) { // the border between viewport and parameters
            user->MouseMoveToPos({usual.x - 2, usual.y + 300});
            user->MouseDragWithDelta({-120, 0});
        }));
        width = parameters(driver).width;
        CHECK(width > usual.width + 100);
    }
    CHECK(fs::exists(home / "clothlab" / "imgui.ini"));
    LabDriver driver("two-pins", 1280, 800, true);
    CHECK(parameters(driver).width == width);
    driver.lab().ask(ui::ResetLayout{});
    driver.settle();
    CHECK(parameters(driver).width < width - 100);
    ::unsetenv("XDG_CONFIG_HOME");
}

} // namespace clothlab::test
