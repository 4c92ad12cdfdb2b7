// Curves under the track: energies, strain, contacts, time per stage, distance of the ghost.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <imgui.h>
#include <implot.h>

#include "ui/icons.h"
#include "ui/theme.h"
#include "ui/timeline_parts.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

using timeline::DistanceSample;
using timeline::Sample;

struct Line {
    const char* name;
    ImVec4 colour;
    float weight = 1.4f;
};

// After M. Okabe, K. Ito, "Color universal design", 2008; the blue is lighter, as the background is dark.
constexpr ImVec4 sky{0.34f, 0.71f, 0.91f, 1}, orange{0.90f, 0.62f, 0.00f, 1}, green{0.00f, 0.72f, 0.52f, 1},
    yellow{0.94f, 0.89f, 0.26f, 1}, purple{0.86f, 0.55f, 0.73f, 1}, vermilion{0.92f, 0.45f, 0.10f, 1};

struct Row {
    const char* title;
    const char* unit;
    const char* help;
    std::vector<Line> lines;
    bool from_zero = true;
};

const Row& row_of(CurveRow row) {
    static const std::array<Row, curve_rows> rows{
        Row{"Energy",
            "J",
            "Gravity's energy is zero at the origin.",
            {{"total", {1, 1, 1, 1}, 1.8f}, {"kinetic", sky}, {"springs", orange}, {"gravity", green}},
            false},
        Row{"Largest strain",
            "%",
            "The largest elongation of any spring, at the end of each frame.",
            {{"strain", yellow}}},
        Row{"Contacts",
            "per step",
            "The most in any step of the frame.",
            {{"self", purple}, {"colliders", sky}, {"shortened springs", orange}}},
        Row{"Time",
            "µs per step",
            "Wall time of each stage, the mean over the frame's steps.",
            {{"forces", orange}, {"method", sky}, {"self-collision", purple}, {"colliders", green}, {"limit", yellow}}},
        Row{"Ghost",
            "mm",
            "The distance of the points from those of the ghost at the same time.",
            {{"RMS", sky}, {"largest", vermilion}}},
    };
    return rows[static_cast<std::size_t>(row)];
}

void sample_values(CurveRow row, const Sample& s, float* out) {
    switch (row) {
    case CurveRow::energy:
        out[0] = s.total(), out[1] = s.kinetic, out[2] = s.spring, out[3] = s.gravity;
        break;
    case CurveRow::strain:
        out[0] = 100 * s.max_strain;
        break;
    case CurveRow::contacts:
        out[0] = static_cast<float>(s.self_contacts), out[1] = static_cast<float>(s.contacts);
        out[2] = static_cast<float>(s.shortened_springs);
        break;
    case CurveRow::stages:
        for (std::size_t i = 0; i < s.stage_seconds.size(); ++i)
            out[i] = 1e6f * s.stage_seconds[i];
        break;
    case CurveRow::ghost:
        break;
    }
}

void ghost_values(const DistanceSample& s, float* out) {
    out[0] = static_cast<float>(1000 * s.distance.rms);
    out[1] = static_cast<float>(1000 * s.distance.max);
}

template <class Item>
const Item* nearest(std::span<const Item> items, double frame) {
    if (items.empty())
        return nullptr;
    auto after = std::lower_bound(items.begin(), items.end(), frame,
                                  [](const Item& item, double f) { return static_cast<double>(item.frame) < f; });
    if (after == items.end() || (after != items.begin() && frame - static_cast<double>((after - 1)->frame) <
                                                               static_cast<double>(after->frame) - frame))
        --after;
    // Not where there is none far and wide.
    return std::abs(static_cast<double>(after->frame) - frame) <= 1 ? &*after : nullptr;
}

std::span<const DistanceSample> ghost_samples(const Lab& lab) {
    return lab.timeline.ghost_curve ? std::span<const DistanceSample>(*lab.timeline.ghost_curve)
                                    : std::span<const DistanceSample>();
}

