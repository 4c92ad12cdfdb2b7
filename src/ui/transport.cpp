// The timeline's first row: play, steps, loop, speed, the present moment, and the memory of the cache.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <imgui.h>

#include "ui/icons.h"
#include "ui/theme.h"
#include "ui/timeline_parts.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

constexpr std::array speeds{1.0 / 64, 1.0 / 32, 1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0 / 2, 1.0, 2.0, 4.0, 8.0, 16.0};

std::string speed_name(double speed, bool brief = false) {
    char text[24];
    const char* word = brief ? "" : " speed";
    if (speed < 1)
        std::snprintf(text, sizeof text, "1/%.0f%s", 1 / speed, word);
    else
        std::snprintf(text, sizeof text, "%.0f x%s", speed, word);
    return text;
}

float button_side() {
    return std::floor(ImGui::GetFrameHeight() * 1.12f);
}

/// Places groups side by side, and on the next line what does not fit any more.
class Flow {
public:
    /// `after` an item that is there already.
    explicit Flow(float gap, bool after = false)
        : right_(ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x), gap_(gap), first_(!after) {}
    void next(float width) {
        if (!first_ && ImGui::GetItemRectMax().x + gap_ + width <= right_)
            ImGui::SameLine(0, gap_);
        first_ = false;
    }

private:
    float right_, gap_;
    bool first_;
};

struct Button {
    const char* icon;
    const char* id;
    const char* help;
    bool lit = false;
};

bool press(Flow& flow, const Button& button) {
    const float side = button_side();
    flow.next(side);
    if (button.lit)
        ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.68f, 0.32f, 0.21f, 1));
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, ImGui::GetStyle().FramePadding.y});
    const bool pressed = ImGui::Button((std::string(button.icon) + "###" + button.id).c_str(), {side, side});
    ImGui::PopStyleVar();
    if (button.lit)
        ImGui::PopStyleColor();
    tooltip(button.help);
    return pressed;
}

void buttons(Lab& lab, float gap) {
    const bool forwards = lab.playing && !lab.timeline.backwards, backwards = lab.playing && lab.timeline.backwards;
    Flow flow(gap);
    if (press(flow, {ICON_FA_BACKWARD_FAST, "start", "To the start of this run (Home); what was computed stays"}))
        ask_timeline(lab, JumpToStart{});
    if (press(flow, {ICON_FA_BACKWARD_STEP, "frame back", "One frame back (Left); pauses"}))
        ask_timeline(lab, StepBack{true});
    if (press(flow, {ICON_FA_CHEVRON_LEFT, "substep back", "One substep back (Shift+Left); pauses"}))
        ask_timeline(lab, StepBack{false});
    if (press(flow,
              {backwards ? ICON_FA_PAUSE : ICON_FA_CARET_LEFT, "backwards", "Play backwards or pause (B)", backwards}))
        toggle_backwards(lab);
    if (press(flow, {forwards ? ICON_FA_PAUSE : ICON_FA_PLAY, "play", "Play or pause (Space or P)", forwards}))
        lab.ask(Play{!forwards});
    if (press(flow, {ICON_FA_CHEVRON_RIGHT, "substep", "One substep further (Shift+N or Shift+Right); pauses"}))
        lab.ask(StepSubstep{});
    if (press(flow, {ICON_FA_FORWARD_STEP, "frame", "One frame further (N or Right); pauses"}))
        lab.ask(StepFrame{});
    if (press(flow, {ICON_FA_FORWARD_FAST, "end",
                     "To the last moment that was computed (End); playing on from there is new"}))
        ask_timeline(lab, JumpToEnd{});
    if (press(flow, {ICON_FA_REPEAT, "loop",
                     "Play round and round in a range of frames (L). Its ends are set at the playhead with [ and ], or "
                     "by dragging in the uppermost lane of the track.",
                     lab.timeline.loop.has_value()}))
        toggle_loop(lab);
}

void restart(Lab& lab, bool text, float width) {
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, ImGui::GetStyle().FramePadding.y});
    if (ImGui::Button(text ? ICON_FA_ROTATE "  Restart###restart" : ICON_FA_ROTATE "###restart",
                      {width, button_side()}))
        lab.ask(Restart{});
    ImGui::PopStyleVar();
    tooltip("Begins a new run from the start with the present parameters (R). The run so far stays under Branches. To "
            "see its start again, jump to the start (Home).");
}

void speed_list(Lab& lab, float width, bool brief) {
    ImGui::SetNextItemWidth(width);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                        {ImGui::GetStyle().FramePadding.x, (button_side() - ImGui::GetFontSize()) / 2});
    if (ImGui::BeginCombo("##speed", speed_name(lab.speed, brief).c_str(), ImGuiComboFlags_HeightLarge)) {
        for (const double speed : speeds)
            if (ImGui::Selectable(speed_name(speed).c_str(), speed == lab.speed))
                lab.ask(SetSpeed{speed});
        ImGui::EndCombo();
    }
    ImGui::PopStyleVar();
    tooltip("Simulated seconds per second; slower and faster with - and =. The status bar shows what is reached.");
}

