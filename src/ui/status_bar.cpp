// The line at the bottom: how far the simulation is, how fast, and whether it is well.
#include <cstdio>
#include <imgui.h>
#include <imgui_internal.h> // BeginViewportSideBar

#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

/// A label in grey and its value; what does not fit into the window any more is left out.
void cell(const char* label, const std::string& value, const std::string& help, ImVec4 tint = colour::text) {
    ImGui::PushFont(fonts().mono, 0);
    const float value_width = ImGui::CalcTextSize(value.c_str()).x;
    ImGui::PopFont();
    const float width = ImGui::CalcTextSize(label).x + value_width + ImGui::GetStyle().ItemInnerSpacing.x;
    if (ImGui::GetCursorPosX() + width > ImGui::GetWindowWidth())
        return;
    ImGui::BeginGroup();
    ImGui::TextColored(colour::faint, "%s", label);
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::PushStyleColor(ImGuiCol_Text, tint);
    mono_text("%s", value.c_str());
    ImGui::PopStyleColor();
    ImGui::EndGroup();
    tooltip(help);
    ImGui::SameLine(0, ImGui::GetFontSize() * 1.3f);
}

std::string print(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// Two digits or more.
std::string microseconds(double seconds) {
    return print(seconds < 10e-6 ? "%.1f µs" : "%.0f µs", seconds * 1e6);
}

std::string stage_table(const sim::Snapshot& s) {
    std::string text = "Wall time per step, by stage:";
    for (std::size_t i = 0; i < sim::stage_names.size(); ++i)
        text += "\n" + print("%8.1f µs  ", s.seconds_per_step[i] * 1e6) + sim::stage_names[i];
    if (s.seconds_per_step[static_cast<std::size_t>(sim::Stage::integrate)] == 0)
        text += "\nForces and integration are one pass over the points.";
    text += "\nInstructions: " + std::string(sim::instruction_sets()[static_cast<std::size_t>(s.instructions)].name) +
            ", threads: " + std::to_string(s.threads) + " (as many as are found to be fastest)";
    return text;
}

void cells(Lab& lab, const sim::Snapshot& s) {
    const sim::Diagnostics& d = s.diagnostics;
    if (d.status == sim::Status::diverged) {
        cell(ICON_FA_TRIANGLE_EXCLAMATION, "diverged", d.cause, colour::error);
    } else if (d.status == sim::Status::jitter) {
        cell(ICON_FA_TRIANGLE_EXCLAMATION, lab.playing ? "jitters" : "jitters, paused", d.cause, colour::warning);
    } else {
        cell(lab.playing ? ICON_FA_PLAY : ICON_FA_PAUSE, lab.playing ? "playing" : "paused ",
             "The state of the simulation");
    }
    cell("time", print("%.3f s", s.time), "Simulated time since the start");
    if (lab.playing && lab.real_time_factor > 0)
        cell("speed", print("%.2f x real time", lab.real_time_factor),
             "Simulated seconds per second, over the last half second",
             lab.real_time_factor < 0.95 * lab.speed ? colour::warning : colour::text);
    double step = 0;
    for (const double seconds : s.seconds_per_step)
        step += seconds;
    if (step > 0) // no step was taken since the state was last shown
        cell("step", microseconds(step), stage_table(s));
    for (std::size_t i = 0; i < sim::stage_names.size() && step > 0; ++i)
        if (s.seconds_per_step[i] > 0) {
            static constexpr const char* short_names[] = {"forces", "method", "self", "colliders", "limit"};
            cell(short_names[i], microseconds(s.seconds_per_step[i]), stage_table(s));
        }
    cell("energy", print("%.2f J", d.energy.total()),
         "Total energy; gravity's part is zero at the origin.\n" + print("kinetic %.4g J\n", d.energy.kinetic) +
             print("springs %.4g J\n", d.energy.spring) + print("gravity %.4g J", d.energy.gravity));
    cell("strain", print("%.1f %%", 100 * d.max_strain), "Largest elongation of any spring",
         d.max_strain > 0.15 ? colour::warning : colour::text);
    if (lab.playing) // paused, the window rests on purpose
        cell("UI", print("%.0f fps", static_cast<double>(ImGui::GetIO().Framerate)),
             "Pictures of this window per second");
}

} // namespace

void draw_status_bar(Lab& lab) {
    const float height = ImGui::GetFrameHeight() + 4;
    const ImGuiWindowFlags flags =
        ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_MenuBar;
    lab.status_bar_drawn = false;
    if (ImGui::BeginViewportSideBar("##status", ImGui::GetMainViewport(), ImGuiDir_Down, height, flags)) {
        if (ImGui::BeginMenuBar()) {
            lab.status_bar_drawn = true;
            if (lab.snapshot)
                cells(lab, *lab.snapshot);
            else
                ImGui::TextColored(colour::faint, "building the cloth ...");
            ImGui::EndMenuBar();
        }
    }
    ImGui::End();
}

} // namespace clothlab::ui
