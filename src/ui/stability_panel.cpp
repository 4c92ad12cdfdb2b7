// How far the present state is from the method's stability limit, and what has gone wrong.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <imgui.h>
#include <limits>

#include "sim/integrators/integrator.h"
#include "sim/units.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

std::string number(double value, const char* unit) {
    if (value == std::numeric_limits<double>::infinity())
        return "any";
    // Four digits, and no exponent as long as a lecturer can read it without.
    const double digits = value == 0 || !std::isfinite(value) ? 0 : std::floor(std::log10(std::abs(value))) - 3;
    const double unit_in_last_place = std::pow(10.0, std::max(digits, 0.0));
    char text[48];
    if (digits > 0 && digits < 6)
        std::snprintf(text, sizeof text, "%.0f%s%s", std::round(value / unit_in_last_place) * unit_in_last_place,
                      *unit ? " " : "", unit);
    else
        std::snprintf(text, sizeof text, "%.4g%s%s", value, *unit ? " " : "", unit);
    return text;
}

/// What is, and how far it may go.
void row(const char* label, const std::string& now, const char* sign, const std::string& limit, const char* help,
         bool good) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(label);
    tooltip(help);
    ImGui::TableNextColumn();
    mono_text("%s", now.c_str());
    ImGui::TableNextColumn();
    ImGui::TextColored(colour::faint, "%s", sign);
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, good ? colour::text : colour::error);
    mono_text("%s", limit.c_str());
    ImGui::PopStyleColor();
    tooltip(help);
}

void bar(const sim::StabilityMargin& m) {
    char text[96];
    if (std::isinf(m.limit))
        std::snprintf(text, sizeof text, "omega dt %.3g: no limit", m.omega_dt);
    else
        std::snprintf(text, sizeof text, "omega dt %.3g of %.4g", m.omega_dt, m.limit);
    const double share = std::isinf(m.limit) ? 0 : m.limit > 0 ? m.omega_dt / m.limit : 2;
    const ImVec4 tint = !m.stable() ? colour::error : share > 0.9 ? colour::warning : colour::accent;
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, tint);
    ImGui::ProgressBar(static_cast<float>(std::clamp(share, 0.0, 1.0)), {-1, 0}, text);
    ImGui::PopStyleColor();
    tooltip(
        "omega is the fastest oscillation that the cloth's springs can make in its present pose, dt the length of a "
        "step. Beyond the method's limit that oscillation grows in every step.");
}

void margin(const Lab& lab, const sim::Snapshot& s, const sim::StabilityMargin& m) {
    const sim::Description& d = lab.scene.simulation;
    bar(m);
    if (!ImGui::BeginTable("margin", 4, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings))
        return;
    const bool good = m.stable();
    row("Step dt", number(s.dt * 1e6, "µs"), "up to", number(m.dt_max * 1e6, "µs"),
        "The longest step that this method can take here, everything else being equal.", good);
    row("Substeps", number(d.stepping.substeps, ""), "from", number(m.substeps_min, ""),
        "The fewest substeps per frame that are stable.", good);
    row("Stiffness ks", number(d.cloth.ks, "N/m"), "up to", number(m.ks_max, "N/m"),
        "The stiffest springs that this step can carry.", good);
    row("Density", number(sim::grams_per_cm2(d.cloth.density), "g/cm²"), "from",
        m.density_min > 0 ? number(sim::grams_per_cm2(m.density_min), "g/cm²") : "any",
        "The lightest cloth that this step can carry.", good);
    row("omega", number(m.omega, "1/s"), "below", number(m.omega_bound, "1/s"),
        "Angular frequency of the fastest mode: an estimate by Lanczos' method, and a bound that holds for certain.",
        true);
    ImGui::EndTable();
}

void trouble(const sim::Trouble& t) {
    ImGui::PushStyleColor(ImGuiCol_Text, t.status == sim::Status::diverged ? colour::error : colour::warning);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted((std::string(ICON_FA_TRIANGLE_EXCLAMATION "  ") + t.cause).c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

} // namespace

void draw_stability(Lab& lab) {
    if (!lab.snapshot)
        return;
    const sim::Snapshot& s = *lab.snapshot;
    if (s.stability)
        margin(lab, s, *s.stability);
    else
        ImGui::TextColored(colour::faint, "measuring ...");
    bool blow_up = lab.pause_on_blow_up, jitter = lab.pause_on_jitter;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Pause on");
    ImGui::SameLine();
    const bool first = ImGui::Checkbox("blow-up", &blow_up);
    tooltip("Pause when positions are no longer numbers, or the cloth grows without bound.");
    ImGui::SameLine();
    const bool second = ImGui::Checkbox("jitter", &jitter);
    tooltip("Pause when the cloth shakes from step to step, held together only by the stretch limit.");
    if (first || second)
        lab.ask(PauseOnTrouble{blow_up, jitter});
    if (s.trouble)
        trouble(*s.trouble);
}

} // namespace clothlab::ui
