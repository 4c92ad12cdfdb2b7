// The window's picture is drawn only where it changes: it must be what drawing all of it gives.
#include <GLFW/glfw3.h>
#include <catch2/catch_test_macros.hpp>
#include <imgui_impl_opengl3.h>

#include <functional>
#include <set>
#include <string_view>

#include "gui/lab_driver.h"
#include "render/offscreen.h"

namespace clothlab::test {
namespace {

/// ImGui's last frame, drawn whole.
render::Image drawn_whole(int width, int height) {
    render::Target target(width, height, 1);
    target.bind();
    glDisable(GL_FRAMEBUFFER_SRGB);
    glClearColor(0.08f, 0.09f, 0.10f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    target.resolve();
    return target.read();
}

bool is_whole(LabDriver& driver) {
    const render::Image kept = driver.app().picture();
    return kept.rgba == drawn_whole(kept.width, kept.height).rgba;
}

} // namespace

TEST_CASE("A picture drawn only where it changes is the same as one drawn anew, in every frame") {
    LabDriver driver("sphere-medium", 800, 560);
    int frames = 0, wrong = 0;
    std::set<std::size_t> seen;
    driver.after_frame = [&] {
        ++frames;
        wrong += is_whole(driver) ? 0 : 1;
        const render::Image picture = driver.app().picture();
        const std::string_view bytes(reinterpret_cast<const char*>(picture.rgba.data()), picture.rgba.size());
        seen.insert(std::hash<std::string_view>{}(bytes));
    };
    // A step; a menu over panels, and gone again; a window that is moved, hides another and is closed.
    const bool done = driver.act([](ImGuiTestContext* user) {
        user->KeyPress(ImGuiKey_N);
        user->MenuClick("//##MainMenuBar/View");
        user->PopupCloseAll();
        user->KeyPress(ImGuiMod_Shift | ImGuiKey_F12);
        user->WindowMove("//###Output", {100, 120});
        user->WindowMove("//###Output", {200, 160});
        user->WindowClose("//###Output");
        user->ItemClick("###Look/Shear");
    });
    CHECK(done);
    driver.app().simulation().play(true);
    for (int i = 0; i < 20; ++i)
        driver.frame();
    driver.app().simulation().play(false);
    driver.settle();
    CHECK(wrong == 0);
    CHECK(seen.size() > 20);
    CHECK(frames > 60);
}

TEST_CASE("Another size of the window draws all of it") {
    LabDriver driver("two-pins", 800, 600);
    glfwSetWindowSize(glfwGetCurrentContext(), 640, 500);
    driver.settle();
    CHECK(driver.app().picture().width == 640);
    CHECK(is_whole(driver));
}

} // namespace clothlab::test
