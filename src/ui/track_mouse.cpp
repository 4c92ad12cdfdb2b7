// The mouse over the track and the curves: scrubbing, zooming, panning; and the playhead that all of them share.
#include <algorithm>
#include <cmath>
#include <imgui.h>

#include "ui/theme.h"
#include "ui/timeline_parts.h"
#include "ui/track_places.h"

namespace clothlab::ui {
namespace {

/// The step under the mouse: that of something near, else a frame's end, or a substep where those can be told apart.
std::uint64_t step_under_mouse(const Lab& lab, const FrameAxis& axis, const TrackScale& scale) {
    const float x = std::clamp(ImGui::GetIO().MousePos.x, scale.left, scale.right);
    const float reach = ImGui::GetStyle().FontScaleDpi * 5;
    const TrackPlace* nearest = nullptr;
    const std::vector<TrackPlace> places = track_places(*lab.timeline.overview, axis);
    const auto off = [&](const TrackPlace& place) { return std::abs(scale.x_of(place.frame) - x); };
    for (const TrackPlace& place : places)
        if (off(place) <= reach && (!nearest || off(place) < off(*nearest)))
            nearest = &place;
    if (nearest)
        return nearest->step;
    const double frame = scale.frame_at(x);
    const bool substeps = scale.pixels_per_frame() / axis.substeps_at(frame) >= 3;
    return axis.step_of(substeps ? frame : std::round(frame));
}

} // namespace

void scrub(Lab& lab, const FrameAxis& axis, const TrackScale& scale) {
    TimelineView& view = lab.timeline_view;
    if (!ImGui::IsItemActive() || view.drag != TimelineView::Drag::scrub ||
        !ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
        if (ImGui::IsItemDeactivated())
            view.asked.reset();
        return;
    }
    const std::uint64_t step = step_under_mouse(lab, axis, scale);
    if (view.asked == step)
        return;
    view.asked = step;
    ask_timeline(lab, SeekStep{step});
}

void zoom_and_pan(Lab& lab, const FrameAxis& axis, const TrackScale& scale) {
    TimelineView& view = lab.timeline_view;
    const ImGuiIO& io = ImGui::GetIO();
    double move = 0; // frames
    const double span = view.last - view.first;
    const double longest = std::max(1.2 * axis.end(), lab.timeline.overview->frames_per_second);
    if (ImGui::IsItemHovered()) {
        const double wheel = static_cast<double>(io.MouseWheel), sideways = static_cast<double>(io.MouseWheelH);
        if (sideways != 0 || (io.KeyShift && wheel != 0))
            move -= 0.1 * span * (sideways != 0 ? sideways : wheel);
        else if (wheel != 0) {
            const double shortest = 4.0 / axis.substeps_at(scale.frame_at(io.MousePos.x));
            const double now = std::clamp(span * std::pow(0.8, wheel), shortest, longest);
            const double at = scale.frame_at(io.MousePos.x);
            view.first = at - (at - view.first) * now / span;
            view.last = view.first + now;
            view.fit = false;
        }
    }
    if (ImGui::IsItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Right))
        move -= static_cast<double>(io.MouseDelta.x) / scale.pixels_per_frame();
    if (move != 0)
        view.fit = false;
    if (view.fit)
        return;
    // Some of the line stays in view.
    const double now = view.last - view.first;
    view.first = std::clamp(view.first + move, -0.5 * now, std::max(axis.end() - 0.5 * now, -0.5 * now));
    view.last = view.first + now;
}

void draw_playhead(const Lab& lab, const FrameAxis& axis, const TrackScale& scale, float top, float bottom, bool head) {
    const float x = scale.x_of(axis.frame_of(lab.timeline.playhead.moment.step));
    if (x < scale.left - 1 || x > scale.right + 1)
        return;
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImU32 white = ImGui::GetColorU32(ImVec4(1, 1, 1, 0.95f));
    const float size = ImGui::GetFontSize() * 0.3f;
    list->AddLine({x, top}, {x, bottom}, white, 1.5f);
    if (head)
        list->AddTriangleFilled({x - size, top}, {x + size, top}, {x, top + 1.6f * size}, white);
}

} // namespace clothlab::ui
