// Rows for what shaders declare: see scene/shader_parameters.h.
#include <cmath>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/icons.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

using scene::ShaderParameter;
using scene::ShaderParameterType;
using scene::ShaderValue;

std::string help_of(const scene::ShaderDeclaration& shader, const ShaderParameter& p) {
    return p.help + (p.help.empty() ? "" : "\n\n") + "look.shaders." + shader.name + "." + p.name +
           (p.type == ShaderParameterType::texture ? "" : ", uniform " + p.name + " in the shader") + ".";
}

bool edit_number(const ShaderParameter& p, ShaderValue& value) {
    double number = std::get<double>(value);
    const bool whole = p.type == ShaderParameterType::integer;
    const std::string format = format_with_unit(whole ? "%.0f" : "%.7g", p.unit);
    const ImGuiSliderFlags flags =
        ImGuiSliderFlags_NoRoundToFormat | (p.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
    if (!ImGui::SliderScalar("##value", ImGuiDataType_Double, &number, &p.min, &p.max, format.c_str(), flags))
        return false;
    if (whole)
        number = std::round(number);
    else if (!ImGui::GetIO().WantTextInput)
        number = round_for_slider(number);
    if (!std::isfinite(number))
        return false;
    value = number;
    return true;
}

bool edit_colour(ShaderValue& value) {
    const sim::Vec3 v = std::get<sim::Vec3>(value);
    float rgb[] = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    if (!ImGui::ColorEdit3("##value", rgb, ImGuiColorEditFlags_DisplayHex))
        return false;
    // Bytes, as the hexadecimal text shows them.
    const auto byte = [](float x) { return std::round(static_cast<double>(x) * 255) / 255; };
    value = sim::Vec3{byte(rgb[0]), byte(rgb[1]), byte(rgb[2])};
    return true;
}

/// A list of the textures that come with the lab, and below it a picture's path to be typed.
bool edit_texture(Lab& lab, const ShaderParameter& p, ShaderValue& value, const scene::ShaderDeclaration& shader) {
    const std::string& name = std::get<std::string>(value);
    std::string shown = name;
    for (const TextureChoice& choice : lab.textures)
        if (choice.name == name)
            shown = choice.title;
    if (shown == name && name.find('/') != std::string::npos)
        shown = std::filesystem::path(name).filename().string();
    if (!ImGui::BeginCombo("##value", shown.c_str(), ImGuiComboFlags_HeightLarge))
        return false;
    bool edited = false;
    for (const TextureChoice& choice : lab.textures) {
        if (choice.usage != p.usage)
            continue;
        if (ImGui::Selectable(choice.title.c_str(), choice.name == name)) {
            value = choice.name;
            edited = true;
        }
    }
    ImGui::Separator();
    ImGui::TextUnformatted("A picture of your own:");
    static std::string typed;
    if (ImGui::IsWindowAppearing())
        typed = name;
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 16);
    if (ImGui::InputTextWithHint("##path", "file, then Enter", &typed, ImGuiInputTextFlags_EnterReturnsTrue) &&
        !typed.empty()) {
        value = typed;
        edited = true;
        ImGui::CloseCurrentPopup();
    }
    if (lab.has_file_dialogs && ImGui::Button(ICON_FA_FOLDER_OPEN "  Browse ...")) {
        lab.ask(BrowseForTexture{shader.name, p.name});
        ImGui::CloseCurrentPopup();
    }
    ImGui::TextDisabled("Or drop it onto the window.");
    ImGui::EndCombo();
    return edited;
}

} // namespace

void shader_row(Lab& lab, const scene::ShaderDeclaration& shader, const ShaderParameter& p) {
    ImGui::PushID(p.name.c_str());
    ShaderValue value = value_of(lab.scene.look, shader, p);
    const ShaderValue loaded = value_of(lab.loaded.look, shader, p);
    const bool changed = value != loaded;
    const std::string help = help_of(shader, p);
    label_cell(p.label.c_str(), help, changed);
    bool edited = false;
    switch (p.type) {
    case ShaderParameterType::number:
    case ShaderParameterType::integer:
        edited = edit_number(p, value);
        break;
    case ShaderParameterType::flag: {
        bool on = std::get<bool>(value);
        edited = ImGui::Checkbox("##value", &on);
        value = on;
        break;
    }
    case ShaderParameterType::colour:
        edited = edit_colour(value);
        break;
    case ShaderParameterType::texture:
        edited = edit_texture(lab, p, value, shader);
        break;
    }
    tooltip(help);
    if (reset_cell(changed)) {
        value = loaded;
        edited = true;
    }
    if (edited)
        scene::set_value(lab.scene.look, shader, p, value);
    ImGui::PopID();
}

} // namespace clothlab::ui
