// The track: the line's frames from left to right, what is in the cache, what happened where, the loop, the playhead.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <imgui.h>

#include "ui/icons.h"
#include "ui/theme.h"
#include "ui/timeline_parts.h"
#include "ui/track_places.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

using Drag = TimelineView::Drag;

/// Upper edges of the lanes, from top to bottom, and the lower edge of the last one.
struct Lanes {
    float loop, seconds, frames, band, places, bottom;
};

Lanes lanes_at(float top) {
    const float font = ImGui::GetFontSize();
    Lanes l{};
    l.loop = top;
    l.seconds = l.loop + std::floor(font * 0.6f);
    l.frames = l.seconds + font;
    l.band = l.frames + font;
    l.places = l.band + std::floor(font * 0.65f);
    l.bottom = l.places + std::floor(font * 1.15f);
    return l;
}

ImU32 tint(const ImVec4& c, float alpha = 1) {
    return ImGui::GetColorU32(ImVec4(c.x, c.y, c.z, c.w * alpha));
}

/// Ticks with numbers at multiples of a round step that leaves them room.
template <class Place>
void ruler(const TrackScale& scale, double first, double last, double least, const char* unit, float top, float bottom,
           Place x_of) {
    const float font = ImGui::GetFontSize();
    const double pixels = static_cast<double>(scale.right - scale.left);
    const double step = round_step(std::max((last - first) * static_cast<double>(font * 5.5f) / pixels, least));
    const int digits = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
    ImDrawList* list = ImGui::GetWindowDrawList();
    for (double i = std::floor(first / step); i * step <= last; ++i) {
        const float x = x_of(i * step);
        char text[48];
        std::snprintf(text, sizeof text, "%.*f%s", digits, i * step, unit);
        list->AddLine({x, top + font * 0.35f}, {x, bottom}, tint(colour::faint, 0.5f));
        if (x + font * 0.2f + ImGui::CalcTextSize(text).x < scale.right)
            list->AddText({x + font * 0.2f, top}, tint(colour::faint), text);
    }
}

void draw_rulers(const FrameAxis& axis, const TrackScale& scale, const Lanes& lanes) {
    ruler(scale, axis.time_of(scale.first), axis.time_of(scale.last), 1e-6, " s", lanes.seconds, lanes.frames,
          [&](double time) { return scale.x_of(axis.frame_at(time)); });
    ruler(scale, scale.first, scale.last, 1, "", lanes.frames, lanes.band,
          [&](double frame) { return scale.x_of(frame); });
}

/// What can be reached is solid; what was computed but dropped since is hatched.
void draw_band(const timeline::Overview& o, const FrameAxis& axis, const TrackScale& scale, const Lanes& lanes) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float top = lanes.band + 1, bottom = lanes.places - 1, height = bottom - top;
    const float begin = scale.x_of(0), end = scale.x_of(axis.end());
    list->PushClipRect({std::max(begin, scale.left), top}, {std::min(end, scale.right), bottom}, true);
    list->AddRectFilled({begin, top}, {end, bottom}, tint({0.25f, 0.26f, 0.28f, 1}));
    for (float x = std::max(begin, scale.left) - height; x < std::min(end, scale.right); x += height * 0.8f)
        list->AddLine({x, bottom}, {x + height, top}, tint(colour::faint, 0.35f));
    const ImU32 solid = tint({0.36f, 0.47f, 0.58f, 1});
    float done = scale.left - 1; // ranges narrower than a pixel are drawn together
    for (const timeline::FrameRange& range : o.reachable) {
        const float from = scale.x_of(static_cast<double>(range.first)),
                    to = scale.x_of(range.last == o.end_frame ? axis.end() : static_cast<double>(range.last) + 0.5);
        if (to < done || from > scale.right)
            continue;
        done = std::max(to, from + 1);
        list->AddRectFilled({from, top}, {done, bottom}, solid);
    }
    const auto& keys = o.keyframes;
    const auto lower = [&](double frame) {
        return std::lower_bound(keys.begin(), keys.end(), frame,
                                [](std::uint64_t f, double at) { return static_cast<double>(f) < at; });
    };
    const auto first = lower(scale.first), last = lower(scale.last + 1);
    if (static_cast<float>(last - first) * 4 < scale.right - scale.left)
        for (auto key = first; key != last; ++key) {
            const float x = scale.x_of(static_cast<double>(*key));
            list->AddLine({x, top}, {x, bottom}, tint({0.70f, 0.82f, 0.92f, 1}));
        }
    const int substeps = axis.substeps_at(scale.first);
    if (scale.pixels_per_frame() / substeps >= 6)
        for (std::uint64_t step = axis.step_of(scale.first); step <= axis.step_of(scale.last); ++step) {
            const float x = scale.x_of(axis.frame_of(step));
            list->AddLine({x, top + height * 0.6f}, {x, bottom}, tint(colour::faint, 0.7f));
        }
    list->PopClipRect();
}

