// The camera in the lab: sides, fitting, both projections, smooth ways, copy and paste.
#include <imgui.h>

#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "app/scene_view.h"
#include "lab_driver.h"
#include "render_fixture.h"
#include "scene/camera.h"
#include "small_scene.h"
#include "ui/camera.h"
#include "ui/icons.h"

namespace clothlab::test {
namespace {

constexpr const char* views = "###Viewport/" ICON_FA_VIDEO "##views";

LabDriver small_lab() {
    const TemporaryFolder folder;
    return LabDriver(small_scene(folder).string(), 800, 500);
}

const scene::Camera& camera_of(LabDriver& driver) {
    return *driver.lab().scene.camera;
}

/// A camera that is at rest nowhere in particular, with digits that only a full double keeps.
scene::Camera odd_camera() {
    return {{0.1, -1.0 / 3, 2e-7}, std::sqrt(2.0), -123.45678901234567, 1.0 / 7, 33.3, scene::Projection::orthographic};
}

/// Columns of the leftmost and rightmost pixel of a row that differ from an empty picture; {0, -1} without any.
std::pair<int, int> extent(const render::Image& image, const render::Image& empty, int y) {
    std::pair<int, int> found{0, -1};
    for (int x = 0; x < image.width; ++x)
        if (differs(image, empty, x, y))
            found = {found.second < 0 ? x : found.first, x};
    return found;
}

} // namespace

TEST_CASE("Keys turn the camera to each side, about the same target from as far") {
    LabDriver driver = small_lab();
    const scene::Camera start = camera_of(driver);
    const auto pressed = [&](ImGuiKeyChord key) {
        REQUIRE(driver.act([&](ImGuiTestContext* user) { user->KeyPress(key); }));
        return camera_of(driver);
    };
    const auto turned = [&](double yaw, double pitch) {
        scene::Camera camera = start;
        camera.yaw = yaw;
        camera.pitch = pitch;
        return camera;
    };
    CHECK(pressed(ImGuiKey_1) == turned(0, 0));
    CHECK(pressed(ImGuiMod_Shift | ImGuiKey_1) == turned(180, 0));
    CHECK(pressed(ImGuiKey_3) == turned(90, 0));
    CHECK(pressed(ImGuiMod_Shift | ImGuiKey_3) == turned(-90, 0));
    CHECK(pressed(ImGuiKey_7) == turned(0, 90));
    CHECK(pressed(ImGuiKey_Keypad1) == turned(0, 0));
    CHECK(pressed(ImGuiKey_9) == turned(30, 20));
    CHECK(pressed(ImGuiKey_Keypad7) == turned(0, 90));
    CHECK(pressed(ImGuiKey_0) == scene::camera_of(driver.lab().loaded));
}

TEST_CASE("The camera's menu does what the keys do") {
    LabDriver driver = small_lab();
    const scene::Camera start = camera_of(driver);
    const auto chosen = [&](const char* entry) {
        REQUIRE(driver.act([&](ImGuiTestContext* user) {
            user->ItemClick(views);
            user->Yield(2);
            user->SetRef("//$FOCUSED");
            user->ItemClick(entry);
        }));
        return camera_of(driver);
    };
    CHECK(chosen("Fit the cloth") == scene::fitted(start, driver.lab().snapshot->positions));
    CHECK(chosen("Top").pitch == 90);
    CHECK(chosen("Orthographic").projection == scene::Projection::orthographic);
    CHECK(chosen("Scene's own view") == scene::camera_of(driver.lab().loaded));
    // The field of view, with its reset.
    REQUIRE(driver.act([&](ImGuiTestContext* user) {
        user->ItemClick(views);
        user->Yield(2);
        user->SetRef("//$FOCUSED");
        user->ItemInputValue("**/camera.fov/##value", "60");
    }));
    CHECK(camera_of(driver).fov == 60);
}

TEST_CASE("F shows the scene and Shift+F the cloth as it is, from where the camera looks, in both projections") {
    LabDriver driver = small_lab();
    driver.app().show_frame(40);
    const auto fit = [&](ImGuiKeyChord side, ImGuiKeyChord key) {
        REQUIRE(driver.act([&](ImGuiTestContext* user) {
            user->KeyPress(side);
            user->KeyPress(key);
        }));
        const render::DrawReport& report = driver.app().draw_report();
        CHECK(report.points_in_view == small_side * small_side);
        const double width = static_cast<double>(report.cloth_box.width()) / report.width;
        const double height = static_cast<double>(report.cloth_box.height()) / report.height;
        return std::max(width * std::max(1.0, static_cast<double>(report.width) / report.height),
                        height * std::max(1.0, static_cast<double>(report.height) / report.width));
    };
    for (int projection = 0; projection < 2; ++projection) {
        for (const ImGuiKeyChord side : {ImGuiKey_1, ImGuiKey_9}) {
            const double whole = fit(side, ImGuiKey_F), close = fit(side, ImGuiMod_Shift | ImGuiKey_F);
            // The box of the points touches the picture's shorter side, but for the margin.
            CHECK(close > 0.85);
            CHECK(close <= 1);
            CHECK(whole < 1);
        }
        REQUIRE(driver.act([](ImGuiTestContext* user) { user->KeyPress(ImGuiKey_5); }));
    }
}

TEST_CASE("The camera flies smoothly to where it is sent and arrives exactly, a drag ends the flight") {
    LabDriver driver = small_lab();
    const scene::Camera start = camera_of(driver);
    const scene::Camera right = scene::seen_from(start, scene::Side::right);
    ui::fly(driver.lab(), right);
    double yaw = start.yaw;
    int stops = 0;
    for (; driver.lab().flight; ++stops) {
        ui::advance_flight(driver.lab(), 0.02);
        CHECK(camera_of(driver).yaw > yaw);
        yaw = camera_of(driver).yaw;
    }
    CHECK(stops == 13); // a quarter of a second
    CHECK(camera_of(driver) == right);

    ui::fly(driver.lab(), start);
    ui::advance_flight(driver.lab(), 0.05);
    REQUIRE(driver.lab().flight);
    driver.lab().scene.camera->yaw += 1; // as a drag does
    const scene::Camera dragged = camera_of(driver);
    ui::advance_flight(driver.lab(), 0.05);
    CHECK_FALSE(driver.lab().flight);
    CHECK(camera_of(driver) == dragged);

    // A picture shows where the flight goes.
    ui::fly(driver.lab(), start);
    driver.app().show_frame(0);
    CHECK(camera_of(driver) == start);
}

TEST_CASE(
    "Both projections show a cloth at the target in the same size, only the orthographic one keeps lines parallel") {
    Studio studio;
    studio.target.resize(200, 160);
    const sim::Snapshot cloth = flat_cloth(9, 9);
    const auto drawn = [&](const scene::Camera& camera) {
        render::Scene scene = scene_of(cloth);
        scene.view = app::to_view(camera, 200.0 / 160);
        return studio.draw(scene);
    };
    for (const double fov : {20.0, 45.0, 90.0}) {
        scene::Camera camera{{0, 0, 0}, 0.8 / std::tan(fov / 2 * std::acos(-1.0) / 180), 0, 90, fov};
        drawn(camera);
        const int perspective = studio.report.cloth_box.height();
        camera.projection = scene::Projection::orthographic;
        drawn(camera);
        CHECK(std::abs(studio.report.cloth_box.height() - perspective) <= 1);
        CHECK(std::abs(studio.report.cloth_box.height() - 100) <= 2); // 1 m of 1.6 m
    }
    // Seen aslant, the far edge is as long as the near one only without perspective.
    scene::Camera camera{{0, 0, 0}, 2, 0, 40, 45};
    for (const bool orthographic : {false, true}) {
        camera.projection = orthographic ? scene::Projection::orthographic : scene::Projection::perspective;
        render::Scene nothing = empty_scene();
        nothing.view = app::to_view(camera, 200.0 / 160);
        const render::Image empty = studio.draw(nothing), image = drawn(camera);
        const auto [low, high] = std::pair(studio.report.cloth_box.min_y + 3, studio.report.cloth_box.max_y - 3);
        const auto far_edge = extent(image, empty, low), near_edge = extent(image, empty, high);
        REQUIRE(far_edge.second > far_edge.first);
        const int shift = std::abs(far_edge.first - near_edge.first) + std::abs(far_edge.second - near_edge.second);
        INFO(orthographic);
        CHECK((shift <= 2) == orthographic);
        CHECK((shift > 20) == !orthographic);
    }
}

TEST_CASE("An orthographic camera shows what is behind its eye, and the wheel zooms it") {
    LabDriver driver = small_lab();
    scene::Camera near = camera_of(driver);
    near.projection = scene::Projection::orthographic;
    near.fov = 170; // from so near that the eye is among the cloth
    near.distance = 0.1;
    driver.lab().scene.camera = near;
    driver.settle();
    CHECK(driver.app().draw_report().points_in_view > 50);
    const int width = driver.app().draw_report().cloth_box.width();
    const ui::PanelReport& viewport = driver.lab().report[static_cast<std::size_t>(ui::PanelId::viewport)];
    const ImVec2 middle{viewport.x + viewport.width / 2, viewport.y + viewport.height / 2};
    REQUIRE(driver.act([&](ImGuiTestContext* user) {
        user->MouseMoveToPos(middle);
        user->MouseWheelY(-2);
    }));
    CHECK(driver.app().draw_report().cloth_box.width() < width);
}

TEST_CASE("A camera copied as JSON is pasted to the last digit, and `render --camera` reads it") {
    LabDriver driver = small_lab();
    driver.lab().scene.camera = odd_camera();
    std::string copied;
    REQUIRE(driver.act([&](ImGuiTestContext* user) {
        user->KeyPress(ImGuiMod_Ctrl | ImGuiMod_Shift | ImGuiKey_C);
        copied = ImGui::GetClipboardText(); // the test engine's own, only while it acts
        user->KeyPress(ImGuiKey_0);
        user->KeyPress(ImGuiMod_Ctrl | ImGuiMod_Shift | ImGuiKey_V);
    }));
    CHECK(scene::read_camera(copied, "camera.json") == odd_camera());
    CHECK(camera_of(driver) == odd_camera());
    CHECK(driver.lab().messages.empty());
}

TEST_CASE("A paste that is no camera changes nothing, and the lab says what is wrong with it") {
    LabDriver driver = small_lab();
    const scene::Camera before = camera_of(driver);
    const auto complaint = [&](const char* text) {
        driver.lab().messages.clear();
        REQUIRE(driver.act([&](ImGuiTestContext* user) {
            ImGui::SetClipboardText(text);
            user->KeyPress(ImGuiMod_Ctrl | ImGuiMod_Shift | ImGuiKey_V);
        }));
        CHECK(camera_of(driver) == before);
        REQUIRE(driver.lab().messages.size() == 1);
        CHECK(driver.lab().messages.front().error);
        return driver.lab().messages.front().text;
    };
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    CHECK(has(complaint(""), "no text"));
    CHECK(has(complaint("{\n\"jaw\": 3}"), "clipboard:2: camera.jaw: unknown key; did you mean \"yaw\"?"));
    CHECK(has(complaint("a line of a mail"), "not valid JSON"));
    CHECK(has(complaint("{\"distance\": -1}"), "above 0"));
}

} // namespace clothlab::test
