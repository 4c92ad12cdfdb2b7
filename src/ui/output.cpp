#include "ui/output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/icons.h"
#include "ui/lab.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

constexpr int max_side = 16384;

std::string print(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

void size_row(Lab& lab, Output& o) {
    struct Preset {
        const char* name;
        int width, height;
    };
    static constexpr Preset presets[] = {{"HD, 1280 x 720", 1280, 720},
                                         {"Full HD, 1920 x 1080", 1920, 1080},
                                         {"4K, 3840 x 2160", 3840, 2160},
                                         {"Square, 1080 x 1080", 1080, 1080}};
    int size[2] = {o.as_viewport ? lab.viewport_width : o.width, o.as_viewport ? lab.viewport_height : o.height};
    const auto choose = [&o](int width, int height) {
        o.as_viewport = false;
        o.width = std::clamp(width, 1, max_side);
        o.height = std::clamp(height, 1, max_side);
    };
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 9);
    if (ImGui::InputInt2("##size", size))
        choose(size[0], size[1]);
    tooltip("Width and height in pixels, each from 1 to 16384; the viewport may be smaller");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 12);
    if (!ImGui::BeginCombo("##presets", o.as_viewport ? "px, as the viewport" : "px"))
        return;
    if (ImGui::Selectable("As the viewport", o.as_viewport))
        o.as_viewport = true;
    for (const Preset& p : presets)
        if (ImGui::Selectable(p.name, !o.as_viewport && o.width == p.width && o.height == p.height))
            choose(p.width, p.height);
    ImGui::EndCombo();
}

void file_row(const char* id, std::string& file, const std::string& objection) {
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 24);
    ImGui::InputText(id, &file);
    tooltip("The file, in the current folder unless the name begins with another");
    if (!objection.empty())
        ImGui::TextColored(colour::warning, ICON_FA_TRIANGLE_EXCLAMATION "  %s", objection.c_str());
}

void picture_section(Lab& lab, Output& o) {
    ImGui::SeparatorText("Picture");
    ImGui::Checkbox("With the panels", &o.with_panels);
    tooltip("The whole window as it is, of the window's size. Other sizes: clothlab render --ui --size WxH");
    ImGui::PushID("picture");
    file_row("##file", o.picture_file, o.picture_objection);
    const bool replaces = !o.picture_objection.empty();
    if (ImGui::Button(replaces ? ICON_FA_CAMERA "  Replace###save" : ICON_FA_CAMERA "  Save picture###save"))
        lab.ask(TakePicture{o.picture_file, replaces});
    tooltip("F12 saves under the next free name without asking");
    ImGui::PopID();
}

void speed_combo(Output& o) {
    static constexpr double speeds[] = {1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0 / 2, 1, 2, 4};
    const auto name = [](double speed) { return speed < 1 ? print("1/%.0f", 1 / speed) : print("%.0f x", speed); };
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 5);
    if (ImGui::BeginCombo("Speed", name(o.speed).c_str())) {
        for (const double speed : speeds)
            if (ImGui::Selectable(name(speed).c_str(), speed == o.speed))
                o.speed = speed;
        ImGui::EndCombo();
    }
    tooltip("Simulated seconds per second of film");
}

void rate_combo(Output& o) {
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 4);
    if (ImGui::BeginCombo("Frames/s", std::to_string(o.fps).c_str())) {
        for (const int fps : {24, 25, 30, 50, 60})
            if (ImGui::Selectable(std::to_string(fps).c_str(), fps == o.fps))
                o.fps = fps;
        ImGui::EndCombo();
    }
    tooltip("Pictures per second of film that you would like; below is what the simulation's whole frames give");
}

void describe(const Output& o, double frames_per_second) {
    const Pace p = pace(o, frames_per_second);
    std::string text = p.every == 1 ? "Every frame" : "One of " + std::to_string(p.every) + " frames";
    text += print(": %.4g pictures/s, ", p.rate) +
            (p.pictures == 0 ? "until you stop it" : std::to_string(p.pictures) + " pictures");
    ImGui::TextColored(colour::faint, "%s", text.c_str());
}

void progress(Lab& lab, const RecordingStatus& r) {
    const std::string text = std::to_string(r.pictures) + (r.of > 0 ? " of " + std::to_string(r.of) : " so far") +
                             (r.paused ? ", paused" : "");
    ImGui::ProgressBar(r.of > 0 ? static_cast<float>(r.pictures) / static_cast<float>(r.of)
                                : -static_cast<float>(ImGui::GetTime()),
                       {ImGui::GetFontSize() * 24, 0}, text.c_str());
    tooltip(r.file);
    if (ImGui::Button(r.paused ? ICON_FA_PLAY "  Go on###pause" : ICON_FA_PAUSE "  Pause###pause"))
        lab.ask(Play{r.paused});
    ImGui::SameLine();
    if (ImGui::Button(ICON_FA_CIRCLE_STOP "  Stop and keep###stop"))
        lab.ask(EndRecording{true});
    ImGui::SameLine();
    if (ImGui::Button(ICON_FA_TRASH "  Cancel###cancel"))
        lab.ask(EndRecording{false});
    tooltip("Ends the recording and removes what it has written");
}

