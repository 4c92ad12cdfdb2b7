// A name in a list that can be edited in its place.
#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/timeline_parts.h"

namespace clothlab::ui {

void begin_renaming(Lab& lab, bool branch, std::uint32_t id, const std::string& name) {
    lab.timeline_view.renaming = Renaming{branch, id, name};
}

bool editable_name(Lab& lab, bool branch, std::uint32_t id, const std::string& name, bool selected, float width,
                   std::optional<std::string>& done) {
    std::optional<Renaming>& renaming = lab.timeline_view.renaming;
    if (!renaming || renaming->branch != branch || renaming->id != id) {
        const bool clicked =
            ImGui::Selectable((name + "###name").c_str(), selected, ImGuiSelectableFlags_AllowDoubleClick, {width, 0});
        if (!clicked)
            return false;
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
            begin_renaming(lab, branch, id, name);
            return false;
        }
        return true;
    }
    ImGui::SetNextItemWidth(width);
    if (!renaming->focused)
        ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText("##rename", &renaming->text,
                                          ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    if (ImGui::IsItemActive())
        renaming->focused = true;
    const bool escaped = ImGui::IsKeyPressed(ImGuiKey_Escape);
    if (entered || (renaming->focused && ImGui::IsItemDeactivated())) {
        if (!escaped && !renaming->text.empty() && renaming->text != name)
            done = renaming->text;
        renaming.reset();
    }
    return false;
}

} // namespace clothlab::ui
