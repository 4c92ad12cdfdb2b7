#include "ui/widgets.h"

#include <cmath>
#include <cstdarg>
#include <imgui.h>

#include "scene/resize.h"
#include "ui/icons.h"
#include "ui/theme.h"

namespace clothlab::ui {
namespace {

using scene::Effect;
using scene::Field;
using scene::FieldType;

std::string help_of(const Field& f) {
    std::string text(f.help);
    text += "\n\n" + std::string(f.key) + ": " + scene::allowed_values(f) + ".";
    if (f.effect == Effect::restart)
        text += " A change restarts the simulation.";
    return text;
}

void assign(Lab& lab, const Field& f, double value) {
    if (const auto why = scene::objection(f, value)) {
        lab.messages.push_back({true, std::string(f.label) + ": " + *why});
        return;
    }
    const sim::Cloth& cloth = lab.scene.simulation.cloth;
    if (f.key == "cloth.num_width_points")
        scene::resize_grid(lab.scene, static_cast<int>(value), cloth.num_height_points);
    else if (f.key == "cloth.num_height_points")
        scene::resize_grid(lab.scene, cloth.num_width_points, static_cast<int>(value));
    else
        f.set(lab.scene, value);
}

void edit_number(Lab& lab, const Field& f) {
    const bool whole = f.type == FieldType::integer;
    const scene::Shown& shown = f.shown;
    const bool waits = f.effect == Effect::restart;
    const bool pending = lab.pending && lab.pending->key == f.key;
    double value = (pending ? lab.pending->value : f.get(lab.scene)) * shown.factor;
    const std::string format = format_with_unit(whole ? "%.0f" : "%.7g", shown.unit);
    // Typing may leave the slider's range; what the scene does not allow is refused by assign().
    const ImGuiSliderFlags flags = ImGuiSliderFlags_NoRoundToFormat |
                                   (shown.scale == scene::Scale::logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
    const bool edited =
        ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &shown.min, &shown.max, format.c_str(), flags);
    const bool typed = ImGui::GetIO().WantTextInput;
    if (whole)
        value = std::round(value);
    else if (!typed)
        value = round_for_slider(value);
    // Back to the file's unit by dividing: 15 g/cm² is 150 kg/m², not 149.99999999999997.
    if (edited && waits)
        lab.pending = Lab::Pending{f.key, value / shown.factor};
    if (edited && !waits)
        assign(lab, f, value / shown.factor);
    if (waits && lab.pending && lab.pending->key == f.key && ImGui::IsItemDeactivated()) {
        assign(lab, f, lab.pending->value);
        lab.pending.reset();
    }
}

/// A choice between a thing and its absence is a switch.
bool is_switch(const Field& f) {
    return f.type == FieldType::choice && f.choices.size() == 2 && (f.choices[1] == "none" || f.choices[1] == "off");
}

void edit_choice(Lab& lab, const Field& f, std::span<const ChoiceText> texts) {
    if (is_switch(f)) {
        bool on = f.get(lab.scene) == 0;
        if (ImGui::Checkbox("##value", &on))
            f.set(lab.scene, on ? 0 : 1);
        return;
    }
    const auto index = static_cast<std::size_t>(f.get(lab.scene));
    const auto title = [&](std::size_t i) { return texts.empty() ? f.choices[i].data() : texts[i].title.c_str(); };
    if (!ImGui::BeginCombo("##value", title(index), ImGuiComboFlags_HeightLarge))
        return;
    for (std::size_t i = 0; i < f.choices.size(); ++i) {
        if (ImGui::Selectable(title(i), i == index))
            f.set(lab.scene, static_cast<double>(i));
        if (!texts.empty())
            tooltip(texts[i].help);
    }
    ImGui::EndCombo();
}

bool edit_vector(sim::Vec3& v, double min, double max, const char* format) {
    double xyz[] = {v.x, v.y, v.z};
    const float speed = static_cast<float>((max - min) / 400);
    if (!ImGui::DragScalarN("##value", ImGuiDataType_Double, xyz, 3, speed, nullptr, nullptr, format))
        return false;
    for (const double x : xyz)
        if (!std::isfinite(x))
            return false;
    v = {xyz[0], xyz[1], xyz[2]};
    return true;
}

} // namespace

std::string format_with_unit(const char* number, std::string_view unit) {
    std::string format = number;
    if (!unit.empty() && unit != "°")
        format += ' ';
    for (const char c : unit)
        format += c == '%' ? "%%" : std::string(1, c);
    return format;
}

void label_cell(const char* label, const std::string& help, bool changed) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    if (changed)
        ImGui::TextColored(colour::accent, "%s", label);
    else
        ImGui::TextUnformatted(label);
    tooltip(help);
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1);
}

