// Moments worth going to: bookmarks, events that the run found by itself, and breakpoints.
#include <cstdio>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/breakpoint_rows.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/timeline_parts.h"
#include "ui/track_places.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

void faint(const char* text) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour::faint);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

const char* branch_name(const timeline::Overview& o, timeline::BranchId id) {
    for (const timeline::BranchInfo& b : o.branches)
        if (b.id == id)
            return b.name.c_str();
    return "";
}

void bookmark_row(Lab& lab, const timeline::Overview& o, const timeline::Bookmark& b) {
    const float side = ImGui::GetFrameHeight(), spacing = ImGui::GetStyle().ItemSpacing.x;
    bool go = icon_button(ICON_FA_FLAG, "##go",
                          b.camera ? "To this moment, with the camera that it was marked with" : "To this moment");
    ImGui::SameLine();
    char where[160];
    std::snprintf(where, sizeof where, "%llu + %d", static_cast<unsigned long long>(b.frame), b.substep);
    const float where_width = ImGui::CalcTextSize(where).x;
    const float width = std::max(ImGui::GetContentRegionAvail().x - where_width - side - 2 * spacing, side);
    std::optional<std::string> name;
    ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, {0, 0.5f});
    go = editable_name(lab, false, b.id, b.name, b.moment == lab.timeline.playhead.moment, width, name) || go;
    ImGui::PopStyleVar();
    if (ImGui::BeginPopupContextItem("bookmark")) {
        if (ImGui::MenuItem("Rename"))
            begin_renaming(lab, false, b.id, b.name);
        ImGui::EndPopup();
    } else
        tooltip("A click goes there, a double click renames it. It is on the branch \"" +
                std::string(branch_name(o, b.moment.branch)) + "\".");
    if (name)
        ask_timeline(lab, RenameBookmark{b.id, *name});
    if (go)
        ask_timeline(lab, GoToMoment{b.moment, b.camera});
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(colour::faint, "%s", where);
    tooltip("Frame + substeps");
    ImGui::SameLine();
    if (icon_button(ICON_FA_TRASH, "##delete", "Removes the bookmark; the moment stays"))
        ask_timeline(lab, RemoveBookmark{b.id});
}

void bookmarks(Lab& lab, const timeline::Overview& o) {
    ImGui::SeparatorText("Bookmarks");
    for (const timeline::Bookmark& b : o.bookmarks) {
        ImGui::PushID(static_cast<int>(b.id));
        bookmark_row(lab, o, b);
        ImGui::PopID();
    }
    TimelineView& view = lab.timeline_view;
    const char* add = ICON_FA_PLUS "  Add###add";
    const float button = ImGui::CalcTextSize(ICON_FA_PLUS "  Add").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x,
                                     ImGui::GetFontSize() * 3));
    const bool entered = ImGui::InputTextWithHint("##name", "a name for this moment", &view.bookmark_name,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    if (ImGui::Button(add) || entered) {
        ask_timeline(lab, AddBookmark{view.bookmark_name});
        view.bookmark_name.clear();
    }
    tooltip("Marks the present moment with the present camera (M). Its state is kept longest.");
}

void events(Lab& lab, const timeline::Overview& o) {
    ImGui::SeparatorText("Events");
    if (o.marks.empty())
        faint("First contacts, the stretch limit at work, the most strain, jitter and blow-up are marked here when the "
              "run comes to them.");
    for (std::size_t i = 0; i < o.marks.size(); ++i) {
        const timeline::MarkInfo& mark = o.marks[i];
        const MarkLook look = look_of(mark.kind);
        ImGui::PushID(static_cast<int>(i));
        char title[96];
        std::snprintf(title, sizeof title, "frame %llu  %s###event", static_cast<unsigned long long>(mark.frame),
                      timeline::mark_names[static_cast<std::size_t>(mark.kind)]);
        ImGui::TextColored(look.colour, "%s", look.icon);
        ImGui::SameLine();
        if (ImGui::Selectable(title, mark.step == lab.timeline.playhead.moment.step))
            ask_timeline(lab, GoToMoment{{o.line, mark.step}, {}});
        tooltip("To the end of the step that brought it. Previous and next: , and .");
        ImGui::Indent(ImGui::GetFontSize() * 1.6f);
        faint(mark.text.c_str());
        ImGui::Unindent(ImGui::GetFontSize() * 1.6f);
        ImGui::PopID();
    }
}

} // namespace

void draw_moments(Lab& lab) {
    const std::shared_ptr<const timeline::Overview> overview = lab.timeline.overview;
    if (!overview)
        return;
    ImGui::PushID("bookmarks");
    bookmarks(lab, *overview);
    ImGui::PopID();
    ImGui::PushID("events");
    events(lab, *overview);
    ImGui::PopID();
    ImGui::PushID("breakpoints");
    draw_breakpoints(lab);
    ImGui::PopID();
}

} // namespace clothlab::ui
