// What the shader work says outside of its panel: faults over the picture, and the question before the lab is closed.
#include <algorithm>
#include <imgui.h>

#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/shader_editors.h"
#include "ui/theme.h"

namespace clothlab::ui {

void draw_shader_faults(Lab& lab, ImVec2 corner, ImVec2 size) {
    ShaderWork& work = lab.shader_work;
    if (work.faults.empty())
        return;
    const ShaderFault& first = work.faults.front();
    std::string text = place_of(work, first) + ": " + first.text;
    if (const std::size_t more = work.faults.size() - 1; more > 0)
        text += " (and " + std::to_string(more) + " more)";
    const float pad = ImGui::GetStyle().WindowPadding.x;
    const char* button = "Show";
    const float button_width = ImGui::CalcTextSize(button).x + 2 * ImGui::GetStyle().FramePadding.x;
    const float width = std::max(size.x - 2 * pad, 1.f);
    const float wrap = std::max(width - button_width - 4 * pad - ImGui::GetFontSize() * 1.5f, 1.f);
    // With the panel in view everybody sees what is going on, and the picture is small.
    const bool explain = !lab.report[static_cast<std::size_t>(PanelId::shader)].drawn;
    const float height = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap).y +
                         (explain ? ImGui::GetTextLineHeightWithSpacing() : 0) + 2 * ImGui::GetStyle().WindowPadding.y;
    ImGui::SetCursorScreenPos({corner.x + pad, corner.y + std::max(size.y - height - pad, 0.f)});
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ImVec4(0.12f, 0.12f, 0.13f, 0.94f));
    ImGui::PushStyleColor(ImGuiCol_Border, colour::error);
    const bool visible = ImGui::BeginChild("shader faults", {width, height}, ImGuiChildFlags_Borders);
    ImGui::PopStyleColor(2);
    if (visible) {
        ImGui::TextColored(colour::error, ICON_FA_TRIANGLE_EXCLAMATION);
        ImGui::SameLine();
        ImGui::BeginGroup();
        ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + wrap);
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopTextWrapPos();
        if (explain)
            ImGui::TextColored(colour::faint, "The last shader without a mistake goes on drawing.");
        ImGui::EndGroup();
        ImGui::SameLine(std::max(width - button_width - pad, 0.f));
        if (ImGui::SmallButton(button)) {
            lab.open[static_cast<std::size_t>(PanelId::shader)] = true;
            ImGui::SetWindowFocus("###Shader");
            work.go_to = first;
        }
    }
    ImGui::EndChild();
}

void draw_quit_question(Lab& lab) {
    constexpr const char* window = "Unsaved shaders###unsaved shaders";
    ShaderEditors& editors = shader_editors(lab);
    if (editors.quit_in >= 0 && editors.quit_in-- == 0)
        lab.ask(Quit{}); // asks again where a file could not be saved
    if (lab.shader_work.asking_to_quit && !ImGui::IsPopupOpen(window))
        ImGui::OpenPopup(window);
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(window, nullptr, ImGuiWindowFlags_AlwaysAutoResize))
        return;
    ImGui::TextUnformatted("These shaders were changed and not saved:");
    for (const auto& [name, editor] : editors.by_name)
        if (editor.modified)
            ImGui::BulletText("%s", name.c_str());
    bool done = false;
    ImGui::BeginDisabled(lab.shader_work.folder.empty());
    if (ImGui::Button(ICON_FA_FLOPPY_DISK "  Save and quit###save")) {
        for (const auto& [name, editor] : editors.by_name)
            if (editor.modified)
                lab.ask(SaveShader{name, editor.text.GetText()});
        editors.quit_in = 2; // the editors have heard of it by then
        done = true;
    }
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Quit without saving###drop")) {
        lab.ask(Quit{true});
        done = true;
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGuiKey_Escape))
        done = true;
    if (done) {
        lab.shader_work.asking_to_quit = false;
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

} // namespace clothlab::ui
