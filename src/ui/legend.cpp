#include "ui/legend.h"

#include <algorithm>
#include <cstdio>

namespace clothlab::ui {
namespace {

ImU32 packed(const std::array<float, 3>& c) {
    return ImGui::GetColorU32(ImVec4(c[0], c[1], c[2], 1));
}

void spring_kinds(const Lab& lab, ImVec2 at) {
    const scene::Look& look = lab.scene.look;
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float line = ImGui::GetTextLineHeight();
    const std::pair<const char*, bool> rows[] = {
        {"structural", look.show_structural}, {"shear", look.show_shearing}, {"bending", look.show_bending}};
    for (std::size_t i = 0; i < std::size(rows); ++i) {
        if (!rows[i].second)
            continue;
        list->AddLine({at.x, at.y + line / 2}, {at.x + 1.6f * line, at.y + line / 2}, packed(lab.spring_colours[i]),
                      line / 7);
        list->AddText({at.x + 2.1f * line, at.y}, ImGui::GetColorU32(ImGuiCol_Text), rows[i].first);
        at.y += 1.25f * line;
    }
}

/// A bar of the map's colours, the high end on top, with five numbers beside it.
void heat_map(const Lab& lab, const scene::ShaderDeclaration& shader, const std::vector<std::array<float, 3>>& colours,
              ImVec2 at) {
    const scene::ShaderLegend& legend = *shader.legend;
    const double low = number_of(lab.scene.look, shader, legend.low),
                 high = number_of(lab.scene.look, shader, legend.high);
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float line = ImGui::GetTextLineHeight();
    const ImU32 text = ImGui::GetColorU32(ImGuiCol_Text);
    const std::string title = legend.title + (legend.unit.empty() ? "" : " (" + legend.unit + ")");
    list->AddText(at, text, title.c_str());
    at.y += 1.5f * line;
    const float width = line, height = 8 * line;
    const auto count = static_cast<float>(colours.size());
    for (std::size_t i = 0; i < colours.size(); ++i) {
        const float bottom = at.y + height * (1 - static_cast<float>(i) / count);
        list->AddRectFilled({at.x, bottom - height / count}, {at.x + width, bottom}, packed(colours[i]));
    }
    constexpr int steps = 4;
    for (int i = 0; i <= steps; ++i) {
        const float y = at.y + height * (1 - static_cast<float>(i) / steps);
        // So that 0 is not written as -1e-17.
        const double value = low + (high - low) * i / steps,
                     clean = std::abs(value) < 1e-9 * std::abs(high - low) ? 0 : value;
        char number[32];
        std::snprintf(number, sizeof number, "%.3g", clean);
        list->AddLine({at.x + width, y}, {at.x + 1.3f * width, y}, text);
        list->AddText({at.x + 1.6f * width, y - line / 2}, text, number);
    }
}

} // namespace

void draw_legend(const Lab& lab, ImVec2 corner, ImVec2 size) {
    const float line = ImGui::GetTextLineHeight();
    ImVec2 at{corner.x + line, corner.y + line};
    const scene::ShaderDeclaration* shader = shader_in_use(lab);
    if (shader && shader->legend) {
        heat_map(lab, *shader, lab.legend_colours, at);
        at.y += 11 * line;
    }
    if ((shader && shader->lines && !shader->legend) || lab.scene.look.springs_over_surface)
        spring_kinds(lab, at);
    const scene::ShaderDeclaration* right = shader_on_the_right(lab);
    const float divider = corner.x + size.x * static_cast<float>(lab.scene.look.split.position);
    // Below the camera's bar, which is at the upper right.
    if (right && right->legend)
        heat_map(lab, *right, lab.split_legend_colours,
                 {std::min(divider + line, corner.x + size.x - 9 * line), corner.y + 3 * line});
    else if (right && right->lines && !lab.scene.look.springs_over_surface)
        spring_kinds(lab, {std::min(divider + line, corner.x + size.x - 9 * line), corner.y + 3 * line});
}

} // namespace clothlab::ui