bool reset_cell(bool changed) {
    ImGui::TableNextColumn();
    return changed && icon_button(ICON_FA_ROTATE_LEFT, "##reset", "Back to the scene's value");
}

double round_for_slider(double v) {
    if (v == 0 || !std::isfinite(v))
        return v;
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(v))) - 2);
    return std::round(v / unit) * unit;
}

bool begin_fields(const char* id) {
    if (!ImGui::BeginTable(id, 3, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoSavedSettings))
        return false;
    ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_WidthStretch, 0.46f);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.54f);
    ImGui::TableSetupColumn("reset", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFrameHeight());
    return true;
}

void end_fields() {
    ImGui::EndTable();
}

void field_row(Lab& lab, std::string_view key, std::span<const ChoiceText> texts) {
    const Field* found = scene::find_field(key);
    IM_ASSERT(found && "a panel names a parameter that does not exist");
    const Field& f = *found;
    ImGui::PushID(f.key.data());
    const bool vector = f.type == FieldType::vector;
    const bool changed =
        vector ? f.get_vector(lab.scene) != f.get_vector(lab.loaded) : f.get(lab.scene) != f.get(lab.loaded);
    // Three numbers leave no room for a unit beside each.
    const std::string unit = vector && !f.unit.empty() ? " (" + std::string(f.unit) + ")" : "";
    std::string help = help_of(f);
    if (!texts.empty())
        help = texts[static_cast<std::size_t>(f.get(lab.scene))].help + "\n\n" + std::string(f.help);
    label_cell((std::string(f.label) + unit).c_str(), help, changed);
    switch (f.type) {
    case FieldType::boolean: {
        bool on = f.get(lab.scene) != 0;
        if (ImGui::Checkbox("##value", &on))
            f.set(lab.scene, on ? 1 : 0);
        break;
    }
    case FieldType::choice:
        edit_choice(lab, f, texts);
        break;
    case FieldType::vector: {
        sim::Vec3 v = f.get_vector(lab.scene);
        if (edit_vector(v, f.shown.min, f.shown.max, "%.5g"))
            f.set_vector(lab.scene, v);
        break;
    }
    case FieldType::number:
    case FieldType::integer:
        edit_number(lab, f);
        break;
    case FieldType::text:
        break; // has a list of its own where it is edited
    }
    tooltip(help);
    if (reset_cell(changed)) {
        if (vector)
            f.set_vector(lab.scene, f.get_vector(lab.loaded));
        else
            assign(lab, f, f.get(lab.loaded));
    }
    ImGui::PopID();
}

namespace {

/// A row with a label, a widget that edit() draws, and a reset.
template <class Value, class Edit>
bool value_row(const char* label, const char* help, Value& value, const Value& loaded, Edit edit) {
    ImGui::PushID(label);
    label_cell(label, help, value != loaded);
    bool edited = edit();
    tooltip(help);
    if (reset_cell(value != loaded)) {
        value = loaded;
        edited = true;
    }
    ImGui::PopID();
    return edited;
}

} // namespace

bool number_row(const char* label, const char* help, double& value, double loaded, double min, double max,
                const char* format) {
    return value_row(label, help, value, loaded, [&] {
        return ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &min, &max, format,
                                   ImGuiSliderFlags_AlwaysClamp);
    });
}

bool vector_row(const char* label, const char* help, sim::Vec3& value, const sim::Vec3& loaded, double min, double max,
                const char* format) {
    return value_row(label, help, value, loaded, [&] { return edit_vector(value, min, max, format); });
}

bool being_dragged() {
    return ImGui::IsItemActive() && !ImGui::IsItemActivated();
}

void tooltip(const std::string& text) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_ForTooltip | ImGuiHoveredFlags_AllowWhenDisabled))
        return;
    if (!ImGui::BeginTooltip())
        return;
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

bool icon_button(const char* icon, const char* id, const char* help, bool enabled) {
    const float side = ImGui::GetFrameHeight();
    ImGui::BeginDisabled(!enabled);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, ImGui::GetStyle().FramePadding.y}); // in the middle
    const bool pressed = ImGui::Button((std::string(icon) + id).c_str(), {side, side});
    ImGui::PopStyleVar();
    ImGui::EndDisabled();
    tooltip(help);
    return pressed;
}

void mono_text(const char* format, ...) {
    va_list arguments;
    va_start(arguments, format);
    ImGui::PushFont(fonts().mono, 0);
    ImGui::TextV(format, arguments);
    ImGui::PopFont();
    va_end(arguments);
}

} // namespace clothlab::ui
