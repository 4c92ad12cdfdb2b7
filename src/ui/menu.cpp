// The menu, the keys of the whole window, and the help on them.
#include <cstring>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/camera.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/timeline_parts.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

constexpr const char* path_window = "Scene file###path";
constexpr const char* help_window = "Keys###help";

/// A path can always be typed; a file dialog of the system is there on most desktops but not on all.
void draw_path_window(Lab& lab, bool open, bool save) {
    // What is typed stays between frames while the window is open.
    static struct {
        std::string text;
        bool save = false;
    } typed;
    if (open || save) {
        typed.text = lab.file.string();
        typed.save = save;
        ImGui::OpenPopup(path_window);
        ImGui::SetNextWindowFocus(); // in front, also while no window has the focus yet
    }
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(path_window, nullptr, ImGuiWindowFlags_AlwaysAutoResize))
        return;
    ImGui::TextUnformatted(typed.save ? "Save the scene as:"
                                      : "Open a scene file (the course's format, or clothlab's):");
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 32);
    if (ImGui::IsWindowAppearing())
        ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText("##path", &typed.text, ImGuiInputTextFlags_EnterReturnsTrue);
    std::error_code error;
    const bool replaces = typed.save && typed.text != lab.file.string() && std::filesystem::exists(typed.text, error);
    if (replaces)
        ImGui::TextColored(colour::warning, ICON_FA_TRIANGLE_EXCLAMATION "  This file exists and would be replaced.");
    // Enter alone never replaces another file.
    const bool done = ImGui::Button(!typed.save ? "Open###done"
                                    : replaces  ? "Replace###done"
                                                : "Save###done") ||
                      (entered && !replaces);
    ImGui::SameLine();
    if (lab.has_file_dialogs) {
        if (ImGui::Button("Browse ...")) {
            lab.ask(BrowseForScene{typed.save});
            ImGui::CloseCurrentPopup();
        }
        ImGui::SameLine();
    }
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGuiKey_Escape))
        ImGui::CloseCurrentPopup();
    if (done && !typed.text.empty()) {
        if (typed.save)
            lab.ask(SaveScene{typed.text});
        else
            lab.ask(OpenScene{typed.text});
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

void draw_help_window(bool open) {
    if (open) {
        ImGui::OpenPopup(help_window);
        ImGui::SetNextWindowFocus();
    }
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(help_window, nullptr, ImGuiWindowFlags_AlwaysAutoResize))
        return;
    if (ImGui::BeginTable("keys", 2)) {
        for (const Shortcut& s : shortcuts()) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            mono_text("%s", s.keys);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(s.what);
        }
        ImGui::EndTable();
    }
    if (ImGui::Button("Close") || ImGui::IsKeyPressed(ImGuiKey_Escape))
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

/// What menu entries and keys set off in windows of this file.
struct Windows {
    bool open = false, save = false, help = false;
};

void save(Lab& lab, Windows& windows) {
    // The scenes that clothlab comes with are not written over by a key.
    bool shipped = false;
    for (const SceneEntry& entry : lab.scenes)
        shipped = shipped || entry.file == lab.file;
    if (lab.file.empty() || shipped)
        windows.save = true;
    else
        lab.ask(SaveScene{lab.file});
}

