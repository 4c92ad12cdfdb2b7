// Windows of the File menu that concern the timeline: saving and opening recordings, exporting meshes.
#include <algorithm>
#include <imgui.h>
#include <imgui_stdlib.h>
#include <utility>

#include "timeline/recording.h"
#include "ui/icons.h"
#include "ui/theme.h"
#include "ui/timeline_parts.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

namespace fs = std::filesystem;

constexpr const char* save_window = "Save recording###save recording";
constexpr const char* open_window = "Open recording###open recording";
constexpr const char* export_window = "Export meshes###export meshes";

bool begin_window(const char* window, bool wanted) {
    if (wanted) {
        ImGui::OpenPopup(window);
        ImGui::SetNextWindowFocus();
    }
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
    return ImGui::BeginPopupModal(window, nullptr, ImGuiWindowFlags_AlwaysAutoResize);
}

void cancel_button() {
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGuiKey_Escape))
        ImGui::CloseCurrentPopup();
}

/// A text field for a path, which has the keyboard at first.
bool path_field(const char* id, std::string& path) {
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 30);
    if (ImGui::IsWindowAppearing())
        ImGui::SetKeyboardFocusHere();
    return ImGui::InputText(id, &path, ImGuiInputTextFlags_EnterReturnsTrue);
}

fs::path with_suffix(const std::string& text) {
    fs::path path = text;
    if (path.extension() != timeline::recording_suffix)
        path += timeline::recording_suffix;
    return path;
}

std::string name_of(const Lab& lab) {
    const std::string stem = lab.file.stem().string();
    return stem.empty() ? "cloth" : stem;
}

void save_recording_window(Lab& lab, bool wanted) {
    TimelineView::Files& files = lab.timeline_view.files;
    if (wanted && files.path.empty())
        files.path = name_of(lab) + timeline::recording_suffix;
    if (!begin_window(save_window, wanted))
        return;
    ImGui::TextUnformatted("Save the whole timeline as:");
    const bool entered = path_field("##path", files.path);
    const fs::path file = with_suffix(files.path);
    std::error_code error;
    const bool replaces = !files.path.empty() && fs::exists(file, error);
    if (replaces)
        ImGui::TextColored(colour::warning, ICON_FA_TRIANGLE_EXCLAMATION "  This file exists and would be replaced.");
    ImGui::BeginDisabled(files.path.empty() || lab.timeline.job.has_value());
    // Enter alone never replaces another file.
    const bool done = ImGui::Button(replaces ? "Replace###done" : "Save###done") || (entered && !replaces);
    ImGui::EndDisabled();
    if (lab.timeline.job)
        tooltip("Another file is being written.");
    cancel_button();
    if (done && !files.path.empty() && !lab.timeline.job) {
        ask_timeline(lab, SaveRecording{file, replaces});
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

void open_recording_window(Lab& lab, bool wanted) {
    TimelineView::Files& files = lab.timeline_view.files;
    if (!begin_window(open_window, wanted))
        return;
    ImGui::Text("Open a recording (%s). It takes the place of the present timeline.", timeline::recording_suffix);
    const bool entered = path_field("##path", files.path);
    const bool done = ImGui::Button("Open###done") || entered;
    cancel_button();
    if (done && !files.path.empty()) {
        lab.ask(OpenScene{with_suffix(files.path)});
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

void export_meshes_window(Lab& lab, bool wanted) {
    TimelineView::Files& files = lab.timeline_view.files;
    if (wanted && files.folder.empty())
        files.folder = name_of(lab) + "-meshes";
    if (!begin_window(export_window, wanted))
        return;
    ImGui::TextUnformatted("One file for each frame, in the folder:");
    path_field("##folder", files.folder);
    if (ImGui::RadioButton("OBJ", !files.ply))
        files.ply = false;
    tooltip("Text that every program reads");
    ImGui::SameLine();
    if (ImGui::RadioButton("PLY", files.ply))
        files.ply = true;
    tooltip("Smaller: the coordinates as binary numbers");
    const timeline::FrameRange all{0, lab.timeline.overview ? lab.timeline.overview->end_frame : 0};
    const auto& loop = lab.timeline.loop;
    if (ImGui::RadioButton(("All frames, 0 to " + std::to_string(all.last) + "###all").c_str(),
                           !files.loop_only || !loop))
        files.loop_only = false;
    ImGui::BeginDisabled(!loop.has_value());
    const std::string title =
        loop ? "The loop, " + std::to_string(loop->first) + " to " + std::to_string(loop->last) : "The loop (none)";
    if (ImGui::RadioButton((title + "###loop").c_str(), files.loop_only && loop))
        files.loop_only = true;
    ImGui::EndDisabled();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 6);
    ImGui::InputInt("Every so many frames", &files.every);
    files.every = std::clamp(files.every, 1, 100000);
    const timeline::FrameRange range = files.loop_only && loop ? *loop : all;
    const std::uint64_t count = (range.last - range.first) / static_cast<std::uint64_t>(files.every) + 1;
    ImGui::TextColored(colour::faint, "%llu files; frames that are no longer in the cache are left out.",
                       static_cast<unsigned long long>(count));
    ImGui::BeginDisabled(files.folder.empty() || lab.timeline.job.has_value());
    if (ImGui::Button("Export###done")) {
        ask_timeline(lab, ExportMeshes{files.folder, files.ply ? timeline::MeshFormat::ply : timeline::MeshFormat::obj,
                                       range, files.every});
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndDisabled();
    cancel_button();
    ImGui::EndPopup();
}

} // namespace

void draw_recording_windows(Lab& lab) {
    TimelineView::Files& files = lab.timeline_view.files;
    save_recording_window(lab, std::exchange(files.save, false));
    open_recording_window(lab, std::exchange(files.open, false));
    export_meshes_window(lab, std::exchange(files.exporting, false));
}

void draw_job(Lab& lab) {
    if (!lab.timeline.job)
        return;
    const TimelineWork::Job& job = *lab.timeline.job;
    const ImGuiViewport* screen = ImGui::GetMainViewport();
    const float font = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({screen->WorkPos.x + screen->WorkSize.x / 2, screen->WorkPos.y + font * 2},
                            ImGuiCond_Appearing, {0.5f, 0});
    const bool visible =
        ImGui::Begin("Working###job", nullptr,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoDocking | ImGuiWindowFlags_NoCollapse |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    if (visible) {
        ImGui::TextUnformatted(job.what.c_str());
        ImGui::ProgressBar(static_cast<float>(job.share), {font * 18, 0});
        ImGui::SameLine();
        if (ImGui::Button("Cancel"))
            ask_timeline(lab, CancelSaving{});
        tooltip("Stops it. A file that was there before stays as it was.");
    }
    ImGui::End();
}

} // namespace clothlab::ui
