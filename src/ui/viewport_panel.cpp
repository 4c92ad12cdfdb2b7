// The picture of the scene, and the mouse in it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <imgui.h>

#include "ui/icons.h"
#include "ui/legend.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/viewport_handles.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

void move_camera(Lab& lab, float shorter_side) {
    const ImGuiIO& io = ImGui::GetIO();
    scene::Camera camera = scene::camera_of(lab.scene);
    const scene::Camera before = camera;
    if (ImGui::IsItemActive()) {
        const double dx = static_cast<double>(io.MouseDelta.x), dy = static_cast<double>(io.MouseDelta.y);
        if (ImGui::IsMouseDown(ImGuiMouseButton_Left) && !io.KeyShift) {
            camera.yaw = std::remainder(camera.yaw - 0.35 * dx, 360.0);
            camera.pitch = std::clamp(camera.pitch + 0.35 * dy, -89.0, 89.0);
        } else {
            // The point under the mouse follows it: the shorter side is what the field of view spans at the target.
            const double per_pixel =
                2 * camera.distance * std::tan(camera.fov * 0.00872664625997) / static_cast<double>(shorter_side);
            const scene::CameraFrame f = scene::frame(camera);
            const double r = -dx * per_pixel, u = dy * per_pixel;
            camera.target = {camera.target.x + r * f.right.x + u * f.up.x, camera.target.y + r * f.right.y + u * f.up.y,
                             camera.target.z + r * f.right.z + u * f.up.z};
        }
    }
    if (ImGui::IsItemHovered() && io.MouseWheel != 0)
        camera.distance =
            std::clamp(camera.distance * std::pow(0.88, static_cast<double>(io.MouseWheel)), 0.02, 1000.0);
    if (camera != before)
        lab.scene.camera = camera;
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        lab.scene.camera = scene::fitting_camera(lab.scene.simulation);
}

/// What went wrong, over the picture until it is dismissed; the newest three.
void draw_messages(Lab& lab, ImVec2 corner, float width) {
    while (lab.messages.size() > 3)
        lab.messages.pop_front();
    const float pad = ImGui::GetStyle().WindowPadding.x;
    float y = corner.y + pad;
    for (std::size_t i = 0; i < lab.messages.size(); ++i) {
        const Message& message = lab.messages[i];
        ImGui::SetCursorScreenPos({corner.x + pad, y});
        ImGui::PushID(static_cast<int>(i));
        ImGui::PushStyleColor(ImGuiCol_ChildBg, ImVec4(0.12f, 0.12f, 0.13f, 0.94f));
        ImGui::PushStyleColor(ImGuiCol_Border, message.error ? colour::error : colour::good);
        const bool visible = ImGui::BeginChild("message", {std::max(width - 2 * pad, 1.f), 0},
                                               ImGuiChildFlags_Borders | ImGuiChildFlags_AutoResizeY);
        ImGui::PopStyleColor(2);
        bool dismissed = false;
        if (visible) {
            ImGui::TextColored(message.error ? colour::error : colour::good, "%s",
                               message.error ? ICON_FA_TRIANGLE_EXCLAMATION : ICON_FA_CIRCLE_CHECK);
            ImGui::SameLine();
            const float button_x = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - ImGui::GetFrameHeight();
            ImGui::PushTextWrapPos(std::max(button_x - pad, 1.f));
            ImGui::TextUnformatted(message.text.c_str());
            ImGui::PopTextWrapPos();
            ImGui::SameLine(std::max(button_x, 0.f));
            dismissed = ImGui::SmallButton(ICON_FA_XMARK);
        }
        y += ImGui::GetWindowSize().y + pad / 2;
        ImGui::EndChild();
        ImGui::PopID();
        if (dismissed) {
            lab.messages.erase(lab.messages.begin() + static_cast<std::ptrdiff_t>(i));
            return;
        }
    }
}

} // namespace

void draw_viewport(Lab& lab) {
    const ImVec2 corner = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
    const float density = ImGui::GetIO().DisplayFramebufferScale.x;
    lab.viewport_width = std::max(1, static_cast<int>(size.x * density));
    lab.viewport_height = std::max(1, static_cast<int>(size.y * density));
    const ImVec2 at_least_one{std::max(size.x, 1.f), std::max(size.y, 1.f)};
    if (lab.viewport_texture != 0)
        ImGui::Image(static_cast<ImTextureID>(lab.viewport_texture), at_least_one, {0, 1}, {1, 0});
    ImGui::SetCursorScreenPos(corner);
    // The button owns the mouse: a drag that starts here moves the camera, also beyond the panel, and nothing else
    // does.
    ImGui::SetNextItemAllowOverlap();
    ImGui::InvisibleButton("camera", at_least_one,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    ImGui::SetItemKeyOwner(ImGuiKey_MouseWheelY);
    move_camera(lab, std::min(at_least_one.x, at_least_one.y));
    draw_viewport_handles(lab, corner, at_least_one);
    draw_legend(lab, corner);
    draw_messages(lab, corner, size.x);
}

} // namespace clothlab::ui
