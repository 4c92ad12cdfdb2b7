#include "ui/experiment_rows.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "experiments/page.h"
#include "scene/fields.h"
#include "scene/number_text.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

struct AxisKey {
    std::string key, title;
    bool categorical = false;
    const scene::Field* field = nullptr; ///< of numbers
};

/// What can be varied: names that the stability experiment has for itself, then the simulation's parameters.
std::vector<AxisKey> axis_keys(bool categorical) {
    std::vector<AxisKey> keys;
    if (categorical)
        keys = {
            {"springs", "Kinds of springs", true}, {"limiter", "Stretch limit", true}, {"method", "Integrator", true}};
    for (const scene::Field& field : scene::fields())
        if ((field.type == scene::FieldType::number || field.type == scene::FieldType::integer) &&
            field.effect != scene::Effect::look)
            keys.push_back({std::string(field.key), std::string(field.label), false, &field});
    return keys;
}

const AxisKey* find_key(const std::vector<AxisKey>& keys, const std::string& key) {
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const AxisKey& k) { return k.key == key; });
    return found == keys.end() ? nullptr : &*found;
}

/// A range around what the scene has.
void suggest_range(const Lab& lab, const scene::Field& field, AxisChoice& axis) {
    const double now = field.get(lab.scene);
    const auto within = [&](double value) { return std::clamp(value, field.allowed.min, field.allowed.max); };
    axis.log = field.shown.scale == scene::Scale::logarithmic && now > 0;
    axis.from = within(axis.log ? now / 10 : now > 0 ? now / 4 : now - 1);
    axis.to = within(axis.log ? now * 10 : now > 0 ? now * 4 : now + 1);
    if (field.type == scene::FieldType::integer) {
        axis.from = std::max(1.0, std::round(axis.from));
        axis.to = std::round(axis.to);
    }
}

} // namespace

void form_label(const char* label, const char* help) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label);
    tooltip(help);
    ImGui::SameLine(ImGui::GetFontSize() * 8.6f);
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 0.5f);
}

void form_number(const char* label, const char* help, double& value, double least, const char* format) {
    form_label(label, help);
    double edited = value;
    if (ImGui::InputDouble((std::string("##") + label).c_str(), &edited, 0, 0, format,
                           ImGuiInputTextFlags_EnterReturnsTrue) ||
        ImGui::IsItemDeactivatedAfterEdit())
        if (std::isfinite(edited) && edited >= least)
            value = edited;
    tooltip(help);
}

void form_whole(const char* label, const char* help, int& value, int least, int most) {
    form_label(label, help);
    int edited = value;
    if (ImGui::InputInt((std::string("##") + label).c_str(), &edited, 0, 0))
        value = std::clamp(edited, least, most);
    tooltip(help);
}

void form_choice(const char* label, const char* help, int& value, const std::vector<std::string>& names) {
    form_label(label, help);
    if (ImGui::BeginCombo((std::string("##") + label).c_str(), names[static_cast<std::size_t>(value)].c_str())) {
        for (std::size_t i = 0; i < names.size(); ++i)
            if (ImGui::Selectable(names[i].c_str(), static_cast<int>(i) == value))
                value = static_cast<int>(i);
        ImGui::EndCombo();
    }
    tooltip(help);
}

void form_axis_key(Lab& lab, const char* label, AxisChoice& axis, bool categorical) {
    const std::vector<AxisKey> keys = axis_keys(categorical);
    const AxisKey* found = find_key(keys, axis.key);
    form_label(label, "What is varied");
    if (!ImGui::BeginCombo((std::string("##") + label).c_str(), found ? found->title.c_str() : axis.key.c_str()))
        return;
    for (const AxisKey& key : keys) {
        if (ImGui::Selectable((key.title + "###" + key.key).c_str(), key.key == axis.key)) {
            axis.key = key.key;
            axis.list.clear();
            if (key.field)
                suggest_range(lab, *key.field, axis);
        }
        tooltip(key.key);
    }
    ImGui::EndCombo();
}

void form_axis(Lab& lab, const char* label, AxisChoice& axis, bool categorical, bool count) {
    ImGui::PushID(label);
    form_axis_key(lab, label, axis, categorical);
    const std::vector<AxisKey> keys = axis_keys(categorical);
    const AxisKey* found = find_key(keys, axis.key);
    if (found && found->categorical) {
        form_label("", "");
        ImGui::InputTextWithHint("##list", "all of them", &axis.list);
        tooltip("Some of them, separated by commas, as the command line has them; empty: all");
        ImGui::PopID();
        return;
    }
    const std::string unit = found ? std::string(found->field->unit) : "";
    const std::string help = "The first and the last value" + (unit.empty() ? "" : ", in " + unit);
    form_label(unit.empty() ? "  from, to" : ("  from, to (" + unit + ")").c_str(), help.c_str());
    const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetFontSize() * 0.9f) / 2;
    ImGui::SetNextItemWidth(width);
    ImGui::InputDouble("##from", &axis.from, 0, 0, "%.6g");
    tooltip(help);
    ImGui::SameLine(0, ImGui::GetFontSize() * 0.4f);
    ImGui::SetNextItemWidth(width);
    ImGui::InputDouble("##to", &axis.to, 0, 0, "%.6g");
    tooltip(help);
    form_label("", "");
    if (count) {
        ImGui::SetNextItemWidth(width);
        ImGui::InputInt("##count", &axis.count, 0, 0);
        axis.count = std::clamp(axis.count, 2, 1000);
        tooltip("How many values");
        ImGui::SameLine(0, ImGui::GetFontSize() * 0.4f);
    }
    ImGui::Checkbox("log", &axis.log);
    tooltip("From each value to the next the same factor, rather than the same difference");
    ImGui::PopID();
}

std::string axis_text(const AxisChoice& axis, bool count) {
    const std::vector<AxisKey> keys = axis_keys(true);
    const AxisKey* found = find_key(keys, axis.key);
    if (found && found->categorical)
        return axis.key + (axis.list.empty() ? "" : "=" + axis.list);
    return axis.key + "=" + scene::shortest_text(axis.from) + ":" + scene::shortest_text(axis.to) +
           (count ? ":" + std::to_string(axis.count) : "") + (axis.log ? "log" : "");
}

RunExperiment experiment_request(ExperimentKind kind, const std::vector<std::string>& options,
                                 std::function<experiments::Findings(const experiments::Progress&)> work) {
    const std::string name = experiment_names[static_cast<std::size_t>(kind)];
    std::string command = "clothlab experiment " + name + " " + name + "-scene.json";
    for (const std::string& option : options)
        command += " " + experiments::shell_word(option);
    return {kind, std::move(work), std::move(command)};
}

} // namespace clothlab::ui
