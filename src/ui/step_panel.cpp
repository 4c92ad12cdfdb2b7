// The inside of the next step: its stages one by one, as numbers, and as arrows in the viewport.
#include "ui/step_panel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/integrators/integrator.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/step_tables.h"
#include "ui/step_view.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

constexpr const char* stage_help[] = {
    "The forces that the step begins with: springs, gravity, wind, and damping where it is a force. They move nothing "
    "yet. Position-based methods move points by constraints in place of the springs' forces.",
    "The method moves the points: ", "Points of the cloth that are too near to each other are pushed apart.",
    "Points inside or behind a collider are put out of it.",
    "Springs that are longer than the limit allows are shortened."};

void show_stage(Lab& lab, int stage) {
    lab.timeline.stage = stage;
}

std::string help_of(const Lab& lab, std::size_t stage, bool active) {
    std::string help = stage_help[stage];
    if (stage == static_cast<std::size_t>(sim::Stage::integrate))
        help += std::string(sim::traits(lab.scene.simulation.stepping.integrator).title) + ".";
    return active ? help : help + " This scene has no such stage.";
}

/// A button for a stage, or, without one, for the state before the step.
void stage_button(Lab& lab, int stage, const char* title, bool active, const std::string& help) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const bool shown = lab.timeline.stage == stage;
    const float swatch = stage < 0 ? 0 : ImGui::GetFontSize() * 0.7f;
    const float width =
        ImGui::CalcTextSize(title).x + 2 * style.FramePadding.x + (stage < 0 ? 0 : swatch + style.ItemInnerSpacing.x);
    if (width > ImGui::GetContentRegionAvail().x)
        ImGui::NewLine();
    ImGui::BeginDisabled(!active);
    if (shown)
        ImGui::PushStyleColor(ImGuiCol_Button, style.Colors[ImGuiCol_ButtonActive]);
    ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, {1, 0.5f});
    if (ImGui::Button((std::string(title) + "###stage" + std::to_string(stage)).c_str(), {width, 0}))
        show_stage(lab, stage);
    ImGui::PopStyleVar();
    if (shown)
        ImGui::PopStyleColor();
    ImGui::EndDisabled();
    tooltip(help);
    if (stage >= 0) {
        const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
        const float y = (low.y + high.y - swatch) / 2, x = low.x + style.FramePadding.x;
        ImGui::GetWindowDrawList()->AddRectFilled({x, y}, {x + swatch, y + swatch},
                                                  stage_tint(static_cast<std::size_t>(stage), active), 2);
    }
    ImGui::SameLine(0, style.ItemInnerSpacing.x);
}

void stage_row(Lab& lab, const sim::StepTrace& trace) {
    TimelineWork& work = lab.timeline;
    const int before = next_stage(trace, work.stage, -1), after = next_stage(trace, work.stage, 1);
    if (icon_button(ICON_FA_CHEVRON_LEFT, "##previous stage", "The stage before (Ctrl+Left)", work.stage >= 0))
        show_stage(lab, before);
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    if (icon_button(ICON_FA_CHEVRON_RIGHT, "##next stage", "The next stage (Ctrl+Right)", after != work.stage))
        show_stage(lab, after);
    ImGui::SameLine();
    stage_button(lab, -1, "Before", true, "The state that the step begins with.");
    for (std::size_t s = 0; s < stage_titles.size(); ++s)
        stage_button(lab, static_cast<int>(s), stage_titles[s], trace.active[s], help_of(lab, s, trace.active[s]));
    const char* take = ICON_FA_CHECK "  Take this step";
    const float width = ImGui::CalcTextSize(take).x + 2 * ImGui::GetStyle().FramePadding.x;
    if (width > ImGui::GetContentRegionAvail().x)
        ImGui::NewLine();
    if (ImGui::Button((std::string(take) + "###take").c_str())) {
        lab.ask(StepSubstep{});
        work.stage = -1;
    }
    tooltip("Takes the step, so that the next one can be looked into (Shift+N).");
}