/// The row's curves in the range, computed when anything has changed.
const std::vector<Curve>& curves_of(Lab& lab, CurveRow row, const CurveRange& range) {
    const timeline::Overview& o = *lab.timeline.overview;
    TimelineView::Drawn& drawn = lab.timeline_view.drawn[static_cast<std::size_t>(row)];
    const auto ghost = ghost_samples(lab);
    const bool is_ghost = row == CurveRow::ghost;
    const void* data = is_ghost ? static_cast<const void*>(ghost.data()) : o.samples.data();
    const std::size_t count = is_ghost ? ghost.size() : o.samples.size();
    if (drawn.data == data && drawn.count == count && drawn.version == o.version && drawn.range == range)
        return drawn.curves;
    // A long run's curves take milliseconds, and a few more frames at its end are less than a pixel.
    constexpr std::size_t many = 30'000;
    const double pixel = (range.last - range.first) / range.columns;
    const bool nearly = drawn.range.columns == range.columns && std::abs(drawn.range.first - range.first) <= pixel &&
                        std::abs(drawn.range.last - range.last) <= pixel;
    const double now = ImGui::GetTime();
    if (nearly && count >= drawn.count && drawn.count > many && now - drawn.at < 0.25)
        return drawn.curves;
    drawn = {data, count, o.version, now, range, {}};
    const std::size_t lines = row_of(row).lines.size();
    if (is_ghost)
        drawn.curves = decimate(ghost, lines, ghost_values, range, {});
    else
        drawn.curves = decimate(
            std::span<const Sample>(o.samples), lines,
            [row](const Sample& s, float* out) { sample_values(row, s, out); }, range, o.reachable);
    return drawn.curves;
}

bool values_at(const Lab& lab, CurveRow row, double frame, float* out) {
    if (row == CurveRow::ghost) {
        const DistanceSample* s = nearest(ghost_samples(lab), frame);
        if (s)
            ghost_values(*s, out);
        return s != nullptr;
    }
    const Sample* s = nearest(std::span<const Sample>(lab.timeline.overview->samples), frame);
    if (s)
        sample_values(row, *s, out);
    return s != nullptr;
}

std::uint32_t bit(std::size_t line) {
    return std::uint32_t{1} << line;
}

/// Four digits, or fewer where it would be longer than eight characters.
std::string short_number(double value) {
    std::array<char, 32> text{};
    if (std::snprintf(text.data(), text.size(), "%.4g", value) > 8)
        std::snprintf(text.data(), text.size(), "%.*e", value < 0 ? 1 : 2, value);
    return text.data();
}

/// Title, and each curve's colour and name with its value under the mouse, or else at the playhead; a click hides a
/// curve.
void legend(Lab& lab, CurveRow row, const FrameAxis& axis, float left, float right) {
    TimelineView& view = lab.timeline_view;
    const Row& r = row_of(row);
    std::uint32_t& hidden = view.hidden[static_cast<std::size_t>(row)];
    const double frame = view.hovered.value_or(axis.frame_of(lab.timeline.playhead.moment.step));
    std::array<float, 8> values{};
    const bool known = values_at(lab, row, frame, values.data());
    const float font = ImGui::GetFontSize();
    ImGui::SetCursorScreenPos({left, ImGui::GetCursorScreenPos().y});
    ImGui::Text("%s (%s)", r.title, r.unit);
    tooltip(r.help + std::string(" A click on a curve's name hides it."));
    for (std::size_t i = 0; i < r.lines.size(); ++i) {
        const std::string value = known ? " " + short_number(static_cast<double>(values[i])) : std::string();
        const std::string text = r.lines[i].name + value;
        // Room for any number, so that the names stay where they are.
        const float width = font * 0.9f + ImGui::CalcTextSize(r.lines[i].name).x + ImGui::CalcTextSize(" -0.00e+0").x;
        ImGui::SameLine(0, font * 0.5f);
        if (ImGui::GetCursorScreenPos().x + width > right) {
            ImGui::NewLine();
            break;
        }
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const bool off = (hidden & bit(i)) != 0;
        if (ImGui::InvisibleButton(r.lines[i].name, {width, ImGui::GetTextLineHeight()}))
            hidden ^= bit(i);
        const float side = font * 0.55f, top = at.y + (ImGui::GetTextLineHeight() - side) / 2;
        ImDrawList* list = ImGui::GetWindowDrawList();
        const ImU32 tint = ImGui::GetColorU32(off ? colour::faint : r.lines[i].colour);
        if (off)
            list->AddRect({at.x, top}, {at.x + side, top + side}, tint);
        else
            list->AddRectFilled({at.x, top}, {at.x + side, top + side}, tint);
        list->AddText({at.x + side + font * 0.25f, at.y}, ImGui::GetColorU32(off ? colour::faint : colour::text),
                      text.c_str());
    }
}

