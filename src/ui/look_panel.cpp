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

} // namespace

void draw_look(Lab& lab) {
    scene::Look& look = lab.scene.look;
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##shader", ("Shader: " + look.shader).c_str())) {
        for (const std::string& name : lab.shaders)
            if (ImGui::Selectable(name.c_str(), name == look.shader))
                look.shader = name;
        ImGui::EndCombo();
    }
    tooltip("How the cloth is drawn. Key W changes between wireframe and diffuse.");

    ImGui::SeparatorText("Springs drawn");
    const bool drawn = look.shader == "wireframe" || look.springs_over_surface;
    ImGui::BeginDisabled(look.shader == "wireframe");
    ImGui::Checkbox("Over the surface", &look.springs_over_surface);
    ImGui::EndDisabled();
    tooltip("Draw springs over the shaded cloth. The wireframe always draws them.");
    ImGui::BeginDisabled(!drawn);
    spring_switch(lab, sim::SpringKind::structural, "Structural", look.show_structural);
    spring_switch(lab, sim::SpringKind::shear, "Shear", look.show_shearing);
    spring_switch(lab, sim::SpringKind::bending, "Bending", look.show_bending);
    ImGui::EndDisabled();

    ImGui::SeparatorText("Also drawn");
    ImGui::Checkbox("Pins", &look.show_pins);
    ImGui::SameLine();
    ImGui::Checkbox("Colliders", &look.show_colliders);

    ImGui::SeparatorText("Drawn spheres, camera");
    if (begin_fields("sphere and camera")) {
        field_row(lab, "look.sphere_latitude_lines");
        field_row(lab, "look.sphere_longitude_lines");
        field_row(lab, "camera.fov");
        end_fields();
    }
    if (ImGui::Button(ICON_FA_EXPAND "  Fit view"))
        lab.scene.camera = scene::fitting_camera(lab.scene.simulation);
    tooltip("Show the whole scene (F)");
    ImGui::SameLine();
    if (ImGui::Button(ICON_FA_VIDEO "  Scene's view"))
        lab.scene.camera = scene::camera_of(lab.loaded);
    tooltip("Back to the camera that the scene was loaded with");
}

} // namespace clothlab::ui