void stage_keys(Lab& lab, const sim::StepTrace& trace) {
    if (ImGui::GetIO().WantTextInput)
        return;
    for (const auto& [arrow, direction] : {std::pair{ImGuiKey_LeftArrow, -1}, {ImGuiKey_RightArrow, 1}})
        if (ImGui::Shortcut(ImGuiMod_Ctrl | arrow, ImGuiInputFlags_RouteGlobal | ImGuiInputFlags_Repeat))
            show_stage(lab, next_stage(trace, lab.timeline.stage, direction));
}

void fit_arrows(Lab& lab, const sim::StepTrace& trace) {
    TimelineWork& work = lab.timeline;
    if (!work.fit_arrows || work.stage < 0)
        return;
    const double spacing = mean_spacing(lab.snapshot->columns, lab.snapshot->rows, trace.before);
    if (const auto scale = fitting_scale(trace, static_cast<sim::Stage>(work.stage), work.picked, spacing))
        work.arrow_scale = *scale;
}

void arrow_row(Lab& lab, const sim::StepTrace& trace) {
    TimelineWork& work = lab.timeline;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Arrows");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 10);
    if (ImGui::SliderFloat("##arrow scale", &work.arrow_scale, 0.1f, 1000, "x %.4g", ImGuiSliderFlags_Logarithmic))
        work.fit_arrows = false;
    tooltip("How many times longer than the motion the arrows are drawn. A point's motion in one step is mostly much "
            "shorter than a pixel.");
    ImGui::SameLine();
    ImGui::Checkbox("Fit", &work.fit_arrows);
    tooltip("Each stage's arrows are drawn one and a half times as long as neighbours are apart, in the root mean "
            "square, and none over six times; a picked point's five times.");
    if (work.stage < 0) {
        ImGui::TextColored(colour::faint, "The state before the step: no arrows.");
        return;
    }
    ImGui::PushTextWrapPos(0);
    ImGui::PushStyleColor(ImGuiCol_Text, colour::faint);
    if (work.stage == static_cast<int>(sim::Stage::forces)) {
        const double newton = 0.01 * trace.mass / (static_cast<double>(work.arrow_scale) * trace.dt * trace.dt);
        ImGui::Text("An arrow is what the force alone moves the point in this step, f dt²/m, times %.4g: "
                    "1 cm in the scene is %.3g N.",
                    static_cast<double>(work.arrow_scale), newton);
    } else {
        ImGui::Text("An arrow is what the stage moved the point, times %.4g: 1 cm in the scene is %.3g mm.",
                    static_cast<double>(work.arrow_scale), 10 / static_cast<double>(work.arrow_scale));
    }
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
}

void point_row(Lab& lab, const sim::StepTrace& trace) {
    TimelineWork& work = lab.timeline;
    const int columns = lab.snapshot->columns, rows = lab.snapshot->rows;
    const auto index = static_cast<int>(work.picked.value_or(0));
    int column = index % columns, row = index / columns;
    const float width = ImGui::GetFontSize() * 5.6f;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Point");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(width);
    bool changed = ImGui::InputInt("column", &column);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(width);
    changed |= ImGui::InputInt("row", &row);
    tooltip("Shift+click in the viewport picks a point too.");
    if (changed)
        work.picked =
            static_cast<std::uint32_t>(std::clamp(row, 0, rows - 1) * columns + std::clamp(column, 0, columns - 1));
    ImGui::BeginDisabled(work.stage < 0);
    if (ImGui::Button("Furthest"))
        work.picked = work.stage == 0 ? strongest(trace) : trace.furthest[static_cast<std::size_t>(work.stage)];
    ImGui::EndDisabled();
    tooltip("Picks the point that this stage moved furthest, or the one with the largest force.");
    ImGui::SameLine();
    ImGui::BeginDisabled(!work.picked);
    if (ImGui::Button("All points"))
        work.picked.reset();
    ImGui::EndDisabled();
    tooltip("Shows the arrows of all points again.");
}

} // namespace