/// With as many digits as the line's end needs, so that the row does not move.
std::string moment_text(const Lab& lab, bool widest, bool brief) {
    const timeline::Playhead& p = lab.timeline.playhead;
    unsigned long long frame = p.frame;
    int substep = p.substep, substeps = p.substeps, digits = 1;
    double time = p.time, end_time = p.time;
    if (lab.timeline.overview) {
        end_time = std::max(end_time, lab.timeline.overview->end_time);
        digits = static_cast<int>(
            std::to_string(std::max<unsigned long long>(frame, lab.timeline.overview->end_frame)).size());
    } else if (lab.snapshot) {
        const sim::Snapshot& s = *lab.snapshot;
        frame = s.frame, substep = s.substep, substeps = s.substeps, time = end_time = s.time;
        digits = static_cast<int>(std::to_string(frame).size());
    }
    const int of = static_cast<int>(std::to_string(substeps).size());
    const int seconds = static_cast<int>(std::to_string(static_cast<long long>(end_time)).size()) + 4;
    char text[96];
    std::snprintf(text, sizeof text, "%*.3f s  %s%*llu + %*d/%d", std::max(seconds, 6), widest ? end_time : time,
                  brief ? "" : "frame ", std::max(digits, 3), frame, of, substep, substeps);
    return text;
}

float mono_width(const std::string& text) {
    ImGui::PushFont(fonts().mono, 0);
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    ImGui::PopFont();
    return width;
}

/// In the fixed-width font; in pieces below each other where there is no room for the whole.
void moment_cell(const Lab& lab, bool brief, float room) {
    std::string text = moment_text(lab, false, brief);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float font = ImGui::GetFontSize();
    const bool whole = mono_width(text) <= room;
    if (!whole)
        text = text.substr(text.find_first_not_of(' '));
    for (const char* gap : {"  ", " + "})
        if (const std::size_t cut = text.find(gap); cut != std::string::npos && !whole)
            text.replace(cut, 1, "\n");
    ImGui::PushFont(fonts().mono, 0);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    ImGui::GetWindowDrawList()->AddText({at.x, at.y + (whole ? (button_side() - font) / 2 : 0)},
                                        ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
    ImGui::PopFont();
    ImGui::Dummy({size.x, std::max(size.y, button_side())});
    tooltip("Simulated time, whole frames since the start, and the substeps taken of the next frame");
}

/// Seconds before the line's end that can be gone back to without a gap.
double reach(const timeline::Overview& o, const FrameAxis& axis) {
    if (o.reachable.empty())
        return 0;
    return std::max(0.0, o.end_time - axis.time_of(static_cast<double>(o.reachable.back().first)));
}

float popup_width() {
    return ImGui::GetFontSize() * 18;
}

void used_bar(std::size_t bytes, std::size_t most) {
    ImGui::ProgressBar(most > 0 ? static_cast<float>(bytes) / static_cast<float>(most) : 0.f, {popup_width(), 0},
                       (megabytes(bytes) + " of " + megabytes(most)).c_str());
}

void cache_popup(Lab& lab, const timeline::Overview& o, const FrameAxis& axis) {
    if (!ImGui::BeginPopup("cache"))
        return;
    ImGui::TextUnformatted("Memory for the timeline");
    used_bar(o.memory, o.budget);
    ImGui::TextUnformatted("On disk, what memory has no room for");
    used_bar(o.on_disk, o.disk);
    if (!o.disk_trouble.empty()) {
        ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + popup_width());
        ImGui::TextColored(colour::warning, "The disk cannot be used as it should: %s", o.disk_trouble.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::Text("Reaches back %.1f s without a gap; %zu frames are stored.", reach(o, axis), o.keyframes.size());
    TimelineView& view = lab.timeline_view;
    if (ImGui::IsWindowAppearing()) {
        view.budget_mb = static_cast<int>(o.budget >> 20);
        view.disk_mb = static_cast<int>(o.disk >> 20);
        view.least_reach_s = static_cast<int>(o.least_reach_s);
    }
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 9);
    ImGui::InputInt("MB in memory", &view.budget_mb, 0);
    tooltip(
        "From 16 MB to 64 GB. Where the states do not fit, older ones are thinned out, then moved to the disk, then "
        "dropped; marked and bookmarked ones go last.");
    view.budget_mb = std::clamp(view.budget_mb, 16, 65536);
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 9);
    ImGui::InputInt("MB on disk", &view.disk_mb, 0);
    tooltip("0 to 1 TB, in the folder that TMPDIR names, or /var/tmp. The file has no name, and is gone when the lab "
            "ends.");
    view.disk_mb = std::clamp(view.disk_mb, 0, 1 << 20);
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 9);
    ImGui::InputInt("s at least, even if slow to go to", &view.least_reach_s, 0);
    tooltip("0: what would be slow to go to is dropped when the memory is used up. Otherwise so many of the newest "
            "seconds are kept as far as they fit, though going to a moment of theirs may take four times as long, or "
            "as long as its whole frame. The disk is used first.");
    view.least_reach_s = std::clamp(view.least_reach_s, 0, 86400);
    const auto bytes = static_cast<std::size_t>(view.budget_mb) << 20;
    const auto disk = static_cast<std::size_t>(view.disk_mb) << 20;
    const bool same = bytes == o.budget && disk == o.disk && view.least_reach_s == o.least_reach_s;
    ImGui::BeginDisabled(same && o.disk_trouble.empty());
    if (ImGui::Button(same && !o.disk_trouble.empty() ? "Try again###Set" : "Set###Set"))
        ask_timeline(lab, SetCacheBudget{bytes, static_cast<double>(view.least_reach_s), disk});
    ImGui::EndDisabled();
    ImGui::EndPopup();
}

