// What keys and buttons do with the timeline.
#include <algorithm>
#include <imgui.h>

#include "ui/panels.h"
#include "ui/timeline_parts.h"

namespace clothlab::ui {

void toggle_play(Lab& lab) {
    lab.ask(Play{!lab.playing});
}

void toggle_backwards(Lab& lab) {
    if (lab.playing && lab.timeline.backwards)
        lab.ask(Play{false});
    else
        ask_timeline(lab, PlayBackwards{});
}

void toggle_loop(Lab& lab) {
    const timeline::Overview* o = lab.timeline.overview.get();
    if (lab.timeline.loop) {
        lab.timeline_view.last_loop = lab.timeline.loop;
        ask_timeline(lab, SetLoop{});
    } else if (o) {
        timeline::FrameRange range = lab.timeline_view.last_loop.value_or(timeline::FrameRange{0, o->end_frame});
        if (range.first >= o->end_frame) // of another line
            range = {0, o->end_frame};
        range.last = std::min(range.last, o->end_frame);
        ask_timeline(lab, SetLoop{range});
    }
}

void set_loop_end(Lab& lab, bool last) {
    const timeline::Overview* o = lab.timeline.overview.get();
    if (!o)
        return;
    const std::uint64_t here = lab.timeline.playhead.frame;
    timeline::FrameRange range = lab.timeline.loop.value_or(timeline::FrameRange{0, o->end_frame});
    if (last)
        range = {range.first < here ? range.first : 0, here};
    else
        range = {here, range.last > here ? range.last : o->end_frame};
    ask_timeline(lab, SetLoop{range});
}

void go_to_neighbour(Lab& lab, bool next) {
    const timeline::Overview* o = lab.timeline.overview.get();
    if (!o)
        return;
    const std::uint64_t here = lab.timeline.playhead.moment.step;
    struct Place {
        std::uint64_t step;
        const timeline::Bookmark* bookmark;
    };
    std::optional<Place> best;
    const auto consider = [&](std::uint64_t step, const timeline::Bookmark* bookmark) {
        if (next ? step > here && (!best || step < best->step) : step < here && (!best || step > best->step))
            best = Place{step, bookmark};
    };
    for (const timeline::Bookmark& bookmark : o->bookmarks)
        if (on_line(*o, bookmark.moment))
            consider(bookmark.moment.step, &bookmark);
    for (const timeline::MarkInfo& mark : o->marks)
        consider(mark.step, nullptr);
    if (best)
        ask_timeline(lab, GoToMoment{{o->line, best->step}, best->bookmark ? best->bookmark->camera : std::nullopt});
}

void timeline_keys(Lab& lab) {
    constexpr ImGuiInputFlags repeat = ImGuiInputFlags_Repeat;
    if (window_key(ImGuiKey_Space) || window_key(ImGuiKey_P))
        toggle_play(lab);
    if (window_key(ImGuiKey_B))
        toggle_backwards(lab);
    if (window_key(ImGuiKey_N, repeat) || window_key(ImGuiKey_RightArrow, repeat))
        lab.ask(StepFrame{});
    if (window_key(ImGuiMod_Shift | ImGuiKey_N, repeat) || window_key(ImGuiMod_Shift | ImGuiKey_RightArrow, repeat))
        lab.ask(StepSubstep{});
    if (window_key(ImGuiKey_LeftArrow, repeat))
        ask_timeline(lab, StepBack{true});
    if (window_key(ImGuiMod_Shift | ImGuiKey_LeftArrow, repeat))
        ask_timeline(lab, StepBack{false});
    if (window_key(ImGuiKey_Home))
        ask_timeline(lab, JumpToStart{});
    if (window_key(ImGuiKey_End))
        ask_timeline(lab, JumpToEnd{});
    if (window_key(ImGuiKey_L))
        toggle_loop(lab);
    if (window_key(ImGuiKey_LeftBracket))
        set_loop_end(lab, false);
    if (window_key(ImGuiKey_RightBracket))
        set_loop_end(lab, true);
    if (window_key(ImGuiKey_Minus, repeat))
        change_speed(lab, false);
    if (window_key(ImGuiKey_Equal, repeat))
        change_speed(lab, true);
    if (window_key(ImGuiKey_M))
        ask_timeline(lab, AddBookmark{});
    if (window_key(ImGuiKey_Comma, repeat))
        go_to_neighbour(lab, false);
    if (window_key(ImGuiKey_Period, repeat))
        go_to_neighbour(lab, true);
    if (window_key(ImGuiKey_R))
        lab.ask(Restart{});
}

} // namespace clothlab::ui