struct Limits {
    double low = 0, high = 1;
};

Limits limits_of(const std::vector<Curve>& curves, const Row& row, std::uint32_t hidden) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < curves.size(); ++i)
        for (const double y : curves[i].y)
            if ((hidden & bit(i)) == 0 && std::isfinite(y)) {
                low = std::min(low, y);
                high = std::max(high, y);
            }
    if (!(low <= high))
        return {};
    if (row.from_zero)
        low = std::min(low, 0.0);
    const double pad = high > low ? 0.07 * (high - low) : std::max(std::abs(high), 1e-6);
    return {row.from_zero ? low : low - pad, high + pad};
}

void set_axes(const TrackScale& scale, const Limits& y, float left, float top, float height) {
    constexpr ImPlotAxisFlags bare =
        ImPlotAxisFlags_NoTickLabels | ImPlotAxisFlags_NoTickMarks | ImPlotAxisFlags_NoLabel | ImPlotAxisFlags_NoMenus;
    ImPlot::SetupAxes(nullptr, nullptr, ImPlotAxisFlags_NoDecorations, bare);
    ImPlot::SetupAxesLimits(scale.first, scale.last, y.low, y.high, ImPlotCond_Always);
    const float font = ImGui::GetFontSize();
    const double step = round_step((y.high - y.low) * static_cast<double>(1.4f * font / std::max(height, 1.f)));
    std::vector<double> ticks;
    for (double i = std::ceil(y.low / step); i * step <= y.high; ++i)
        ticks.push_back(i * step);
    ImPlot::SetupAxisTicks(ImAxis_Y1, ticks.data(), static_cast<int>(ticks.size()));
    // ImPlot would make room for the numbers as wide as they are: the plots would not line up with the track.
    for (const double tick : ticks) {
        char text[32];
        std::snprintf(text, sizeof text, "%.4g", tick == 0 ? 0.0 : tick);
        const ImVec2 size = ImGui::CalcTextSize(text);
        const float middle = top + static_cast<float>((y.high - tick) / (y.high - y.low)) * height;
        const float line = std::clamp(middle - size.y / 2, top - size.y * 0.2f, top + height - size.y * 0.8f);
        if (size.x + font * 0.4f < track_gutter())
            ImGui::GetWindowDrawList()->AddText({left - size.x - font * 0.4f, line}, ImGui::GetColorU32(colour::faint),
                                                text);
    }
}

