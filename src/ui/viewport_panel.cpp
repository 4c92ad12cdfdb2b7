// The picture of the scene, and the mouse in it.
#include <algorithm>
#include <imgui.h>

#include "ui/camera.h"
#include "ui/icons.h"
#include "ui/legend.h"
#include "ui/panels.h"
#include "ui/step_panel.h"
#include "ui/theme.h"
#include "ui/viewport_handles.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

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
    draw_step_in_viewport(lab, corner, at_least_one);
    draw_viewport_handles(lab, corner, at_least_one);
    draw_legend(lab, corner, size);
    const float bar = draw_camera_bar(lab, corner, size.x);
    draw_recording_badge(lab, corner.x, corner.y + size.y);
    draw_messages(lab, {corner.x, corner.y + bar}, size.x);
    draw_shader_faults(lab, corner, size);
}

} // namespace clothlab::ui