void recording_section(Lab& lab, Output& o) {
    ImGui::SeparatorText("Recording");
    ImGui::PushID("recording");
    if (o.recording) {
        progress(lab, *o.recording);
        ImGui::PopID();
        return;
    }
    if (ImGui::RadioButton("MP4 film", o.film))
        o.film = true;
    ImGui::SameLine();
    if (ImGui::RadioButton("PNG pictures", !o.film))
        o.film = false;
    tooltip("One file for each picture, numbered 0, 1, 2 ... where the name has %04d");
    file_row("##file", o.film ? o.film_file : o.sequence_file, o.recording_objection);
    rate_combo(o);
    ImGui::SameLine();
    speed_combo(o);
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 4);
    if (ImGui::InputDouble("s long", &o.seconds, 0, 0, "%.4g"))
        o.seconds = std::isfinite(o.seconds) ? std::clamp(o.seconds, 0.0, 86400.0) : 0;
    tooltip("Seconds of film; 0: until you stop it");
    ImGui::SameLine();
    ImGui::Checkbox("From the start", &o.from_start);
    tooltip("Restarts the run first; otherwise the recording begins with the state as it is now");
    describe(o, lab.scene.simulation.stepping.frames_per_second);
    const bool possible = !o.film || o.has_ffmpeg;
    if (!possible)
        ImGui::TextColored(colour::warning, ICON_FA_TRIANGLE_EXCLAMATION
                           "  A film needs the program ffmpeg (package ffmpeg).\nPNG pictures do not.");
    const bool replaces = !o.recording_objection.empty();
    ImGui::BeginDisabled(!possible);
    if (ImGui::Button(replaces ? ICON_FA_CIRCLE "  Record and replace###record" : ICON_FA_CIRCLE "  Record###record"))
        lab.ask(Record{replaces});
    ImGui::EndDisabled();
    tooltip("Every frame is drawn once, in order, however long that takes. Space pauses.");
    ImGui::PopID();
}

} // namespace

Pace pace(const Output& output, double frames_per_second) {
    const double per_film_second = frames_per_second * output.speed; // simulated frames
    const double every = std::clamp(std::round(per_film_second / output.fps), 1.0, 1e6);
    const double rate = per_film_second / every;
    const double pictures = output.seconds > 0 ? std::clamp(std::round(output.seconds * rate), 1.0, 1e9) : 0;
    return {static_cast<int>(every), rate, static_cast<int>(pictures)};
}

void draw_output_window(Lab& lab) {
    Output& o = lab.output;
    if (!o.open || o.hidden)
        return;
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_FirstUseEver, {0.5f, 0.5f});
    if (ImGui::Begin(ICON_FA_PHOTO_FILM "  Output###Output", &o.open,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoDocking | ImGuiWindowFlags_NoCollapse)) {
        ImGui::BeginDisabled(o.recording.has_value());
        size_row(lab, o);
        ImGui::Checkbox("Transparent background", &o.transparent);
        tooltip("PNG only: nothing but the cloth, the colliders and the pins. Films have no transparency.");
        ImGui::EndDisabled();
        picture_section(lab, o);
        recording_section(lab, o);
    }
    ImGui::End();
}

void draw_recording_badge(Lab& lab, float x, float bottom) {
    if (!lab.output.recording)
        return;
    const RecordingStatus& r = *lab.output.recording;
    const float pad = ImGui::GetStyle().WindowPadding.x;
    ImGui::SetCursorScreenPos({x + pad, bottom - pad - ImGui::GetFrameHeight()});
    ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.12f, 0.12f, 0.13f, 0.94f));
    ImGui::PushStyleColor(ImGuiCol_Text, colour::error);
    const std::string text = ICON_FA_CIRCLE "  Recording " + std::to_string(r.pictures) +
                             (r.of > 0 ? " of " + std::to_string(r.of) : "") + (r.paused ? ", paused" : "");
    if (ImGui::Button((text + "###recording").c_str()))
        lab.output.open = true;
    ImGui::PopStyleColor();
    tooltip("Opens the Output window: pause, stop and keep, cancel");
    ImGui::SameLine();
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, ImGui::GetStyle().FramePadding.y});
    if (icon_button(ICON_FA_CIRCLE_STOP, "##stop", "Stop and keep what was recorded"))
        lab.ask(EndRecording{true});
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

void output_keys(Lab& lab) {
    if (ImGui::Shortcut(ImGuiKey_F12, ImGuiInputFlags_RouteGlobal))
        lab.ask(TakePicture{});
    if (ImGui::Shortcut(ImGuiMod_Shift | ImGuiKey_F12, ImGuiInputFlags_RouteGlobal))
        lab.output.open = !lab.output.open;
}

} // namespace clothlab::ui