/// Where the room for a bookmark's name ends, px.
float next_icon(const std::vector<TrackPlace>& places, const TrackScale& scale, const TrackPlace& bookmark) {
    float end = scale.right;
    for (const TrackPlace& place : places)
        if (&place != &bookmark && place.kind != TrackPlace::Kind::change && place.frame >= bookmark.frame) {
            const bool flag = place.kind == TrackPlace::Kind::bookmark;
            end = std::min(end, scale.x_of(place.frame) - (flag ? 2.f : ImGui::CalcTextSize(place.icon).x / 2 + 2));
        }
    return end;
}

void draw_places(const std::vector<TrackPlace>& places, const TrackScale& scale, const Lanes& lanes) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float font = ImGui::GetFontSize();
    for (const TrackPlace& place : places) {
        const float x = scale.x_of(place.frame);
        if (x < scale.left - font || x > scale.right + font)
            continue;
        if (place.kind == TrackPlace::Kind::change) {
            const float middle = (lanes.band + lanes.places) / 2, r = (lanes.places - lanes.band) * 0.45f;
            list->AddQuadFilled({x - r, middle}, {x, middle - r}, {x + r, middle}, {x, middle + r}, tint(place.colour));
            list->AddQuad({x - r, middle}, {x, middle - r}, {x + r, middle}, {x, middle + r},
                          tint({0.1f, 0.1f, 0.1f, 1}));
            continue;
        }
        const ImVec2 size = ImGui::CalcTextSize(place.icon);
        if (place.kind == TrackPlace::Kind::bookmark) { // a flag's pole is where the moment is
            list->AddLine({x, lanes.band}, {x, lanes.bottom}, tint(place.colour), 1.5f);
            list->AddText({x + 1, lanes.places}, tint(place.colour), place.icon);
            const float begin = x + size.x + font * 0.2f, end = next_icon(places, scale, place);
            list->PushClipRect({begin, lanes.places}, {std::max(end, begin), lanes.bottom}, true);
            list->AddText({begin, lanes.places}, tint(colour::text), place.text.c_str());
            list->PopClipRect();
            continue;
        }
        list->AddLine({x, lanes.band}, {x, lanes.places}, tint(place.colour, 0.9f));
        list->AddText({x - size.x / 2, lanes.places}, tint(place.colour), place.icon);
    }
}

const std::optional<timeline::FrameRange>& loop_shown(const Lab& lab) {
    return lab.timeline_view.loop_drawn ? lab.timeline_view.loop_drawn : lab.timeline.loop;
}

void draw_loop(const Lab& lab, const TrackScale& scale, const Lanes& lanes) {
    const auto& loop = loop_shown(lab);
    if (!loop)
        return;
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float from = scale.x_of(static_cast<double>(loop->first)), to = scale.x_of(static_cast<double>(loop->last));
    const float grip = ImGui::GetFontSize() * 0.25f;
    list->AddRectFilled({from, lanes.loop}, {to, lanes.places}, tint(colour::accent, 0.13f));
    list->AddRectFilled({from, lanes.loop}, {to, lanes.seconds - 1}, tint(colour::accent, 0.55f), 2);
    list->AddRectFilled({from, lanes.loop}, {from + grip, lanes.seconds - 1}, tint(colour::accent));
    list->AddRectFilled({to - grip, lanes.loop}, {to, lanes.seconds - 1}, tint(colour::accent));
}

std::uint64_t whole_frame(double frame, const timeline::Overview& o) {
    return static_cast<std::uint64_t>(std::clamp(std::round(frame), 0.0, static_cast<double>(o.end_frame)));
}

