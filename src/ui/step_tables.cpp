#include "ui/step_tables.h"

#include <cmath>
#include <cstdio>
#include <string>

#include "ui/step_view.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

double force_on(const sim::StepTrace& trace, std::size_t i) {
    return std::hypot(static_cast<double>(trace.force[3 * i]), static_cast<double>(trace.force[3 * i + 1]),
                      static_cast<double>(trace.force[3 * i + 2]));
}

double rms_force(const sim::StepTrace& trace) {
    double sum = 0;
    for (const float f : trace.force)
        sum += static_cast<double>(f) * static_cast<double>(f);
    return std::sqrt(sum / static_cast<double>(trace.force.size() / 3));
}

/// A number in a cell, on its right.
void cell(const char* format, auto... values) {
    ImGui::TableNextColumn();
    char text[48];
    std::snprintf(text, sizeof text, format, values...);
    ImGui::PushFont(fonts().mono, 0);
    const float spare = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text).x;
    if (spare > 0)
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + spare);
    ImGui::TextUnformatted(text);
    ImGui::PopFont();
}

struct Column {
    const char* title;
    const char* help;
};
constexpr Column columns[] = {
    {"Stage", "A click on a row shows the stage in the viewport."},
    {"Moved", "Points that the stage moved."},
    {"RMS", "Root mean square of the displacements over all points; of the forces in the first row."},
    {"Largest", "The longest displacement of a point; the largest force in the first row."},
    {"At", "The column and row of that point."},
    {"Kinetic, J", "Energy of motion if the step ended after the stage."},
    {"Spring, J", "Energy in the springs."},
    {"Gravity, J", "Energy in the uniform accelerations, zero at the origin."},
    {"Total, J", "The sum of the three."},
    {"Change, J", "What the stage added to the total."},
    {"Max strain", "How much longer than at rest the most stretched spring is."},
};

void headers(std::span<const Column> list) {
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    for (std::size_t i = 0; i < list.size(); ++i) {
        ImGui::TableSetColumnIndex(static_cast<int>(i));
        ImGui::TableHeader(list[i].title);
        tooltip(list[i].help);
    }
}

/// The first cell of a row: swatch, title, and the click that shows the stage.
void stage_cell(Lab& lab, int stage, const char* title, bool active) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const float swatch = ImGui::GetFontSize() * 0.7f;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float y = at.y + (ImGui::GetTextLineHeight() - swatch) / 2;
    if (stage >= 0)
        ImGui::GetWindowDrawList()->AddRectFilled({at.x, y}, {at.x + swatch, y + swatch},
                                                  stage_tint(static_cast<std::size_t>(stage), active), 2);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 1.5f * swatch);
    const ImGuiSelectableFlags flags =
        ImGuiSelectableFlags_SpanAllColumns | (active ? 0 : ImGuiSelectableFlags_Disabled);
    if (ImGui::Selectable((std::string(title) + "###row" + std::to_string(stage)).c_str(), lab.timeline.stage == stage,
                          flags))
        lab.timeline.stage = stage;
}

void energy_cells(const sim::Energy& energy, const sim::Energy* before, double strain) {
    cell("%.5g", energy.kinetic);
    cell("%.5g", energy.spring);
    cell("%.6g", energy.gravity);
    cell("%.6g", energy.total());
    if (before)
        cell("%+.3g", energy.total() - before->total());
    else
        ImGui::TableNextColumn();
    cell("%.3f %%", 100 * strain);
}

void vector_cells(const sim::Vec3& v, double factor, const char* format) {
    for (const double value : {v.x, v.y, v.z, std::hypot(v.x, v.y, v.z)})
        cell(format, factor * value);
}

} // namespace

ImU32 stage_tint(std::size_t stage, bool active) {
    const auto& c = stage_colours[stage];
    return ImGui::GetColorU32(ImVec4(c[0], c[1], c[2], active ? 1.f : 0.35f));
}

std::uint32_t strongest(const sim::StepTrace& trace) {
    std::uint32_t best = 0;
    for (std::uint32_t i = 1; i < trace.force.size() / 3; ++i)
        if (force_on(trace, i) > force_on(trace, best))
            best = i;
    return best;
}

