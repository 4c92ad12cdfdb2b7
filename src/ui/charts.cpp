#include "ui/charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <implot.h>
#include <implot_internal.h> // whether a series is hidden
#include <string>
#include <vector>

#include "ui/theme.h"

namespace clothlab::ui {
namespace {

using experiments::Axis;
using experiments::Chart;
using experiments::Mark;
using experiments::Series;

/// Told apart on a dark ground, as many as there are methods; with the markers below, repetitions are others.
constexpr std::array<ImVec4, 16> palette{{{0.35f, 0.62f, 0.95f, 1},
                                          {0.95f, 0.58f, 0.20f, 1},
                                          {0.42f, 0.80f, 0.42f, 1},
                                          {0.92f, 0.33f, 0.36f, 1},
                                          {0.70f, 0.52f, 0.95f, 1},
                                          {0.98f, 0.90f, 0.35f, 1},
                                          {0.25f, 0.85f, 0.82f, 1},
                                          {0.98f, 0.55f, 0.80f, 1},
                                          {0.78f, 0.80f, 0.82f, 1},
                                          {0.66f, 0.46f, 0.30f, 1},
                                          {0.20f, 0.45f, 0.70f, 1},
                                          {0.75f, 0.85f, 0.55f, 1},
                                          {0.16f, 0.55f, 0.40f, 1},
                                          {0.98f, 0.72f, 0.62f, 1},
                                          {0.60f, 0.28f, 0.62f, 1},
                                          {0.55f, 0.58f, 0.25f, 1}}};
constexpr std::array<ImPlotMarker, 8> markers{ImPlotMarker_Circle, ImPlotMarker_Square, ImPlotMarker_Diamond,
                                              ImPlotMarker_Up,     ImPlotMarker_Down,   ImPlotMarker_Left,
                                              ImPlotMarker_Right,  ImPlotMarker_Plus};
/// px at a scale of 1, from the mouse to a point that it means.
constexpr float reach = 12;

float scaled(float pixels) {
    return pixels * ImGui::GetStyle().FontScaleDpi;
}

/// "0.001", "20", "1e+06": as short as it is exact.
int format_tick(double value, char* text, int size, void*) {
    return std::snprintf(text, static_cast<std::size_t>(size), "%.6g", std::abs(value) < 1e-300 ? 0.0 : value);
}

/// As much of a label as has room in so many px, from its beginning: ImPlot would draw it over what is beside the
/// chart.
std::string fitting_label(const std::string& label, float room) {
    if (ImGui::CalcTextSize(label.c_str()).x <= room)
        return label;
    std::string shorter = label.substr(0, label.find(": "));
    if (const std::size_t remark = shorter.find("; "); remark != std::string::npos)
        shorter = shorter.substr(0, remark) + ")";
    if (ImGui::CalcTextSize(shorter.c_str()).x <= room)
        return shorter;
    while (!shorter.empty() && ImGui::CalcTextSize((shorter + "...").c_str()).x > room)
        shorter.pop_back();
    return shorter + "...";
}

/// `room` for its label, in px.
void set_up_axis(ImAxis axis, const Axis& of, float room) {
    ImPlot::SetupAxis(axis, fitting_label(of.label, room).c_str(), ImPlotAxisFlags_NoSideSwitch);
    if (!of.names.empty()) {
        std::vector<double> places;
        std::vector<const char*> names;
        for (const std::string& name : of.names) {
            places.push_back(static_cast<double>(places.size()));
            names.push_back(name.c_str());
        }
        ImPlot::SetupAxisTicks(axis, places.data(), static_cast<int>(places.size()), names.data());
        return;
    }
    if (of.log)
        ImPlot::SetupAxisScale(axis, ImPlotScale_Log10);
    ImPlot::SetupAxisFormat(axis, format_tick);
}

void draw_cells(const Chart& chart) {
    for (const experiments::CellKind& kind : chart.cell_kinds) {
        ImPlotSpec spec;
        spec.LineColor = spec.FillColor = {kind.colour[0], kind.colour[1], kind.colour[2], 1};
        ImPlot::PlotDummy(kind.name.c_str(), spec);
    }
    ImPlot::PushPlotClipRect();
    for (const experiments::Cell& cell : chart.cells) {
        const auto& c = chart.cell_kinds[cell.kind].colour;
        const ImVec2 a = ImPlot::PlotToPixels(cell.x0, cell.y1), b = ImPlot::PlotToPixels(cell.x1, cell.y0);
        ImDrawList* list = ImPlot::GetPlotDrawList();
        list->AddRectFilled(a, b, ImGui::GetColorU32({c[0], c[1], c[2], 0.75f}));
        if (b.x - a.x > scaled(4) && b.y - a.y > scaled(4))
            list->AddRect(a, b, ImGui::GetColorU32({0, 0, 0, 0.25f}));
    }
    ImPlot::PopPlotClipRect();
}

/// ImPlot has no dashes.
void draw_dashes(const Series& series, const ImVec4& colour, float weight) {
    const float dash = scaled(7), gap = scaled(5);
    ImDrawList* list = ImPlot::GetPlotDrawList();
    ImPlot::PushPlotClipRect();
    float phase = 0;
    for (std::size_t i = 1; i < series.x.size(); ++i) {
        const ImVec2 a = ImPlot::PlotToPixels(series.x[i - 1], series.y[i - 1]);
        const ImVec2 b = ImPlot::PlotToPixels(series.x[i], series.y[i]);
        const float length = std::hypot(b.x - a.x, b.y - a.y);
        if (!std::isfinite(length) || length > 1e5f)
            continue;
        for (float at = -phase; at < length; at += dash + gap) {
            const float from = std::max(at, 0.f) / length, to = std::min(at + dash, length) / length;
            if (to > from)
                list->AddLine({a.x + from * (b.x - a.x), a.y + from * (b.y - a.y)},
                              {a.x + to * (b.x - a.x), a.y + to * (b.y - a.y)}, ImGui::GetColorU32(colour), weight);
        }
        phase = std::fmod(phase + length, dash + gap);
    }
    ImPlot::PopPlotClipRect();
}

void draw_spread(const Series& series, ImPlotSpec spec) {
    std::vector<double> less, more;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        less.push_back(series.x[i] - series.x_low[i]);
        more.push_back(series.x_high[i] - series.x[i]);
    }
    spec.Marker = ImPlotMarker_None;
    spec.LineWeight = scaled(1);
    spec.Flags = int{ImPlotErrorBarsFlags_Horizontal} | int{ImPlotItemFlags_NoLegend};
    ImPlot::PlotErrorBars(series.name.c_str(), series.x.data(), series.y.data(), less.data(), more.data(),
                          static_cast<int>(series.x.size()), spec);
}

void draw_series(const Series& series, int number) {
    const auto look = static_cast<std::size_t>(series.colour >= 0 ? series.colour : number);
    ImPlotSpec spec;
    // A prediction has to stand out from what was observed, and from any cell.
    constexpr ImVec4 emphasised_dashes{0.45f, 0.90f, 1, 1};
    spec.LineColor = !series.emphasised            ? palette[look % palette.size()]
                     : series.mark == Mark::dashed ? emphasised_dashes
                                                   : colour::text;
    spec.LineWeight = scaled(series.emphasised ? 2.6f : 1.4f);
    spec.FillColor = spec.MarkerFillColor = spec.MarkerLineColor = spec.LineColor;
    spec.MarkerSize = scaled(3.5f);
    const auto count = static_cast<int>(series.x.size());
    if (series.mark == Mark::points || series.mark == Mark::line_and_points)
        spec.Marker = markers[look / palette.size() % markers.size()];
    if (series.mark == Mark::points)
        ImPlot::PlotScatter(series.name.c_str(), series.x.data(), series.y.data(), count, spec);
    else if (series.mark == Mark::dashed)
        ImPlot::PlotDummy(series.name.c_str(), spec);
    else
        ImPlot::PlotLine(series.name.c_str(), series.x.data(), series.y.data(), count, spec);
    const auto* hidden = ImPlot::GetItem(series.name.c_str());
    if (hidden && !hidden->Show)
        return;
    if (series.mark == Mark::dashed)
        draw_dashes(series, spec.LineColor, spec.LineWeight);
    if (series.x_low.size() == series.x.size() && series.x_high.size() == series.x.size() && count > 0)
        draw_spread(series, spec);
}

void draw_guide(const experiments::Guide& guide) {
    ImPlotSpec spec;
    spec.LineColor = colour::warning;
    spec.LineWeight = scaled(1.2f);
    spec.Flags = int{ImPlotItemFlags_NoLegend} | (guide.vertical ? 0 : int{ImPlotInfLinesFlags_Horizontal});
    ImPlot::PlotInfLines(("##" + guide.name).c_str(), &guide.at, 1, spec);
    const ImPlotRect seen = ImPlot::GetPlotLimits();
    const float pad = scaled(4);
    const ImVec2 size = ImGui::CalcTextSize(guide.name.c_str());
    const ImVec2 at =
        guide.vertical ? ImPlot::PlotToPixels(guide.at, seen.Y.Max) : ImPlot::PlotToPixels(seen.X.Max, guide.at);
    ImPlot::PushPlotClipRect();
    ImPlot::GetPlotDrawList()->AddText(guide.vertical ? ImVec2(at.x + pad, at.y + pad)
                                                      : ImVec2(at.x - size.x - pad, at.y - size.y - pad / 2),
                                       ImGui::GetColorU32(colour::warning), guide.name.c_str());
    ImPlot::PopPlotClipRect();
}

bool is_hidden(const Series& series) {
    const auto* item = ImPlot::GetItem(series.name.c_str());
    return item && !item->Show;
}

/// The row of what the mouse is over: the nearest point within reach, or else a cell.
std::optional<std::size_t> row_at_mouse(const Chart& chart) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    float nearest = scaled(reach);
    std::optional<std::size_t> found;
    for (const Series& series : chart.series) {
        if (is_hidden(series))
            continue;
        for (std::size_t i = 0; i < series.rows.size(); ++i) {
            const ImVec2 at = ImPlot::PlotToPixels(series.x[i], series.y[i]);
            const float distance = std::hypot(at.x - mouse.x, at.y - mouse.y);
            if (series.rows[i] != experiments::no_row && distance < nearest) {
                nearest = distance;
                found = series.rows[i];
            }
        }
    }
    const ImPlotPoint at = ImPlot::GetPlotMousePos();
    for (const experiments::Cell& cell : chart.cells)
        if (!found && cell.row != experiments::no_row && at.x >= cell.x0 && at.x < cell.x1 && at.y >= cell.y0 &&
            at.y < cell.y1)
            found = cell.row;
    return found;
}

