// The GLSL of the chosen shader, edited while the picture follows.
#include <algorithm>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/shader_editors.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

constexpr const char* new_window = "New shader###new shader";

void save(Lab& lab, const ShaderFile& file, const ShaderEditor& editor) {
    if (editor.modified)
        lab.ask(SaveShader{file.name, editor.text.GetText()});
}

bool is_taken(const Lab& lab, const std::string& name) {
    return std::any_of(lab.shaders.begin(), lab.shaders.end(),
                       [&](const scene::ShaderDeclaration& shader) { return shader.name == name; });
}

std::string free_name(const Lab& lab) {
    for (int i = 2;; ++i)
        if (std::string name = lab.scene.look.shader + "-" + std::to_string(i); !is_taken(lab, name))
            return name;
}

bool is_faulty(const ShaderWork& work, const ShaderFile& file) {
    return std::any_of(work.faults.begin(), work.faults.end(),
                       [&](const ShaderFault& fault) { return fault.file == file.file; });
}

void draw_new_window(Lab& lab, bool open) {
    ShaderEditors& editors = shader_editors(lab);
    if (open) {
        editors.new_name = free_name(lab);
        ImGui::OpenPopup(new_window);
        ImGui::SetNextWindowFocus();
    }
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(new_window, nullptr, ImGuiWindowFlags_AlwaysAutoResize))
        return;
    ImGui::Text("A copy of \"%s\", as it is now, under the name:", lab.scene.look.shader.c_str());
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 18);
    if (ImGui::IsWindowAppearing())
        ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText("##name", &editors.new_name, ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::PushStyleColor(ImGuiCol_Text, colour::faint);
    ImGui::Text("It is saved in %s", (lab.shader_work.folder / "cloth").string().c_str());
    ImGui::PopStyleColor();
    const bool taken = is_taken(lab, editors.new_name);
    ImGui::BeginDisabled(taken || editors.new_name.empty());
    const bool done = ImGui::Button("Create") || (entered && !taken);
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGuiKey_Escape))
        ImGui::CloseCurrentPopup();
    if (taken) {
        ImGui::SameLine();
        ImGui::TextColored(colour::warning, "There is a shader of this name.");
    }
    if (done) {
        lab.ask(CopyShader{lab.scene.look.shader, editors.new_name});
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

void draw_buttons(Lab& lab, const ShaderFile& file, ShaderEditor& editor) {
    const bool nowhere = lab.shader_work.folder.empty();
    ImGui::BeginDisabled(!editor.modified || nowhere);
    if (ImGui::Button(ICON_FA_FLOPPY_DISK "  Save"))
        save(lab, file, editor);
    ImGui::EndDisabled();
    if (nowhere)
        tooltip("There is no folder to save shaders in: neither HOME nor XDG_DATA_HOME is set.");
    else if (file.shipped)
        tooltip("Ctrl+S. The file that clothlab comes with stays as it is: yours becomes " +
                (lab.shader_work.folder / file.name).string() + ", which is used from then on.");
    else
        tooltip("Ctrl+S. Writes " + file.file.string());
    ImGui::SameLine();
    ImGui::BeginDisabled(!editor.modified);
    if (ImGui::Button(ICON_FA_ROTATE_LEFT "  Revert"))
        revert_shader(editor);
    ImGui::EndDisabled();
    tooltip("Back to the file's text. Undo (Ctrl+Z in the text) brings back what you typed.");
    ImGui::SameLine();
    ImGui::BeginDisabled(nowhere);
    const bool create = ImGui::Button(ICON_FA_COPY "  New shader ...");
    ImGui::EndDisabled();
    tooltip("A copy of this shader under a new name, to try things in");
    if (file.hides_shipped) {
        ImGui::SameLine();
        ImGui::BeginDisabled(editor.modified);
        if (ImGui::Button("Use the shipped file"))
            lab.ask(UseShippedShader{file.name});
        ImGui::EndDisabled();
        tooltip("This is your copy of a file that clothlab comes with. It is put aside, not deleted.");
    }
    draw_new_window(lab, create);
}

/// What the file is, at the right end of the buttons' line.
void draw_state(const ShaderFile& file, const ShaderEditor& editor) {
    const TextEditor::DocPos cursor = editor.text.GetMainCursorPosition();
    const std::string place =
        "Line " + std::to_string(cursor.line + 1) + ", column " + std::to_string(cursor.index + 1);
    const char* state = editor.conflict      ? "changed on disk, too"
                        : editor.modified    ? "not saved"
                        : file.shipped       ? "shipped"
                        : file.hides_shipped ? "your copy"
                                             : "yours";
    const float gap = 2 * ImGui::GetStyle().ItemSpacing.x;
    const float width = ImGui::CalcTextSize(state).x + gap + ImGui::CalcTextSize(place.c_str()).x;
    ImGui::SameLine();
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.f, ImGui::GetContentRegionAvail().x - width));
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(editor.conflict   ? colour::warning
                       : editor.modified ? colour::accent
                                         : colour::faint,
                       "%s", state);
    tooltip(editor.conflict ? file.file.string() + " was changed by another program while you edited it here. Save "
                                                   "writes your text over it, Revert takes the file's."
                            : file.file.string());
    ImGui::SameLine(0, gap);
    ImGui::TextColored(colour::faint, "%s", place.c_str());
}

