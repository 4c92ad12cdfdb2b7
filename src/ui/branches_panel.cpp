// The branches: what each changed, from when to when; switching, naming, comparing, deleting.
#include <algorithm>
#include <cstdio>
#include <imgui.h>

#include "ui/change_text.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/timeline_parts.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

using timeline::BranchInfo;

void wrapped(const ImVec4& tint, const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, tint);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

double fork_time(const timeline::Overview& o, const BranchInfo& b) {
    // Where its line is shown, exactly; elsewhere by the rate of the frames.
    if (on_line(o, {b.id, b.fork_step}))
        return FrameAxis(o, {}).time_of(static_cast<double>(b.fork_frame));
    return b.end_time - static_cast<double>(b.end_frame - b.fork_frame) / o.frames_per_second;
}

std::string range_text(const timeline::Overview& o, const BranchInfo& b) {
    char text[160];
    std::snprintf(text, sizeof text, "%.2f to %.2f s (frames %llu to %llu), %s", fork_time(o, b), b.end_time,
                  static_cast<unsigned long long>(b.fork_frame), static_cast<unsigned long long>(b.end_frame),
                  megabytes(b.memory + b.on_disk).c_str());
    return text;
}

void ghost_lines(const Lab& lab) {
    const TimelineWork& t = lab.timeline;
    char text[96];
    if (t.ghost_distance)
        std::snprintf(text, sizeof text, "Now %.3g mm away (RMS), %.3g mm at most", 1000 * t.ghost_distance->rms,
                      1000 * t.ghost_distance->max);
    else
        std::snprintf(text, sizeof text, "This branch has nothing at the present time.");
    wrapped(colour::good, text);
    if (t.ghost_progress < 1) {
        std::snprintf(text, sizeof text, "Curve: %.0f %%", 100 * t.ghost_progress);
        ImGui::ProgressBar(static_cast<float>(t.ghost_progress), {-1, 0}, text);
    }
}

/// Asks before a branch is deleted.
void deletion(Lab& lab, const BranchInfo& b, bool wanted) {
    if (wanted)
        ImGui::OpenPopup("Delete branch###delete");
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal("Delete branch###delete", nullptr, ImGuiWindowFlags_AlwaysAutoResize))
        return;
    const bool parent = std::any_of(lab.timeline.overview->branches.begin(), lab.timeline.overview->branches.end(),
                                    [&](const BranchInfo& other) { return other.parent == b.id; });
    ImGui::Text("Delete \"%s\" with its bookmarks? This cannot be undone.", b.name.c_str());
    if (parent)
        ImGui::TextUnformatted("What other branches begin with stays.");
    if (ImGui::Button("Delete###yes")) {
        ask_timeline(lab, RemoveBranch{b.id});
        ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGuiKey_Escape))
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

void row(Lab& lab, const timeline::Overview& o, const BranchInfo& b) {
    const float font = ImGui::GetFontSize(), side = ImGui::GetFrameHeight();
    const bool shown = b.id == o.line, ghost = lab.timeline.ghost == b.id;
    const float indent = font * 0.9f * static_cast<float>(std::min(b.depth, 6));
    if (indent > 0)
        ImGui::Indent(indent);
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(shown ? colour::accent : colour::faint, "%s",
                       b.depth == 0 ? ICON_FA_CIRCLE_PLAY : ICON_FA_CODE_BRANCH);
    ImGui::SameLine();
    if (b.stem) {
        wrapped(colour::faint, "Deleted, but other branches begin with it");
        wrapped(colour::faint, range_text(o, b));
        if (indent > 0)
            ImGui::Unindent(indent);
        return;
    }
    bool remove = false;
    std::optional<std::string> name;
    const float spacing = ImGui::GetStyle().ItemSpacing.x;
    const float width = std::max(ImGui::GetContentRegionAvail().x - 2 * side - 2 * spacing, font);
    ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, {0, 0.5f});
    const bool clicked = editable_name(lab, true, b.id, b.name, shown, width, name);
    ImGui::PopStyleVar();
    if (clicked && !shown)
        ask_timeline(lab, SwitchBranch{b.id});
    if (ImGui::BeginPopupContextItem("branch")) {
        if (ImGui::MenuItem("Show this branch", nullptr, false, !shown))
            ask_timeline(lab, SwitchBranch{b.id});
        if (ImGui::MenuItem("Rename"))
            begin_renaming(lab, true, b.id, b.name);
        if (ImGui::MenuItem("Delete ..."))
            remove = true;
        ImGui::EndPopup();
    } else
        tooltip(shown ? "The branch that is shown. A double click renames it."
                      : "A click shows this branch at the same step; a double click renames it.");
    if (name)
        ask_timeline(lab, RenameBranch{b.id, *name});
    ImGui::SameLine();
    if (ghost)
        ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.68f, 0.32f, 0.21f, 1));
    if (icon_button(ICON_FA_GHOST, "##ghost",
                    shown ? "The branch that is shown cannot be its own ghost"
                          : "Draws this branch over the one that is shown, at the same time, and measures the distance",
                    !shown || ghost))
        ask_timeline(lab, ShowGhost{ghost ? 0 : b.id});
    if (ghost)
        ImGui::PopStyleColor();
    ImGui::SameLine();
    if (icon_button(ICON_FA_TRASH, "##delete", "Deletes this branch"))
        remove = true;
    deletion(lab, b, remove);
    if (b.before && b.after)
        wrapped(colour::text, describe_change(*b.before, *b.after));
    wrapped(colour::faint, range_text(o, b));
    if (ghost)
        ghost_lines(lab);
    if (indent > 0)
        ImGui::Unindent(indent);
}

} // namespace

void draw_branches(Lab& lab) {
    const std::shared_ptr<const timeline::Overview> overview = lab.timeline.overview;
    if (!overview)
        return;
    for (const BranchInfo& b : overview->branches) {
        ImGui::PushID(static_cast<int>(b.id));
        row(lab, *overview, b);
        ImGui::PopID();
        ImGui::Spacing();
    }
    if (overview->branches.size() < 2)
        wrapped(colour::faint, "Go back in time and change a parameter: a new branch begins there, and this one stays "
                               "to be compared with it. Restart begins one, too.");
}

} // namespace clothlab::ui