void ring(const Chart& chart, std::size_t row) {
    const auto circle = [](double x, double y) {
        ImPlot::GetPlotDrawList()->AddCircle(ImPlot::PlotToPixels(x, y), scaled(8), ImGui::GetColorU32(colour::text), 0,
                                             scaled(2));
    };
    ImPlot::PushPlotClipRect();
    for (const Series& series : chart.series)
        for (std::size_t i = 0; i < series.rows.size(); ++i)
            if (series.rows[i] == row && !is_hidden(series))
                circle(series.x[i], series.y[i]);
    for (const experiments::Cell& cell : chart.cells)
        if (cell.row == row) {
            const ImVec2 a = ImPlot::PlotToPixels(cell.x0, cell.y1), b = ImPlot::PlotToPixels(cell.x1, cell.y0);
            ImPlot::GetPlotDrawList()->AddRect(a, b, ImGui::GetColorU32(colour::text), 0, scaled(2));
        }
    ImPlot::PopPlotClipRect();
}

void row_tooltip(const experiments::Table& table, std::size_t row) {
    if (row >= table.rows.size() || !ImGui::BeginTooltip())
        return;
    if (ImGui::BeginTable("row", 2)) {
        for (std::size_t i = 0; i < table.columns.size(); ++i) {
            const std::string value = shown(table.rows[row][i], table.columns[i]);
            if (value.empty())
                continue;
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextColored(colour::faint, "%s", table.columns[i].title.c_str());
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(value.c_str());
        }
        ImGui::EndTable();
    }
    ImGui::EndTooltip();
}

} // namespace

