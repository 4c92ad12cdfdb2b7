#include "ui/breakpoint_rows.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>

#include "ui/icons.h"
#include "ui/theme.h"
#include "ui/timeline_parts.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

using timeline::Breakpoint;
using timeline::BreakpointKind;

bool kind_combo(Breakpoint& b) {
    const auto& info = timeline::breakpoint_info();
    const auto now = static_cast<std::size_t>(b.kind);
    bool chosen = false;
    if (ImGui::BeginCombo("##kind", info[now].name)) {
        for (std::size_t i = 0; i < info.size(); ++i) {
            if (ImGui::Selectable(info[i].name, i == now) && i != now) {
                b.kind = static_cast<BreakpointKind>(i);
                b.value = info[i].value;
                chosen = true;
            }
            tooltip(info[i].help);
        }
        ImGui::EndCombo();
    }
    tooltip(info[now].help);
    return chosen;
}

bool has_value(BreakpointKind kind) {
    return *shown_value(kind).unit != '\0';
}

bool has_point(BreakpointKind kind) {
    return kind == BreakpointKind::point_rises || kind == BreakpointKind::point_falls;
}

bool value_field(Breakpoint& b) {
    const ShownValue shown = shown_value(b.kind);
    double value = b.value * shown.factor;
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 5.5f);
    const std::string format = format_with_unit("%.4g", shown.unit);
    const bool edited = ImGui::InputDouble("##value", &value, 0, 0, format.c_str());
    tooltip("Where it pauses");
    // By dividing, so that 5 % is 0.05.
    const double kept = value / shown.factor;
    if (!edited || !std::isfinite(kept) || kept == b.value)
        return false;
    b.value = kept;
    return true;
}

bool point_fields(Breakpoint& b, const sim::Cloth& cloth) {
    int point[2] = {b.point[0], b.point[1]};
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 5);
    const bool edited = ImGui::InputInt2("##point", point);
    tooltip("Column and row of the point, from 0");
    const sim::GridPoint kept{std::clamp(point[0], 0, cloth.num_width_points - 1),
                              std::clamp(point[1], 0, cloth.num_height_points - 1)};
    if (!edited || kept == b.point)
        return false;
    b.point = kept;
    return true;
}

/// Before or after the step that makes the condition true.
bool side_combo(Breakpoint& b) {
    bool edited = false;
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 7.2f);
    if (ImGui::BeginCombo("##side", b.before ? "before the step" : "after the step")) {
        for (const bool before : {true, false})
            if (ImGui::Selectable(before ? "before the step" : "after the step", b.before == before)) {
                edited = b.before != before;
                b.before = before;
            }
        ImGui::EndCombo();
    }
    tooltip("Whether it pauses before the step that makes the condition true, or after it");
    return edited;
}

/// Goes on in the same line if there is room.
void next_to(float width, float right) {
    if (ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width <= right)
        ImGui::SameLine();
}

enum class Edit { none, changed, removed };

Edit row(Breakpoint& b, const sim::Cloth& cloth, bool hit) {
    const float font = ImGui::GetFontSize(), side = ImGui::GetFrameHeight();
    Edit edit = Edit::none;
    const ImVec2 top = ImGui::GetCursorScreenPos();
    const float right = top.x + ImGui::GetContentRegionAvail().x;
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->ChannelsSplit(2);
    list->ChannelsSetCurrent(1);
    if (ImGui::Checkbox("##on", &b.on))
        edit = Edit::changed;
    tooltip("Whether the run pauses here");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(
        std::max(ImGui::GetContentRegionAvail().x - side - ImGui::GetStyle().ItemSpacing.x, font * 3));
    if (kind_combo(b))
        edit = Edit::changed;
    ImGui::SameLine();
    if (icon_button(ICON_FA_TRASH, "##remove", "Removes this breakpoint"))
        edit = Edit::removed;
    const float indent = side + ImGui::GetStyle().ItemSpacing.x;
    ImGui::Indent(indent);
    bool first = true;
    const auto place = [&](float width) {
        if (!first)
            next_to(width, right);
        first = false;
    };
    if (has_value(b.kind)) {
        place(font * 5.5f);
        if (value_field(b) && edit == Edit::none)
            edit = Edit::changed;
    }
    if (has_point(b.kind)) {
        place(font * 5);
        if (point_fields(b, cloth) && edit == Edit::none)
            edit = Edit::changed;
    }
    place(font * 7.2f);
    if (side_combo(b) && edit == Edit::none)
        edit = Edit::changed;
    ImGui::Unindent(indent);
    list->ChannelsSetCurrent(0);
    if (hit)
        list->AddRectFilled({top.x - font * 0.25f, top.y - font * 0.15f},
                            {right + font * 0.25f, ImGui::GetItemRectMax().y + font * 0.15f},
                            ImGui::GetColorU32(ImVec4(colour::accent.x, colour::accent.y, colour::accent.z, 0.3f)), 4);
    list->ChannelsMerge();
    return edit;
}

} // namespace

ShownValue shown_value(BreakpointKind kind) {
    const char* unit = timeline::breakpoint_info()[static_cast<std::size_t>(kind)].unit;
    return {*unit == '%' ? 100.0 : 1.0, unit};
}

void draw_breakpoints(Lab& lab) {
    ImGui::SeparatorText("Breakpoints");
    const TimelineWork& work = lab.timeline;
    if (work.hit && *work.hit < work.breakpoints.size()) {
        const Breakpoint& b = work.breakpoints[*work.hit];
        ImGui::PushStyleColor(ImGuiCol_Text, colour::accent);
        ImGui::PushTextWrapPos(0);
        ImGui::TextUnformatted(
            (std::string(ICON_FA_CIRCLE_PAUSE "  Paused ") +
             (b.before ? "before the step that makes it true: " : "after the step that made it true: ") +
             timeline::describe(b) + ".")
                .c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
    }
    std::vector<Breakpoint> list = work.breakpoints;
    bool changed = false;
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < list.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const Edit edit = row(list[i], lab.scene.simulation.cloth, work.hit == i);
        changed = changed || edit != Edit::none;
        if (edit == Edit::removed)
            removed = i;
        ImGui::PopID();
    }
    if (removed)
        list.erase(list.begin() + static_cast<std::ptrdiff_t>(*removed));
    if (ImGui::Button(ICON_FA_PLUS "  Add a breakpoint###add")) {
        list.push_back({BreakpointKind::max_strain, timeline::breakpoint_info()[0].value});
        changed = true;
    }
    tooltip("Pauses the run when a condition becomes true, wherever the run is rewound to and played again");
    if (changed)
        ask_timeline(lab, SetBreakpoints{std::move(list)});
}

} // namespace clothlab::ui
