// The scenes that clothlab comes with, and the one that is open.
#include <imgui.h>

#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace clothlab::ui {

void draw_scenes(Lab& lab) {
    ImGui::PushFont(fonts().bold, 0);
    ImGui::TextUnformatted(lab.scene.name.empty() ? "Untitled" : lab.scene.name.c_str());
    ImGui::PopFont();
    tooltip(lab.file.string());
    if (modified(lab)) {
        ImGui::SameLine();
        ImGui::TextColored(colour::accent, "changed");
        tooltip(
            "Some parameters differ from the file: they are marked in colour in the Parameters panel. Save keeps them, "
            "and Reset brings the file's values back.");
    }
    if (!lab.scene.description.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, colour::faint);
        ImGui::TextWrapped("%s", lab.scene.description.c_str());
        ImGui::PopStyleColor();
    }
    ImGui::BeginDisabled(!modified(lab));
    if (ImGui::Button(ICON_FA_ROTATE_LEFT "  Reset parameters")) {
        const auto camera = lab.scene.camera;
        lab.scene = lab.loaded;
        lab.scene.camera = camera;
    }
    ImGui::EndDisabled();

    ImGui::SeparatorText("Scenes");
    if (!ImGui::BeginChild("list"))
        return ImGui::EndChild();
    for (const SceneEntry& entry : lab.scenes) {
        ImGui::PushID(&entry); // names may repeat
        if (ImGui::Selectable(entry.name.c_str(), entry.file == lab.file))
            lab.ask(OpenScene{entry.file});
        tooltip(entry.description);
        ImGui::PopID();
    }
    ImGui::EndChild();
}

} // namespace clothlab::ui