void begin_drag(Lab& lab, const std::vector<TrackPlace>& places, const TrackScale& scale, const Lanes& lanes) {
    TimelineView& view = lab.timeline_view;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const float near_px = ImGui::GetFontSize() * 0.35f;
    view.grabbed = scale.frame_at(mouse.x);
    view.drag = Drag::scrub;
    if (mouse.y < lanes.seconds) {
        const auto& loop = lab.timeline.loop;
        const auto near_to = [&](std::uint64_t frame) {
            return std::abs(mouse.x - scale.x_of(static_cast<double>(frame))) < near_px;
        };
        if (loop && near_to(loop->last))
            view.drag = Drag::loop_last;
        else if (loop && near_to(loop->first))
            view.drag = Drag::loop_first;
        else
            view.drag = Drag::loop;
        return;
    }
    if (mouse.y < lanes.places)
        return;
    for (auto place = places.rbegin(); place != places.rend(); ++place) { // the uppermost first
        const float width = ImGui::CalcTextSize(place->icon).x, x = scale.x_of(place->frame);
        const bool flag = place->kind == TrackPlace::Kind::bookmark;
        if (place->kind == TrackPlace::Kind::change || mouse.x < x - (flag ? near_px : width / 2) ||
            mouse.x > x + (flag ? width : width / 2))
            continue;
        ask_timeline(lab, GoToMoment{{lab.timeline.overview->line, place->step}, place->camera});
        view.drag = Drag::none;
        return;
    }
}

/// The loop's ends, or all of it, or a new one.
void drag_loop(Lab& lab, const TrackScale& scale) {
    const timeline::Overview& o = *lab.timeline.overview;
    TimelineView& view = lab.timeline_view;
    const double at = scale.frame_at(ImGui::GetIO().MousePos.x);
    if (!view.loop_drawn && !ImGui::IsMouseDragging(ImGuiMouseButton_Left, 2))
        return;
    const auto& loop = lab.timeline.loop;
    timeline::FrameRange range = loop.value_or(timeline::FrameRange{});
    const bool inside =
        loop && view.grabbed >= static_cast<double>(loop->first) && view.grabbed <= static_cast<double>(loop->last);
    if (view.drag == Drag::loop_first)
        range.first = std::min(whole_frame(at, o), range.last > 0 ? range.last - 1 : 0);
    else if (view.drag == Drag::loop_last)
        range.last = std::max(whole_frame(at, o), range.first + 1);
    else if (inside) {
        const std::uint64_t length = range.last - range.first;
        const std::uint64_t latest = o.end_frame > length ? o.end_frame - length : 0;
        range.first = std::min(whole_frame(static_cast<double>(loop->first) + at - view.grabbed, o), latest);
        range.last = range.first + length;
    } else {
        range = {whole_frame(std::min(at, view.grabbed), o), whole_frame(std::max(at, view.grabbed), o)};
        range.last = std::max(range.last, range.first + 1);
    }
    view.loop_drawn = range;
}

void tell_what_is_here(Lab& lab, const FrameAxis& axis, const std::vector<TrackPlace>& places, const TrackScale& scale,
                       const Lanes& lanes) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const timeline::Overview& o = *lab.timeline.overview;
    const double frame = scale.frame_at(mouse.x);
    if (mouse.y < lanes.seconds) {
        char text[160];
        if (const auto& loop = loop_shown(lab))
            std::snprintf(text, sizeof text, "Loop: frames %llu to %llu. Drag its ends, or all of it; L switches it.",
                          static_cast<unsigned long long>(loop->first), static_cast<unsigned long long>(loop->last));
        else
            std::snprintf(text, sizeof text, "Drag here to play in a loop.");
        tooltip(text);
        return;
    }
    if (frame < 0 || frame > axis.end())
        return;
    std::string text;
    for (const TrackPlace& place : places)
        if (std::abs(scale.x_of(place.frame) - mouse.x) < ImGui::GetFontSize() * 0.45f)
            text += (text.empty() ? "" : "\n") + std::string(place.icon) + "  " + place.text;
    char where[96];
    const auto whole = static_cast<std::uint64_t>(frame);
    std::snprintf(where, sizeof where, "%sFrame %llu, %.3f s%s", text.empty() ? "" : "\n",
                  static_cast<unsigned long long>(std::llround(frame)), axis.time_of(frame),
                  reachable_between(o.reachable, whole, whole) || frame >= static_cast<double>(o.end_frame)
                      ? ""
                      : ": no longer in the cache");
    text += where;
    if (!text.empty())
        tooltip(text);
}

