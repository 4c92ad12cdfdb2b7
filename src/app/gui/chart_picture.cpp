#include "app/gui/chart_picture.h"

#include <glad/gl.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>
#include <implot.h>

#include "app/core/data_folder.h"
#include "render/offscreen.h"
#include "ui/charts.h"
#include "ui/theme.h"

namespace clothlab::app {
namespace {

/// Another ImGui beside the one in use, which comes back at the end.
class OwnImGui {
public:
    OwnImGui(int width, int height) {
        context_ = ImGui::CreateContext(); // which becomes the current one only where there is none
        plots_ = ImPlot::CreateContext();
        ImGui::SetCurrentContext(context_);
        ImPlot::SetCurrentContext(plots_);
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
        try {
            ui::load_fonts(data_path("fonts"));
        } catch (...) {
            close();
            throw;
        }
        ui::apply_theme(1);
        ImGui_ImplOpenGL3_Init("#version 330 core");
    }
    ~OwnImGui() {
        ImGui_ImplOpenGL3_Shutdown();
        close();
    }
    OwnImGui(const OwnImGui&) = delete;
    OwnImGui& operator=(const OwnImGui&) = delete;

private:
    void close() {
        ImPlot::DestroyContext(plots_);
        ImGui::DestroyContext(context_);
        ImGui::SetCurrentContext(context_before_);
        ImPlot::SetCurrentContext(plots_before_);
    }
    ImGuiContext* context_before_ = ImGui::GetCurrentContext();
    ImPlotContext* plots_before_ = ImPlot::GetCurrentContext();
    ImGuiContext* context_ = nullptr;
    ImPlotContext* plots_ = nullptr;
};

} // namespace

render::Image chart_picture(const experiments::Chart& chart, int width, int height) {
    render::Target target(width, height, 1);
    const OwnImGui imgui(width, height);
    // ImPlot learns how wide its labels are by drawing them.
    for (int i = 0; i < 3; ++i) {
        ImGui::GetIO().DeltaTime = 1.f / 60;
        ImGui_ImplOpenGL3_NewFrame();
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
        ImGui::Begin("chart", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings);
        ui::draw_chart(chart, {}, "chart", ImGui::GetContentRegionAvail(), true, true);
        ImGui::End();
        ImGui::PopStyleVar(2);
        ImGui::Render();
        target.bind();
        glDisable(GL_FRAMEBUFFER_SRGB); // ImGui's colours are sRGB already
        glClear(GL_COLOR_BUFFER_BIT);
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        target.resolve();
    }
    return target.read();
}

} // namespace clothlab::app
