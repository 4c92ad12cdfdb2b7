// Play, pause, step, restart.
#include <algorithm>
#include <cstdio>
#include <imgui.h>

#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

bool wide_button(const char* label, const char* help, bool accent = false) {
    if (accent)
        ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.68f, 0.32f, 0.21f, 1));
    const bool pressed = ImGui::Button(label, {0, ImGui::GetFrameHeight() * 1.25f});
    if (accent)
        ImGui::PopStyleColor();
    tooltip(help);
    ImGui::SameLine();
    return pressed;
}

void speed_list(Lab& lab) {
    static constexpr double speeds[] = {1.0 / 64, 1.0 / 16, 1.0 / 4, 1.0 / 2, 1, 2, 4, 16};
    const auto name = [](double speed) {
        char text[24];
        if (speed < 1)
            std::snprintf(text, sizeof text, "1/%.0f speed", 1 / speed);
        else
            std::snprintf(text, sizeof text, "%.0f x speed", speed);
        return std::string(text);
    };
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 8);
    if (ImGui::BeginCombo("##speed", name(lab.speed).c_str())) {
        for (const double speed : speeds)
            if (ImGui::Selectable(name(speed).c_str(), speed == lab.speed))
                lab.ask(SetSpeed{speed});
        ImGui::EndCombo();
    }
    tooltip("Simulated seconds per second. The status bar shows what is reached.");
}

} // namespace

void draw_transport(Lab& lab) {
    if (wide_button(ICON_FA_BACKWARD_STEP "  Restart", "Back to the start (R)"))
        lab.ask(Restart{});
    const bool playing = lab.playing;
    if (wide_button(playing ? ICON_FA_PAUSE "  Pause###play" : ICON_FA_PLAY "  Play###play",
                    "Play or pause (Space or P)", !playing))
        lab.ask(Play{!playing});
    if (wide_button(ICON_FA_FORWARD_STEP "  Frame", "One frame further (N); pauses"))
        lab.ask(StepFrame{});
    if (wide_button(ICON_FA_CHEVRON_RIGHT "  Substep", "One substep further (Shift+N); pauses"))
        lab.ask(StepSubstep{});
    speed_list(lab);
    if (!lab.snapshot)
        return;
    const sim::Snapshot& s = *lab.snapshot;
    ImGui::SameLine(0, ImGui::GetFontSize());
    mono_text("%.3f s  frame %llu + %d/%d", s.time, static_cast<unsigned long long>(s.frame), s.substep, s.substeps);
    tooltip("Simulated time, whole frames since the start, and the substeps taken of the next frame");
}

} // namespace clothlab::ui
