// How the cloth is drawn: nothing here changes the simulation.
#include <algorithm>
#include <imgui.h>

#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

void spring_switch(Lab& lab, sim::SpringKind kind, const char* label, bool& on) {
    const auto& c = lab.spring_colours[static_cast<std::size_t>(kind)];
    ImGui::PushStyleColor(ImGuiCol_CheckMark, ImVec4(c[0], c[1], c[2], 1));
    ImGui::Checkbox(label, &on);
    ImGui::PopStyleColor();
    ImGui::SameLine();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float h = ImGui::GetFrameHeight();
    ImGui::GetWindowDrawList()->AddLine({at.x, at.y + h / 2}, {at.x + 2 * h, at.y + h / 2},
                                        ImGui::GetColorU32(ImVec4(c[0], c[1], c[2], on ? 1.f : 0.3f)), h / 8);
    ImGui::Dummy({2 * h, h});
}

/// A list of the shaders by title, with some space left free at its right; true when another was chosen.
bool shader_list(const Lab& lab, const char* id, std::string& chosen, float free = 0) {
    std::string title = chosen;
    for (const scene::ShaderDeclaration& shader : lab.shaders)
        if (shader.name == chosen)
            title = shader.title;
    bool changed = false;
    ImGui::SetNextItemWidth(free > 0 ? -free : -1);
    if (ImGui::BeginCombo(id, title.c_str(), ImGuiComboFlags_HeightLarge)) {
        for (const scene::ShaderDeclaration& shader : lab.shaders) {
            if (ImGui::Selectable((shader.title + "##" + shader.name).c_str(), shader.name == chosen)) {
                chosen = shader.name;
                changed = true;
            }
            tooltip(shader.error.empty() ? shader.help : shader.error);
        }
        ImGui::EndCombo();
    }
    return changed;
}

void shader_parameters(Lab& lab, const scene::ShaderDeclaration& shader) {
    if (!shader.error.empty()) {
        ImGui::PushTextWrapPos();
        ImGui::TextColored(colour::error, "%s", shader.error.c_str());
        ImGui::PopTextWrapPos();
    }
    if (shader.parameters.empty() || !begin_fields(("shader " + shader.name).c_str()))
        return;
    for (const scene::ShaderParameter& parameter : shader.parameters)
        shader_row(lab, shader, parameter);
    end_fields();
}

void springs(Lab& lab, bool lines) {
    scene::Look& look = lab.scene.look;
    ImGui::BeginDisabled(lines);
    ImGui::Checkbox("Over the surface", &look.springs_over_surface);
    ImGui::EndDisabled();
    tooltip("Draw springs over the shaded cloth. The wireframe always draws them.");
    ImGui::BeginDisabled(!lines && !look.springs_over_surface);
    spring_switch(lab, sim::SpringKind::structural, "Structural", look.show_structural);
    spring_switch(lab, sim::SpringKind::shear, "Shear", look.show_shearing);
    spring_switch(lab, sim::SpringKind::bending, "Bending", look.show_bending);
    ImGui::EndDisabled();
}

void rows(Lab& lab, const char* id, std::initializer_list<std::string_view> keys) {
    if (!begin_fields(id))
        return;
    for (const std::string_view key : keys)
        field_row(lab, key);
    end_fields();
}

void split_view(Lab& lab) {
    scene::SplitView& split = lab.scene.look.split;
    ImGui::Checkbox("Compare with another on the right", &split.on);
    tooltip("Draws the right part of the picture with another shader, or the sphere in another coarseness. Drag the "
            "divider in the viewport.");
    ImGui::BeginDisabled(!split.on);
    shader_list(lab, "##split shader", split.shader);
    tooltip("The shader of the right part, with its own parameters: choose it on the left to change them.");
    rows(lab, "split", {"look.split_latitude_lines", "look.split_longitude_lines"});
    ImGui::EndDisabled();
}

} // namespace

void draw_look(Lab& lab) {
    scene::Look& look = lab.scene.look;
    shader_list(lab, "##shader", look.shader, ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x);
    tooltip("How the cloth is drawn. Key W changes between wireframe and the last shader.");
    ImGui::SameLine();
    if (icon_button(ICON_FA_PEN, "##edit", "Edit the shader: opens the panel Shader"))
        lab.open[static_cast<std::size_t>(PanelId::shader)] = true;
    const scene::ShaderDeclaration* shader = shader_in_use(lab);
    if (shader)
        shader_parameters(lab, *shader);

    const bool lines = shader && shader->lines;
    if (ImGui::CollapsingHeader("Springs drawn", ImGuiTreeNodeFlags_DefaultOpen))
        springs(lab, lines);
    if (ImGui::CollapsingHeader("Light")) {
        ImGui::Checkbox("Show the lamps in the viewport", &lab.show_lamps);
        tooltip("As handles that can be dragged.");
        rows(lab, "light",
             {"look.shadow", "look.lamp_intensity", "look.lamp_position", "look.second_lamp_intensity",
              "look.second_lamp_position", "look.ambient", "look.fill"});
    }
    if (ImGui::CollapsingHeader("Also drawn", ImGuiTreeNodeFlags_DefaultOpen)) {
        ImGui::Checkbox("Pins", &look.show_pins);
        ImGui::SameLine();
        ImGui::Checkbox("Colliders", &look.show_colliders);
        ImGui::SameLine();
        ImGui::Checkbox("Ground", &look.ground_grid);
        tooltip(std::string(scene::find_field("look.ground_grid")->help));
        rows(lab, "spheres",
             {"look.sphere", "look.sphere_latitude_lines", "look.sphere_longitude_lines", "look.multisampling"});
    }
    if (ImGui::CollapsingHeader("Split view"))
        split_view(lab);
}

} // namespace clothlab::ui