void draw_step(Lab& lab) {
    if (!lab.snapshot)
        return;
    TimelineWork& work = lab.timeline;
    if (lab.playing) {
        ImGui::PushTextWrapPos(0);
        ImGui::TextUnformatted("The next step can be looked into while the run is paused.");
        ImGui::PopTextWrapPos();
        if (ImGui::Button(ICON_FA_PAUSE "  Pause###pause"))
            lab.ask(Play{false});
        return;
    }
    const sim::StepTrace* trace = shown_trace(lab);
    if (!trace) {
        ImGui::TextColored(colour::faint, "looking into the step ...");
        return;
    }
    if (work.picked && *work.picked >= trace->before.size() / 3)
        work.picked.reset();
    if (work.stage >= 0 && !trace->active[static_cast<std::size_t>(work.stage)])
        work.stage = next_stage(*trace, work.stage, -1);
    stage_keys(lab, *trace);
    const sim::Snapshot& s = *lab.snapshot;
    mono_text("frame %llu, substep %d to %d of %d", static_cast<unsigned long long>(s.frame), s.substep, s.substep + 1,
              s.substeps);
    ImGui::SameLine();
    ImGui::TextColored(colour::faint, "dt %.4g µs", trace->dt * 1e6);
    stage_row(lab, *trace);
    fit_arrows(lab, *trace);
    arrow_row(lab, *trace);
    draw_stage_table(lab, *trace);
    point_row(lab, *trace);
    if (work.picked)
        draw_point_table(*trace, *work.picked);
}

void follow_step_panel(Lab& lab) {
    TimelineWork& work = lab.timeline;
    const bool wanted = lab.report[static_cast<std::size_t>(PanelId::step)].drawn && !lab.playing;
    if (lab.playing)
        work.stage = -1;
    if (wanted == work.inspecting)
        return;
    work.inspecting = wanted;
    lab.ask(TimelineRequest{InspectStep{wanted}});
}

void draw_step_in_viewport(Lab& lab, ImVec2 corner, ImVec2 size) {
    const sim::StepTrace* trace = shown_trace(lab);
    if (!trace)
        return;
    TimelineWork& work = lab.timeline;
    const ImGuiIO& io = ImGui::GetIO();
    const bool click = ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left) && io.KeyShift &&
                       io.MouseDragMaxDistanceSqr[0] < io.MouseDragThreshold * io.MouseDragThreshold;
    if (click) {
        const auto& positions = work.stage < 0 ? trace->before : trace->after[static_cast<std::size_t>(work.stage)];
        if (const auto point = pick_point(scene::camera_of(lab.scene), size.x, size.y, positions,
                                          io.MousePos.x - corner.x, io.MousePos.y - corner.y))
            work.picked = point;
    }
    if (work.stage < 0 || lab.output.recording) // whose badge is there
        return;
    const auto stage = static_cast<std::size_t>(work.stage);
    char text[96];
    std::snprintf(text, sizeof text, "Inside step %llu: %s, arrows x %.4g",
                  static_cast<unsigned long long>(trace->step + 1), stage_titles[stage],
                  static_cast<double>(work.arrow_scale));
    const float pad = ImGui::GetStyle().WindowPadding.x, swatch = ImGui::GetFontSize() * 0.7f;
    const ImVec2 at{corner.x + pad, corner.y + size.y - pad - ImGui::GetTextLineHeight()};
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float y = at.y + (ImGui::GetTextLineHeight() - swatch) / 2;
    list->AddRectFilled({at.x, y}, {at.x + swatch, y + swatch}, stage_tint(stage, true), 2);
    list->AddText({at.x + 1.6f * swatch, at.y}, ImGui::GetColorU32(ImGuiCol_Text), text);
}

} // namespace clothlab::ui