void cache_bar(Lab& lab, float width) {
    if (!lab.timeline.overview) {
        ImGui::Dummy({width, button_side()});
        return;
    }
    const timeline::Overview& o = *lab.timeline.overview;
    const FrameAxis axis(o, lab.timeline.playhead);
    const bool wide = width > 1.5f * button_side();
    char text[48] = ICON_FA_DATABASE;
    if (wide)
        std::snprintf(text, sizeof text, ICON_FA_DATABASE " %.0f s", reach(o, axis));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, ImGui::GetStyle().FramePadding.y});
    if (ImGui::Button((std::string(text) + "###cache").c_str(), {width, button_side()}))
        ImGui::OpenPopup("cache");
    ImGui::PopStyleVar();
    const float share = o.budget > 0 ? std::min(1.f, static_cast<float>(o.memory) / static_cast<float>(o.budget)) : 0;
    const float line = std::max(2.f, button_side() / 9);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled({at.x, at.y + button_side() - line}, {at.x + width * share, at.y + button_side()},
                        ImGui::GetColorU32(colour::accent), line / 2);
    char help[240];
    std::snprintf(help, sizeof help,
                  "The timeline uses %s of %s, and %s of a disk, and reaches back %.1f s from the line's end. Click to "
                  "change that.",
                  megabytes(o.memory).c_str(), megabytes(o.budget).c_str(), megabytes(o.on_disk).c_str(),
                  reach(o, axis));
    tooltip(help);
    cache_popup(lab, o, axis);
}

} // namespace

std::string megabytes(std::size_t bytes) {
    const double mb = static_cast<double>(bytes) / (1 << 20);
    char text[32];
    std::snprintf(text, sizeof text, mb < 10 ? "%.1f MB" : "%.0f MB", mb);
    return text;
}

void change_speed(Lab& lab, bool faster) {
    if (faster) {
        const auto next = std::find_if(speeds.begin(), speeds.end(), [&](double s) { return s > lab.speed; });
        if (next != speeds.end())
            lab.ask(SetSpeed{*next});
    } else {
        const auto next = std::find_if(speeds.rbegin(), speeds.rend(), [&](double s) { return s < lab.speed; });
        if (next != speeds.rend())
            lab.ask(SetSpeed{*next});
    }
}

void draw_transport(Lab& lab) {
    const float font = ImGui::GetFontSize(), gap = std::floor(font / 5), space = font * 0.7f;
    const float group = 9 * button_side() + 8 * gap, room = ImGui::GetContentRegionAvail().x;
    const float with_text = ImGui::CalcTextSize(ICON_FA_ROTATE "  Restart").x + 2 * ImGui::GetStyle().FramePadding.x;
    // Texts become shorter where that makes a single line of it; otherwise there are several.
    float restart_width = with_text, cache_width = font * 5, speed = font * 6.4f;
    bool brief = false;
    float moment = mono_width(moment_text(lab, true, brief));
    const auto too_wide = [&] { return group + restart_width + speed + moment + cache_width + 4 * space > room; };
    if (too_wide())
        restart_width = button_side();
    if (too_wide())
        cache_width = button_side();
    if (too_wide())
        speed = font * 4.6f;
    if (too_wide()) {
        brief = true;
        moment = mono_width(moment_text(lab, true, brief));
    }
    if (too_wide()) {
        brief = false;
        moment = mono_width(moment_text(lab, true, brief));
        cache_width = moment + space + font * 5 <= room ? font * 5 : button_side();
        speed = font * 6.4f;
    }

    if (room >= group)
        ImGui::BeginGroup();
    buttons(lab, gap);
    if (room >= group)
        ImGui::EndGroup();
    Flow flow(space, true);
    flow.next(restart_width);
    restart(lab, restart_width == with_text, restart_width);
    flow.next(speed);
    speed_list(lab, std::min(speed, room), speed < font * 6);
    flow.next(moment);
    moment_cell(lab, brief, room);
    flow.next(cache_width);
    cache_bar(lab, cache_width);
}

} // namespace clothlab::ui