void plot(Lab& lab, CurveRow row, const FrameAxis& axis, const TrackScale& scale, float height) {
    const Row& r = row_of(row);
    TimelineView& view = lab.timeline_view;
    const std::uint32_t hidden = view.hidden[static_cast<std::size_t>(row)];
    const auto columns = std::max(1, static_cast<int>(scale.right - scale.left));
    const std::vector<Curve>& curves = curves_of(lab, row, {scale.first, scale.last, columns});
    const ImVec2 at{scale.left, ImGui::GetCursorScreenPos().y};
    ImGui::SetCursorScreenPos(at);
    if (ImPlot::BeginPlot(r.title, {scale.right - scale.left, height},
                          ImPlotFlags_CanvasOnly | ImPlotFlags_NoInputs | ImPlotFlags_NoFrame)) {
        set_axes(scale, limits_of(curves, r, hidden), scale.left, at.y, height);
        for (std::size_t i = 0; i < curves.size(); ++i) {
            if ((hidden & bit(i)) != 0 || curves[i].x.empty())
                continue;
            ImPlotSpec spec;
            spec.LineColor = r.lines[i].colour;
            spec.LineWeight = r.lines[i].weight * ImGui::GetStyle().FontScaleDpi;
            ImPlot::PlotLine(r.lines[i].name, curves[i].x.data(), curves[i].y.data(),
                             static_cast<int>(curves[i].x.size()), spec);
        }
        ImPlot::EndPlot();
    }
    ImGui::SetCursorScreenPos(at);
    ImGui::InvisibleButton("plot", {scale.right - scale.left, height},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    ImGui::SetItemKeyOwner(ImGuiKey_MouseWheelY);
    ImGui::SetItemKeyOwner(ImGuiKey_MouseWheelX);
    if (ImGui::IsItemActivated())
        view.drag = TimelineView::Drag::scrub;
    scrub(lab, axis, scale);
    zoom_and_pan(lab, axis, scale);
    if (ImGui::IsItemDeactivated())
        view.drag = TimelineView::Drag::none;
    ImDrawList* list = ImGui::GetWindowDrawList();
    if (ImGui::IsItemHovered()) {
        const float x = ImGui::GetIO().MousePos.x;
        view.hovering = scale.frame_at(x);
        list->AddLine({x, at.y}, {x, at.y + height}, ImGui::GetColorU32(colour::faint));
        char text[64];
        const double frame = std::clamp(std::round(*view.hovering), 0.0, axis.end());
        std::snprintf(text, sizeof text, "frame %.0f, %.3f s", frame, axis.time_of(frame));
        const ImVec2 size = ImGui::CalcTextSize(text);
        const float pad = ImGui::GetFontSize() * 0.3f;
        const float left = x + size.x + 2 * pad > scale.right ? x - size.x - pad : x + pad;
        list->AddRectFilled({left - pad / 2, at.y}, {left + size.x + pad / 2, at.y + size.y},
                            ImGui::GetColorU32(ImGuiCol_PopupBg), 3);
        list->AddText({left, at.y}, ImGui::GetColorU32(ImGuiCol_Text), text);
    }
    draw_playhead(lab, axis, scale, at.y, at.y + height, false);
}

bool shown(const Lab& lab, CurveRow row) {
    return lab.timeline_view.rows[static_cast<std::size_t>(row)] &&
           (row != CurveRow::ghost || !ghost_samples(lab).empty());
}

} // namespace

void curve_menu(Lab& lab) {
    if (icon_button(ICON_FA_CHART_LINE, "##curves", "Which curves are drawn under the track"))
        ImGui::OpenPopup("curves");
    if (!ImGui::BeginPopup("curves"))
        return;
    for (std::size_t i = 0; i < curve_rows; ++i) {
        const Row& r = row_of(static_cast<CurveRow>(i));
        ImGui::Checkbox((std::string(r.title) + " (" + r.unit + ")###" + r.title).c_str(), &lab.timeline_view.rows[i]);
        tooltip(r.help);
    }
    if (lab.timeline.ghost == 0)
        ImGui::TextColored(colour::faint, "The ghost's curve is drawn when a ghost is\nswitched on under Branches.");
    ImGui::EndPopup();
}

void draw_curves(Lab& lab, const FrameAxis& axis, const TrackScale& scale) {
    int count = 0;
    for (std::size_t i = 0; i < curve_rows; ++i)
        count += shown(lab, static_cast<CurveRow>(i));
    if (count == 0)
        return;
    const float font = ImGui::GetFontSize(), line = ImGui::GetTextLineHeight() + font * 0.15f, gap = font * 0.3f;
    const float room = ImGui::GetContentRegionAvail().y;
    const float height = std::floor(std::max(room / static_cast<float>(count) - line - gap, font * 1.6f));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, font * 0.15f});
    ImPlot::PushStyleVar(ImPlotStyleVar_PlotPadding, ImVec2(0, 0));
    ImPlot::PushStyleVar(ImPlotStyleVar_PlotMinSize, ImVec2(1, 1));
    ImPlot::PushStyleVar(ImPlotStyleVar_PlotBorderSize, 0.f);
    ImPlot::PushStyleColor(ImPlotCol_PlotBg, ImVec4(0.085f, 0.09f, 0.10f, 1));
    ImPlot::PushStyleColor(ImPlotCol_AxisGrid, ImVec4(1, 1, 1, 0.10f));
    for (std::size_t i = 0; i < curve_rows; ++i) {
        const auto row = static_cast<CurveRow>(i);
        if (!shown(lab, row))
            continue;
        ImGui::PushID(static_cast<int>(i));
        legend(lab, row, axis, scale.left, scale.right);
        plot(lab, row, axis, scale, height);
        ImGui::PopID();
    }
    ImPlot::PopStyleColor(2);
    ImPlot::PopStyleVar(3);
    ImGui::PopStyleVar();
}

} // namespace clothlab::ui
