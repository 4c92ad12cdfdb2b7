#include "app/gui/imgui_layer.h"

#include <glad/gl.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>
#include <imgui_internal.h>  // ClearIniSettings

#include <cstdlib>

#include "app/core/data_folder.h"
#include "ui/theme.h"

namespace clothlab::app {
namespace fs = std::filesystem;

ImGuiLayer::ImGuiLayer(Window& window, fs::path layout, fs::path default_layout, float scale)
    : window_(window), layout_(std::move(layout)), default_layout_(std::move(default_layout)), forced_scale_(scale) {
    IMGUI_CHECKVERSION();
    context_ = ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // saved below, so that a folder that cannot be written does no harm
    io.ConfigFlags |= ImGuiConfigFlags_DockingEnable | ImGuiConfigFlags_NavEnableKeyboard;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    try {
        ui::load_fonts(data_path("fonts"));
    } catch (...) {
        ImGui::DestroyContext(context_);
        throw;
    }
    std::error_code error;
    load_layout(!layout_.empty() && fs::exists(layout_, error) ? layout_ : default_layout_);
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    ImGui_ImplOpenGL3_Init("#version 410 core");
}

ImGuiLayer::~ImGuiLayer() {
    save_layout_if_changed();
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext(context_);
}

void ImGuiLayer::begin_frame() {
    if (reset_layout_) load_layout(default_layout_);
    reset_layout_ = false;
    const float scale = forced_scale_ > 0 ? forced_scale_ : window_.content_scale();
    if (scale != scale_) {
        scale_ = scale;
        ui::apply_theme(scale);
    }
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void ImGuiLayer::end_frame(unsigned framebuffer) {
    ImGui::Render();
    int width = 0, height = 0;
    window_.framebuffer_size(width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, width, height);
    glClearColor(0.08f, 0.09f, 0.10f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    if (ImGui::GetIO().WantSaveIniSettings) save_layout_if_changed();
}

void ImGuiLayer::load_layout(const fs::path& file) {
    ImGui::ClearIniSettings();
    ImGui::LoadIniSettingsFromDisk(file.string().c_str());
}

void ImGuiLayer::save_layout_if_changed() {
    ImGui::GetIO().WantSaveIniSettings = false;
    if (layout_.empty()) return;
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

}  // namespace clothlab::app