/// The faults, to go to by a click; one line when there are none.
void draw_fault_list(Lab& lab, float height) {
    ShaderWork& work = lab.shader_work;
    if (!ImGui::BeginChild("faults", {0, height}))
        return ImGui::EndChild();
    if (work.faults.empty()) {
        ImGui::TextColored(colour::good, ICON_FA_CIRCLE_CHECK "  compiles");
        ImGui::SameLine(0, 2 * ImGui::GetStyle().ItemSpacing.x);
        ImGui::TextColored(colour::faint, "%s", work.notice.c_str());
    }
    for (std::size_t i = 0; i < work.faults.size(); ++i) {
        const ShaderFault& fault = work.faults[i];
        ImGui::PushID(static_cast<int>(i));
        ImGui::PushStyleColor(ImGuiCol_Text, colour::error);
        const std::string text = ICON_FA_TRIANGLE_EXCLAMATION "  " + place_of(work, fault) + "  " + fault.text;
        if (ImGui::Selectable((text + "###fault").c_str()))
            work.go_to = fault;
        ImGui::PopStyleColor();
        tooltip(fault.text);
        ImGui::PopID();
    }
    ImGui::EndChild();
}

void draw_file(Lab& lab, const ShaderFile& file, ShaderEditor& editor) {
    if (ImGui::Shortcut(ImGuiMod_Ctrl | ImGuiKey_S))
        save(lab, file, editor);
    draw_buttons(lab, file, editor);
    draw_state(file, editor);
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const auto lines = static_cast<float>(std::clamp<std::size_t>(lab.shader_work.faults.size(), 1, 3));
    const float list = lines * line;
    ImGui::PushFont(fonts().mono, 0);
    const bool typed = editor.text.Render(
        "text", {0, std::max(ImGui::GetContentRegionAvail().y - list - ImGui::GetStyle().ItemSpacing.y, 3 * line)});
    ImGui::PopFont();
    if (typed)
        shader_typed(editor);
    draw_fault_list(lab, list);
}

/// Brings the place that was asked for to the front, and the first file of a shader that was chosen.
void go_to_place(Lab& lab) {
    ShaderWork& work = lab.shader_work;
    ShaderEditors& editors = shader_editors(lab);
    if (editors.shader != lab.scene.look.shader) {
        editors.shader = lab.scene.look.shader;
        editors.to_front = work.files.front().name;
    }
    if (!work.go_to)
        return;
    for (const ShaderFile& file : work.files)
        if (file.file == work.go_to->file) {
            editors.to_front = file.name;
            ShaderEditor& editor = editors.by_name[file.name];
            editor.text.SetCursor({static_cast<std::size_t>(std::max(work.go_to->line - 1, 0)), 0});
            editor.text.SetFocus();
        }
    work.go_to.reset();
}

} // namespace

void draw_shader(Lab& lab) {
    ShaderWork& work = lab.shader_work;
    ShaderEditors& editors = shader_editors(lab);
    if (work.files.empty() || !editors.by_name.contains(work.files.front().name))
        return ImGui::TextDisabled("There are no files of this shader.");
    go_to_place(lab);
    if (!ImGui::BeginTabBar("files", ImGuiTabBarFlags_FittingPolicyScroll))
        return;
    for (const ShaderFile& file : work.files) {
        const auto found = editors.by_name.find(file.name);
        if (found == editors.by_name.end())
            continue; // its editor comes with the next frame
        ShaderEditor& editor = found->second;
        ImGuiTabItemFlags flags = editor.modified ? ImGuiTabItemFlags_UnsavedDocument : 0;
        if (editors.to_front == file.name)
            flags |= ImGuiTabItemFlags_SetSelected;
        const bool faulty = is_faulty(work, file);
        if (faulty)
            ImGui::PushStyleColor(ImGuiCol_Text, colour::error);
        const std::string label = std::filesystem::path(file.name).filename().string() + "###" + file.name;
        const bool shown = ImGui::BeginTabItem(label.c_str(), nullptr, flags);
        if (faulty)
            ImGui::PopStyleColor();
        tooltip(file.file.string());
        if (!shown)
            continue;
        if (editors.to_front == file.name)
            editors.to_front.clear();
        ImGui::PushID(file.name.c_str());
        draw_file(lab, file, editor);
        ImGui::PopID();
        ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
}

} // namespace clothlab::ui
