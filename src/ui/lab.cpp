#include "ui/lab.h"

#include <algorithm>
#include <imgui.h>

#include "ui/camera.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/shader_editors.h"
#include "ui/step_panel.h"
#include "ui/timeline_parts.h"

namespace clothlab::ui {
namespace {

struct Panel {
    PanelId id;
    const char* name;
    const char* window; ///< title with icon, and the stable id that the layout file knows
    void (*draw)(Lab&);
};

/// The dockspace's name in layout files: fixed, so that these stay good.
constexpr ImGuiID dockspace = 0x0C107;

constexpr Panel panels[] = {
#define CLOTHLAB_PANEL(id, title, icon, at_start) {PanelId::id, title, icon "  " title "###" title, draw_##id},
#include "ui/panels.def"
#undef CLOTHLAB_PANEL
};

void draw_panel(Lab& lab, const Panel& panel) {
    const auto index = static_cast<std::size_t>(panel.id);
    PanelReport& report = lab.report[index];
    report = {panel.name};
    if (!lab.open[index])
        return;
    const bool viewport = panel.id == PanelId::viewport;
    if (viewport)
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGuiWindowFlags flags = 0;
    if (viewport)
        flags = ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoBackground;
    if (panel.id == PanelId::shader && has_unsaved_shaders(lab))
        flags = ImGuiWindowFlags_UnsavedDocument;
    // Where a layout of the user's own does not know the panel.
    ImGui::SetNextWindowSize({ImGui::GetFontSize() * 48, ImGui::GetFontSize() * 26}, ImGuiCond_FirstUseEver);
    const bool visible = ImGui::Begin(panel.window, &lab.open[index], flags);
    if (viewport)
        ImGui::PopStyleVar();
    if (visible) {
        const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
        report = {panel.name, true, false, at.x, at.y, size.x, size.y};
        panel.draw(lab);
    }
    report.behind = !visible;
    ImGui::End();
}

} // namespace

bool modified(const Lab& lab) {
    scene::Scene a = lab.scene, b = lab.loaded;
    a.camera.reset();
    b.camera.reset();
    return a != b;
}

namespace {

const scene::ShaderDeclaration* find_shader(const Lab& lab, const std::string& name) {
    const auto found = std::find_if(lab.shaders.begin(), lab.shaders.end(),
                                    [&](const scene::ShaderDeclaration& shader) { return shader.name == name; });
    return found == lab.shaders.end() ? nullptr : &*found;
}

} // namespace

const scene::ShaderDeclaration* shader_in_use(const Lab& lab) {
    return find_shader(lab, lab.scene.look.shader);
}

const scene::ShaderDeclaration* shader_on_the_right(const Lab& lab) {
    const scene::SplitView& split = lab.scene.look.split;
    return split.on ? find_shader(lab, split.shader) : nullptr;
}

void draw(Lab& lab) {
    advance_flight(lab, static_cast<double>(ImGui::GetIO().DeltaTime));
    handle_keys(lab);
    draw_menu(lab);
    draw_status_bar(lab);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, 0); // panels cover it: it would be drawn for nothing
    ImGui::DockSpaceOverViewport(dockspace);
    ImGui::PopStyleColor();
    follow_shader_files(lab);
    for (const Panel& panel : panels)
        draw_panel(lab, panel);
    follow_step_panel(lab);
    draw_output_window(lab);
    draw_job(lab);
    pass_on_shader_edits(lab);
    draw_quit_question(lab);
}

} // namespace clothlab::ui