void draw_stage_table(Lab& lab, const sim::StepTrace& trace) {
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings |
                                      ImGuiTableFlags_ScrollX | ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_RowBg;
    const float height =
        7.4f * (ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y) + ImGui::GetStyle().ScrollbarSize;
    if (!ImGui::BeginTable("stages", static_cast<int>(std::size(columns)), flags, {0, height}))
        return;
    ImGui::TableSetupScrollFreeze(1, 0);
    for (const Column& column : columns)
        ImGui::TableSetupColumn(column.title);
    headers(columns);

    constexpr auto forces = static_cast<std::size_t>(sim::Stage::forces);
    const int across = lab.snapshot->columns;
    const auto place = [&](std::uint32_t point) {
        cell("%d, %d", static_cast<int>(point) % across, static_cast<int>(point) / across);
    };
    stage_cell(lab, -1, "Before", true);
    for (int empty = 0; empty < 4; ++empty)
        ImGui::TableNextColumn();
    energy_cells(trace.energy[forces], nullptr, trace.max_strain[forces]);
    for (std::size_t s = 0; s < stage_titles.size(); ++s) {
        ImGui::BeginDisabled(!trace.active[s]);
        stage_cell(lab, static_cast<int>(s), stage_titles[s], trace.active[s]);
        if (s == forces) {
            cell("0");
            cell("%.3g N ", rms_force(trace));
            cell("%.3g N ", force_on(trace, strongest(trace)));
            place(strongest(trace));
        } else if (trace.active[s]) {
            cell("%zu", trace.moved[s]);
            cell("%.3g mm", 1e3 * trace.rms_moved[s]);
            cell("%.3g mm", 1e3 * trace.max_moved[s]);
            if (trace.moved[s] > 0)
                place(trace.furthest[s]);
            else
                ImGui::TableNextColumn();
        } else {
            cell("-");
            for (int empty = 0; empty < 3; ++empty)
                ImGui::TableNextColumn();
        }
        if (s != forces && trace.active[s])
            energy_cells(trace.energy[s], &trace.energy[s - 1], trace.max_strain[s]);
        ImGui::EndDisabled();
    }
    ImGui::EndTable();
}

void draw_point_table(const sim::StepTrace& trace, std::uint32_t point) {
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings |
                                      ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_RowBg;
    constexpr Column list[] = {{"Picked point", "What the step does to this point alone."},
                               {"x", "To the right in the flat cloth."},
                               {"y", "Up."},
                               {"z", "Towards the viewer of the front."},
                               {"Length", "Of the vector."}};
    if (!ImGui::BeginTable("point", static_cast<int>(std::size(list)), flags))
        return;
    for (const Column& column : list)
        ImGui::TableSetupColumn(column.title);
    headers(list);
    const auto row = [](const char* title, int stage, bool active) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const float swatch = ImGui::GetFontSize() * 0.7f;
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float y = at.y + (ImGui::GetTextLineHeight() - swatch) / 2;
        if (stage >= 0)
            ImGui::GetWindowDrawList()->AddRectFilled({at.x, y}, {at.x + swatch, y + swatch},
                                                      stage_tint(static_cast<std::size_t>(stage), active), 2);
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 1.5f * swatch);
        ImGui::TextUnformatted(title);
    };
    const auto at = [point](const std::vector<float>& v) {
        const std::size_t i = 3 * static_cast<std::size_t>(point);
        return sim::Vec3{static_cast<double>(v[i]), static_cast<double>(v[i + 1]), static_cast<double>(v[i + 2])};
    };
    const sim::Vec3 before = at(trace.before), after = at(trace.after.back());
    row("Position before, m", -1, true);
    for (const double value : {before.x, before.y, before.z})
        cell("%.5f", value);
    row("Force, N", static_cast<int>(sim::Stage::forces), true);
    vector_cells(at(trace.force), 1, "%.4g");
    for (std::size_t s = 1; s < stage_titles.size(); ++s) {
        if (!trace.active[s])
            continue;
        row((std::string(stage_titles[s]) + ", mm").c_str(), static_cast<int>(s), true);
        vector_cells(effect(trace, static_cast<sim::Stage>(s), point), 1e3, "%.4g");
    }
    row("The whole step, mm", -1, true);
    vector_cells({after.x - before.x, after.y - before.y, after.z - before.z}, 1e3, "%.4g");
    ImGui::EndTable();
}

} // namespace clothlab::ui
