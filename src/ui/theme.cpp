#include "ui/theme.h"

#include <stdexcept>

#include "ui/icons.h"

namespace clothlab::ui {
namespace {

constexpr float base_size = 16;

void load(const std::filesystem::path& file, const std::filesystem::path& icons) {
    // ImGui asserts on a missing file; a sentence is kinder.
    for (const auto& f : {file, icons})
        if (!std::filesystem::exists(f))
            throw std::runtime_error("the font " + f.string() + " is missing");
    ImFontAtlas* atlas = ImGui::GetIO().Fonts;
    atlas->AddFontFromFileTTF(file.string().c_str(), base_size);
    ImFontConfig merge;
    merge.MergeMode = true;
    merge.GlyphMinAdvanceX = 18; // icons in a column, whatever their width
    merge.GlyphOffset = {0, 1};
    atlas->AddFontFromFileTTF(icons.string().c_str(), base_size * 0.85f, &merge);
}

ImVec4 grey(float level, float alpha = 1) {
    return {level * 0.92f, level * 0.97f, level * 1.04f, alpha};
}

ImVec4 faded(ImVec4 c, float alpha) {
    return {c.x, c.y, c.z, alpha};
}

} // namespace

void load_fonts(const std::filesystem::path& folder) {
    const auto icons = folder / "Font_Awesome_6_Free-Solid-900.otf";
    // In the order of Fonts.
    for (const char* name : {"Roboto-Regular.ttf", "Roboto-Bold.ttf", "Inconsolata-Medium.ttf"})
        load(folder / name, icons);
}

Fonts fonts() {
    const ImVector<ImFont*>& list = ImGui::GetIO().Fonts->Fonts;
    return {list[0], list[1], list[2]};
}

void apply_theme(float scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    ImGui::StyleColorsDark(&style);
    style.FontSizeBase = base_size;
    style.WindowPadding = {10, 8};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {8, 6};
    style.ItemInnerSpacing = {6, 4};
    style.CellPadding = {6, 3};
    style.ScrollbarSize = 12;
    style.GrabMinSize = 10;
    style.WindowRounding = style.ChildRounding = style.PopupRounding = 5;
    style.FrameRounding = style.GrabRounding = style.TabRounding = 4;
    style.WindowBorderSize = style.PopupBorderSize = 1;
    style.FrameBorderSize = 0;
    style.TabBarOverlineSize = 2;
    style.DockingSeparatorSize = 3;
    style.WindowMenuButtonPosition = ImGuiDir_None;
    style.DockingNodeHasCloseButton = false; // each tab has its own
    style.SeparatorTextBorderSize = 1;
    style.SeparatorTextPadding = {0, 4};

    ImVec4* c = style.Colors;
    c[ImGuiCol_Text] = colour::text;
    c[ImGuiCol_TextDisabled] = colour::faint;
    c[ImGuiCol_WindowBg] = grey(0.135f);
    c[ImGuiCol_ChildBg] = grey(0.135f, 0);
    c[ImGuiCol_PopupBg] = grey(0.165f, 0.98f);
    c[ImGuiCol_MenuBarBg] = grey(0.11f);
    c[ImGuiCol_Border] = grey(0.24f);
    c[ImGuiCol_FrameBg] = grey(0.205f);
    c[ImGuiCol_FrameBgHovered] = grey(0.255f);
    c[ImGuiCol_FrameBgActive] = grey(0.29f);
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = grey(0.10f);
    c[ImGuiCol_Tab] = c[ImGuiCol_TabDimmed] = grey(0.10f);
    c[ImGuiCol_TabSelected] = c[ImGuiCol_TabDimmedSelected] = grey(0.135f);
    c[ImGuiCol_TabHovered] = grey(0.22f);
    c[ImGuiCol_TabSelectedOverline] = colour::accent;
    c[ImGuiCol_TabDimmedSelectedOverline] = grey(0.30f);
    c[ImGuiCol_Button] = grey(0.225f);
    c[ImGuiCol_ButtonHovered] = grey(0.29f);
    c[ImGuiCol_ButtonActive] = faded(colour::accent, 0.75f);
    c[ImGuiCol_Header] = grey(0.20f);
    c[ImGuiCol_HeaderHovered] = grey(0.26f);
    c[ImGuiCol_HeaderActive] = grey(0.30f);
    c[ImGuiCol_CheckMark] = colour::accent;
    c[ImGuiCol_SliderGrab] = faded(colour::accent, 0.6f); // the value stays readable under it
    c[ImGuiCol_SliderGrabActive] = faded(colour::accent, 0.85f);
    c[ImGuiCol_PlotHistogram] = faded(colour::accent, 0.8f);
    c[ImGuiCol_Separator] = grey(0.22f);
    c[ImGuiCol_SeparatorHovered] = c[ImGuiCol_SeparatorActive] = faded(colour::accent, 0.7f);
    c[ImGuiCol_ResizeGrip] = grey(0.22f);
    c[ImGuiCol_ResizeGripHovered] = c[ImGuiCol_ResizeGripActive] = faded(colour::accent, 0.7f);
    c[ImGuiCol_ScrollbarBg] = grey(0.135f, 0);
    c[ImGuiCol_ScrollbarGrab] = grey(0.25f);
    c[ImGuiCol_DockingPreview] = faded(colour::accent, 0.5f);
    c[ImGuiCol_ModalWindowDimBg] = grey(0.02f, 0.55f);
    c[ImGuiCol_DockingEmptyBg] = grey(0.09f);
    c[ImGuiCol_NavCursor] = faded(colour::accent, 0.8f);
    c[ImGuiCol_TextSelectedBg] = faded(colour::accent, 0.35f);
    c[ImGuiCol_TableRowBgAlt] = grey(0.15f);

    style.ScaleAllSizes(scale);
    style.FontScaleDpi = scale;
}

} // namespace clothlab::ui
