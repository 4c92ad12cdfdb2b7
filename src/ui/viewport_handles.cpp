// What can be dragged in the picture itself: the divider of a split view, and the lamps.
#include "ui/viewport_handles.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>

#include "ui/icons.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

void divider_handle(Lab& lab, ImVec2 corner, ImVec2 size) {
    scene::SplitView& split = lab.scene.look.split;
    const float x = corner.x + size.x * static_cast<float>(split.position);
    const float grip = ImGui::GetFontSize() * 0.6f;
    ImGui::SetCursorScreenPos({x - grip, corner.y});
    ImGui::SetNextItemAllowOverlap();
    ImGui::InvisibleButton("divider", {2 * grip, size.y});
    const bool near = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (near)
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActive())
        split.position =
            std::clamp(static_cast<double>((ImGui::GetIO().MousePos.x - corner.x) / std::max(size.x, 1.f)), 0.0, 1.0);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddLine({x, corner.y}, {x, corner.y + size.y}, ImGui::GetColorU32(near ? colour::accent : colour::faint),
                  near ? 3.f : 1.5f);
    const float y = corner.y + size.y / 2;
    list->AddCircleFilled({x, y}, grip, ImGui::GetColorU32(near ? colour::accent : colour::faint));
    list->AddText({x - ImGui::CalcTextSize(ICON_FA_LEFT_RIGHT).x / 2, y - ImGui::GetTextLineHeight() / 2},
                  IM_COL32(20, 22, 25, 255), ICON_FA_LEFT_RIGHT);
}

/// Names the two parts at the bottom of the picture, one on each side of the divider.
void divider_labels(const Lab& lab, ImVec2 corner, ImVec2 size) {
    const scene::Look& look = lab.scene.look;
    const bool other_spheres = look.sphere_latitude_lines != look.split.sphere_latitude_lines ||
                               look.sphere_longitude_lines != look.split.sphere_longitude_lines;
    const auto title = [&](const std::string& name, int latitude, int longitude) {
        std::string text = name;
        for (const scene::ShaderDeclaration& shader : lab.shaders)
            if (shader.name == name)
                text = shader.title;
        if (other_spheres)
            text += ", sphere " + std::to_string(latitude) + " x " + std::to_string(longitude);
        return text;
    };
    const float x = corner.x + size.x * static_cast<float>(look.split.position), pad = ImGui::GetFontSize();
    const float y = corner.y + size.y - 2 * ImGui::GetTextLineHeight();
    const std::string left = title(look.shader, look.sphere_latitude_lines, look.sphere_longitude_lines);
    const std::string right =
        title(look.split.shader, look.split.sphere_latitude_lines, look.split.sphere_longitude_lines);
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImU32 text = ImGui::GetColorU32(ImGuiCol_Text);
    list->AddText({x - pad - ImGui::CalcTextSize(left.c_str()).x, y}, text, left.c_str());
    list->AddText({x + pad, y}, text, right.c_str());
}

struct Projected {
    ImVec2 at;           ///< on the screen
    double metres = 0;   ///< that a pixel is wide at the point
    bool inside = false; ///< in front of the camera, in the picture
};

Projected project(const scene::Camera& camera, const sim::Vec3& point, ImVec2 corner, ImVec2 size) {
    const scene::CameraFrame f = scene::frame(camera);
    const auto dot = [](const sim::Vec3& a, const sim::Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    const sim::Vec3 d{point.x - f.eye.x, point.y - f.eye.y, point.z - f.eye.z};
    const sim::Vec3 to_target{camera.target.x - f.eye.x, camera.target.y - f.eye.y, camera.target.z - f.eye.z};
    const bool orthographic = camera.projection == scene::Projection::orthographic;
    const double depth = orthographic ? camera.distance : dot(d, to_target) / std::max(camera.distance, 1e-9);
    const double shorter = static_cast<double>(std::max(std::min(size.x, size.y), 1.f));
    Projected p;
    p.metres = 2 * depth * std::tan(camera.fov * 0.00872664625997) / shorter;
    if (!(p.metres > 0))
        return p;
    const double x = dot(d, f.right) / p.metres, y = dot(d, f.up) / p.metres;
    p.at = {corner.x + size.x / 2 + static_cast<float>(x), corner.y + size.y / 2 - static_cast<float>(y)};
    p.inside = p.at.x > corner.x && p.at.x < corner.x + size.x && p.at.y > corner.y && p.at.y < corner.y + size.y;
    return p;
}

/// A lamp is dragged in the plane through it that faces the beholder; with the wheel it comes nearer and goes away.
void lamp_handle(Lab& lab, scene::Lamp& lamp, const char* id, const char* name, ImVec2 corner, ImVec2 size) {
    const scene::Camera camera = scene::camera_of(lab.scene);
    const Projected p = project(camera, lamp.position, corner, size);
    if (!p.inside)
        return;
    const float half = ImGui::GetFontSize();
    ImGui::SetCursorScreenPos({p.at.x - half, p.at.y - half});
    ImGui::SetNextItemAllowOverlap();
    ImGui::InvisibleButton(id, {2 * half, 2 * half});
    const bool near = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (being_dragged()) {
        const scene::CameraFrame f = scene::frame(camera);
        const ImVec2 moved = ImGui::GetIO().MouseDelta;
        const double r = static_cast<double>(moved.x) * p.metres, u = -static_cast<double>(moved.y) * p.metres;
        sim::Vec3& at = lamp.position;
        at = {at.x + r * f.right.x + u * f.up.x, at.y + r * f.right.y + u * f.up.y, at.z + r * f.right.z + u * f.up.z};
    }
    tooltip(std::string(name) + ": drag it; its place and intensity are in the panel Look under Light.");
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddCircleFilled(p.at, half * 0.8f, IM_COL32(20, 22, 25, near ? 230 : 120));
    const ImVec2 icon = ImGui::CalcTextSize(ICON_FA_LIGHTBULB);
    list->AddText({p.at.x - icon.x / 2, p.at.y - icon.y / 2}, ImGui::GetColorU32(near ? colour::warning : colour::text),
                  ICON_FA_LIGHTBULB);
}

} // namespace

void draw_viewport_handles(Lab& lab, ImVec2 corner, ImVec2 size) {
    scene::Look& look = lab.scene.look;
    if (lab.show_lamps) {
        lamp_handle(lab, look.lamp, "lamp", "The lamp", corner, size);
        if (look.second_lamp.intensity > 0)
            lamp_handle(lab, look.second_lamp, "second lamp", "The second lamp", corner, size);
    }
    if (look.split.on) {
        divider_labels(lab, corner, size);
        divider_handle(lab, corner, size);
    }
}

} // namespace clothlab::ui