ChartMouse draw_chart(const Chart& chart, const experiments::Table& table, const char* id, ImVec2 size, bool fit,
                      bool titled, std::optional<std::size_t> marked) {
    ChartMouse result;
    ImPlot::PushStyleColor(ImPlotCol_PlotBg, ImVec4(0.085f, 0.09f, 0.10f, 1));
    ImPlot::PushStyleColor(ImPlotCol_AxisGrid, ImVec4(1, 1, 1, 0.12f));
    ImPlot::PushStyleVar(ImPlotStyleVar_LegendSpacing, ImVec2(5, 1));
    const bool legend = chart.series.size() + chart.cell_kinds.size() > 1;
    const ImPlotFlags flags = int{ImPlotFlags_NoMouseText} | (legend ? 0 : int{ImPlotFlags_NoLegend}) |
                              (titled ? 0 : int{ImPlotFlags_NoTitle});
    if (ImPlot::BeginPlot((chart.title + "###" + id).c_str(), size, flags)) {
        // What is left beside legend and numbers, about.
        set_up_axis(ImAxis_X1, chart.x, size.x - scaled(legend ? 200 : 60));
        set_up_axis(ImAxis_Y1, chart.y, size.y - scaled(titled ? 70 : 50));
        const ChartLimits limits = limits_of(chart);
        const ImPlotCond when = fit ? ImPlotCond_Always : ImPlotCond_Once;
        ImPlot::SetupAxisLimits(ImAxis_X1, limits.x_low, limits.x_high, when);
        ImPlot::SetupAxisLimits(ImAxis_Y1, limits.y_low, limits.y_high, when);
        ImPlot::SetupLegend(ImPlotLocation_East, ImPlotLegendFlags_Outside);
        draw_cells(chart);
        int number = 0;
        for (const Series& series : chart.series)
            draw_series(series, number++);
        for (const experiments::Guide& guide : chart.guides)
            draw_guide(guide);
        if (marked)
            ring(chart, *marked);
        if (ImPlot::IsPlotHovered()) {
            result.hovered = row_at_mouse(chart);
            if (result.hovered && ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
                !ImGui::IsMouseDragPastThreshold(ImGuiMouseButton_Left))
                result.clicked = result.hovered;
        }
        ImPlot::EndPlot();
    }
    ImPlot::PopStyleVar();
    ImPlot::PopStyleColor(2);
    if (result.hovered)
        row_tooltip(table, *result.hovered);
    return result;
}

} // namespace clothlab::ui