void file_menu(Lab& lab, Windows& windows) {
    if (ImGui::MenuItem(ICON_FA_FOLDER_OPEN "  Open ...", "Ctrl+O"))
        windows.open = true;
    if (ImGui::BeginMenu(ICON_FA_SHAPES "  Open scene")) {
        for (const SceneEntry& entry : lab.scenes) {
            if (ImGui::MenuItem(entry.name.c_str(), nullptr, entry.file == lab.file))
                lab.ask(OpenScene{entry.file});
            tooltip(entry.description);
        }
        ImGui::EndMenu();
    }
    if (ImGui::MenuItem(ICON_FA_FLOPPY_DISK "  Save", "Ctrl+S"))
        save(lab, windows);
    if (ImGui::MenuItem(ICON_FA_FILE_EXPORT "  Save as ...", "Ctrl+Shift+S"))
        windows.save = true;
    ImGui::Separator();
    TimelineView::Files& files = lab.timeline_view.files;
    if (ImGui::MenuItem(ICON_FA_CIRCLE_DOT "  Save recording ...", nullptr, false, lab.timeline.overview != nullptr))
        files.save = true;
    tooltip("The whole timeline with its branches, bookmarks and states, to look at without computing it again");
    if (ImGui::MenuItem(ICON_FA_FOLDER_OPEN "  Open recording ..."))
        files.open = true;
    if (ImGui::MenuItem(ICON_FA_CUBES "  Export meshes ...", nullptr, false, lab.timeline.overview != nullptr))
        files.exporting = true;
    tooltip("A mesh file for each frame of a range");
    ImGui::Separator();
    if (ImGui::MenuItem(ICON_FA_CAMERA "  Save a picture", "F12"))
        lab.ask(TakePicture{});
    tooltip("Of the viewport, or as the Output window is set, under the next free name");
    ImGui::MenuItem(ICON_FA_PHOTO_FILM "  Pictures and films ...", "Shift+F12", &lab.output.open);
    if (ImGui::MenuItem(ICON_FA_FILE_LINES "  Write a report ...", nullptr, false, lab.timeline.overview != nullptr))
        lab.experiments.files.report = true;
    tooltip(
        "A folder with an HTML and a Markdown page: parameters, pictures, curves, tables, and the commands to get it "
        "all again");
    ImGui::Separator();
    if (ImGui::MenuItem(ICON_FA_POWER_OFF "  Quit", "Ctrl+Q"))
        lab.ask(Quit{});
}

void view_menu(Lab& lab) {
    std::size_t index = 0;
#define CLOTHLAB_PANEL(id, title, icon, at_start) ImGui::MenuItem(icon "  " title, nullptr, &lab.open[index++]);
#include "ui/panels.def"
#undef CLOTHLAB_PANEL
    ImGui::Separator();
    if (ImGui::MenuItem(ICON_FA_TABLE_COLUMNS "  Default layout"))
        lab.ask(ResetLayout{});
}

void window_keys(Lab& lab, Windows& windows) {
    if (window_key(ImGuiMod_Ctrl | ImGuiKey_O))
        windows.open = true;
    if (window_key(ImGuiMod_Ctrl | ImGuiKey_S))
        save(lab, windows);
    if (window_key(ImGuiMod_Ctrl | ImGuiMod_Shift | ImGuiKey_S))
        windows.save = true;
    if (window_key(ImGuiKey_F1))
        windows.help = true;
}

} // namespace

bool window_key(ImGuiKeyChord chord, ImGuiInputFlags flags) {
    // ImGui holds letters back from shortcuts for its own text fields only, not for the text editor.
    const ImGuiKeyChord k = chord & ~ImGuiMod_Mask_;
    const bool function_key = k >= ImGuiKey_F1 && k <= ImGuiKey_F24;
    if (ImGui::GetIO().WantTextInput && (chord & ImGuiMod_Ctrl) == 0 && !function_key)
        return false;
    return ImGui::Shortcut(chord, ImGuiInputFlags_RouteGlobal | flags);
}

