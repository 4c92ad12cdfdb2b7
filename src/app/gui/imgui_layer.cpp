#include "app/gui/imgui_layer.h"

#include <glad/gl.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>
#include <imgui_internal.h> // ClearIniSettings
#include <implot.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "app/core/data_folder.h"
#include "scene/io.h"
#include "ui/theme.h"

namespace clothlab::app {
namespace fs = std::filesystem;
namespace {

/// The layout file's pixels are those of a display of scale 1: multiplies every Pos=, Size= and SizeRef=.
std::string scaled_layout(const std::string& text, float scale) {
    std::string result;
    std::size_t done = 0;
    while (done < text.size()) {
        std::size_t at = std::string::npos;
        for (const char* name : {"Pos=", "Size=", "SizeRef="})
            if (const std::size_t found = text.find(name, done); found != std::string::npos)
                at = std::min(at, found + std::strlen(name));
        int x = 0, y = 0, length = 0;
        if (at == std::string::npos || std::sscanf(text.c_str() + at, "%d,%d%n", &x, &y, &length) != 2)
            break;
        result += text.substr(done, at - done);
        const auto pixels = [scale](int v) { return std::to_string(std::lround(static_cast<float>(v) * scale)); };
        result += pixels(x) + "," + pixels(y);
        done = at + static_cast<std::size_t>(length);
    }
    return result + text.substr(done);
}

} // namespace

ImGuiLayer::ImGuiLayer(Window& window, fs::path layout, fs::path default_layout, float scale)
    : window_(window), layout_(std::move(layout)), default_layout_(std::move(default_layout)), forced_scale_(scale) {
    IMGUI_CHECKVERSION();
    context_ = ImGui::CreateContext();
    plots_ = ImPlot::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // saved below, so that a folder that cannot be written does no harm
    io.ConfigFlags |= ImGuiConfigFlags_DockingEnable | ImGuiConfigFlags_NavEnableKeyboard;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    try {
        ui::load_fonts(data_path("fonts"));
    } catch (...) {
        ImPlot::DestroyContext(plots_);
        ImGui::DestroyContext(context_);
        throw;
    }
    std::error_code error;
    if (!layout_.empty() && fs::exists(layout_, error))
        ImGui::LoadIniSettingsFromDisk(layout_.string().c_str());
    else
        default_layout_wanted_ = true;
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
}

ImGuiLayer::~ImGuiLayer() {
    save_layout_if_changed();
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImPlot::DestroyContext(plots_);
    ImGui::DestroyContext(context_);
}

void ImGuiLayer::begin_frame() {
    const float scale = forced_scale_ > 0 ? forced_scale_ : window_.content_scale();
    if (scale != scale_) {
        scale_ = scale;
        ui::apply_theme(scale);
    }
    if (default_layout_wanted_)
        load_default_layout();
    default_layout_wanted_ = false;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void ImGuiLayer::render() {
    ImGui::Render();
    glClearColor(0.08f, 0.09f, 0.10f, 1);
    if (ImGui::GetIO().WantSaveIniSettings)
        save_layout_if_changed();
}

void ImGuiLayer::end_frame() {
    render();
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool ImGuiLayer::end_frame_over_last(unsigned new_contents) {
    render();
    ImDrawData& data = *ImGui::GetDrawData();
    const std::vector<PixelRect> parts = damage_.update(data, new_contents);
    for (const PixelRect& part : parts)
        draw_part(data, part);
    return !parts.empty();
}

void ImGuiLayer::load_default_layout() {
    ImGui::ClearIniSettings();
    const std::string layout = scaled_layout(scene::read_text_file(default_layout_), scale_);
    ImGui::LoadIniSettingsFromMemory(layout.c_str(), layout.size());
}

void ImGuiLayer::save_layout_if_changed() {
    ImGui::GetIO().WantSaveIniSettings = false;
    if (layout_.empty())
        return;
    // Whole or not at all: a crash while saving must not cost the user the layout.
    std::error_code error;
    fs::create_directories(layout_.parent_path(), error);
    fs::path partial = layout_;
    partial += ".part";
    ImGui::SaveIniSettingsToDisk(partial.string().c_str());
    fs::rename(partial, layout_, error);
}

fs::path user_layout_file() {
    if (const char* config = std::getenv("XDG_CONFIG_HOME"); config && *config)
        return fs::path(config) / "clothlab" / "imgui.ini";
    if (const char* home = std::getenv("HOME"); home && *home)
        return fs::path(home) / ".config" / "clothlab" / "imgui.ini";
    return {};
}

} // namespace clothlab::app