void gutter(Lab& lab, const Lanes& lanes, float left) {
    const float font = ImGui::GetFontSize();
    ImDrawList* list = ImGui::GetWindowDrawList();
    const auto label = [&](float y, const char* text) {
        const float width = ImGui::CalcTextSize(text).x;
        list->AddText({left + track_gutter() - width - font * 0.4f, y}, tint(colour::faint), text);
    };
    if (track_gutter() > font * 4) {
        label(lanes.seconds, "time");
        label(lanes.frames, "frame");
    }
    const ImVec2 after = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({left, lanes.seconds + font * 0.2f});
    if (icon_button(ICON_FA_LEFT_RIGHT, "##fit",
                    "See the whole line again. The wheel zooms, right drag or Shift+wheel moves the track."))
        lab.timeline_view.fit = true;
    ImGui::SetCursorScreenPos({left, lanes.bottom - ImGui::GetFrameHeight()});
    curve_menu(lab);
    ImGui::SetCursorScreenPos(after);
}

void follow_playhead(Lab& lab, const FrameAxis& axis) {
    TimelineView& view = lab.timeline_view;
    const std::uint64_t step = lab.timeline.playhead.moment.step;
    if (view.fit) {
        view.first = 0;
        view.last = std::max(axis.end(), lab.timeline.overview->frames_per_second);
    } else if (step != view.shown_step && view.drag == Drag::none) {
        const double at = axis.frame_of(step), span = view.last - view.first;
        if (at < view.first || at > view.last) {
            view.first = std::max(at - span * (at < view.first && lab.timeline.backwards ? 0.9 : 0.1), -0.02 * span);
            view.last = view.first + span;
        }
    }
    view.shown_step = step;
}

} // namespace

float track_gutter() {
    const float font = ImGui::GetFontSize();
    return std::floor(font * (ImGui::GetWindowWidth() > font * 16 ? 4.6f : 2)); // the buttons alone
}

TrackScale draw_track(Lab& lab, const FrameAxis& axis) {
    TimelineView& view = lab.timeline_view;
    follow_playhead(lab, axis);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float font = ImGui::GetFontSize();
    TrackScale scale{at.x + track_gutter(), at.x + ImGui::GetContentRegionAvail().x - font * 0.5f, view.first,
                     view.last};
    scale.right = std::max(scale.right, scale.left + font);
    const Lanes lanes = lanes_at(at.y);
    const timeline::Overview& o = *lab.timeline.overview;
    const std::vector<TrackPlace> places = track_places(o, axis);

    gutter(lab, lanes, at.x);
    ImGui::SetCursorScreenPos({scale.left, lanes.loop});
    ImGui::InvisibleButton("track", {scale.right - scale.left, lanes.bottom - lanes.loop},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    ImGui::SetItemKeyOwner(ImGuiKey_MouseWheelY);
    ImGui::SetItemKeyOwner(ImGuiKey_MouseWheelX);
    const bool hovered = ImGui::IsItemHovered();
    if (hovered)
        view.hovering = scale.frame_at(ImGui::GetIO().MousePos.x);
    if (ImGui::IsItemActivated() && ImGui::IsMouseClicked(ImGuiMouseButton_Left))
        begin_drag(lab, places, scale, lanes);
    if (ImGui::IsItemActive() && view.drag >= Drag::loop_first)
        drag_loop(lab, scale);
    scrub(lab, axis, scale);
    if (hovered && !ImGui::IsItemActive())
        tell_what_is_here(lab, axis, places, scale, lanes);
    zoom_and_pan(lab, axis, scale);
    if (ImGui::IsItemDeactivated()) {
        if (view.loop_drawn)
            ask_timeline(lab, SetLoop{view.loop_drawn});
        view.loop_drawn.reset();
        view.drag = Drag::none;
    }

    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled({scale.left, lanes.loop}, {scale.right, lanes.bottom}, tint({0.085f, 0.09f, 0.10f, 1}), 3);
    list->PushClipRect({scale.left, lanes.loop}, {scale.right, lanes.bottom + 1}, true);
    draw_rulers(axis, scale, lanes);
    draw_band(o, axis, scale, lanes);
    draw_loop(lab, scale, lanes);
    draw_places(places, scale, lanes);
    list->PopClipRect();
    draw_playhead(lab, axis, scale, lanes.seconds, lanes.bottom, true);
    return scale;
}

} // namespace clothlab::ui