const std::vector<Shortcut>& shortcuts() {
    static const std::vector<Shortcut> list{
        {"Space, P", "play or pause"},
        {"B", "play backwards or pause"},
        {"Right or N, Left", "one frame further, one frame back"},
        {"Shift+Right or Shift+N, Shift+Left", "one substep further, one substep back"},
        {"Home, End", "to the start of the run, to the last moment that was computed"},
        {"L, [ and ]", "loop on or off, its first and its last frame at the playhead"},
        {"-, =", "slower, faster"},
        {"M", "bookmark this moment"},
        {", and .", "previous and next bookmark or event"},
        {"Ctrl+Left, Ctrl+Right", "the stages of a step, while Inside a step is seen"},
        {"Shift+click", "pick a point, while Inside a step is seen"},
        {"R", "restart: a new run with the present parameters"},
        {"W", "wireframe or shaded"},
        {"F, double click", "show the whole scene"},
        {"Shift+F", "show the cloth as it is now"},
        {"1, Shift+1, 3, Shift+3, 7", "look from the front, back, right, left, top; on the keypad too"},
        {"9, 0", "three-quarter view, and the scene's own"},
        {"5", "orthographic or perspective"},
        {"Ctrl+Shift+C, Ctrl+Shift+V", "copy and paste the camera as JSON"},
        {"left drag", "turn the camera"},
        {"right drag, Shift+left drag", "move the camera"},
        {"wheel", "nearer or further away"},
        {"Ctrl+click on a slider", "type a value, also beyond its range"},
        {"Ctrl+Z, Ctrl+Shift+Z", "undo and redo a change of parameters"},
        {"Ctrl+O, Ctrl+S, Ctrl+Shift+S", "open, save, save as"},
        {"Ctrl+S, Ctrl+Z, Ctrl+F in Shader", "save, undo, find in the shader's text"},
        {"F12", "save a picture under the next free name"},
        {"Shift+F12", "pictures and films: size, background, recording"},
        {"F1", "these keys"},
        {"Ctrl+Q", "quit"},
    };
    return list;
}

void handle_keys(Lab& lab) {
    if (ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel))
        return;
    timeline_keys(lab);
    if (window_key(ImGuiKey_W)) {
        std::string& shader = lab.scene.look.shader;
        if (shader != "wireframe")
            lab.shader_before = shader;
        shader = shader == "wireframe" ? lab.shader_before : "wireframe";
    }
    camera_keys(lab);
    if (window_key(ImGuiMod_Ctrl | ImGuiKey_Z, ImGuiInputFlags_Repeat))
        lab.ask(Undo{});
    if (window_key(ImGuiMod_Ctrl | ImGuiMod_Shift | ImGuiKey_Z, ImGuiInputFlags_Repeat) ||
        window_key(ImGuiMod_Ctrl | ImGuiKey_Y, ImGuiInputFlags_Repeat))
        lab.ask(Redo{});
    output_keys(lab);
    if (window_key(ImGuiMod_Ctrl | ImGuiKey_Q))
        lab.ask(Quit{});
}

void draw_menu(Lab& lab) {
    Windows windows;
    window_keys(lab, windows);
    if (ImGui::BeginMainMenuBar()) {
        if (ImGui::BeginMenu("File")) {
            file_menu(lab, windows);
            ImGui::EndMenu();
        }
        if (ImGui::BeginMenu("Edit")) {
            if (ImGui::MenuItem("Undo", "Ctrl+Z", false, lab.can_undo))
                lab.ask(Undo{});
            if (ImGui::MenuItem("Redo", "Ctrl+Shift+Z", false, lab.can_redo))
                lab.ask(Redo{});
            ImGui::EndMenu();
        }
        if (ImGui::BeginMenu("View")) {
            view_menu(lab);
            ImGui::EndMenu();
        }
        if (ImGui::BeginMenu("Experiments")) {
            experiments_menu(lab);
            ImGui::EndMenu();
        }
        if (ImGui::BeginMenu("Help")) {
            if (ImGui::MenuItem("Keys", "F1"))
                windows.help = true;
            ImGui::EndMenu();
        }
        ImGui::EndMainMenuBar();
    }
    draw_path_window(lab, windows.open, windows.save);
    draw_recording_windows(lab);
    draw_experiment_windows(lab);
    draw_help_window(windows.help);
}

} // namespace clothlab::ui
