// The look of the lab: colours, spacing, fonts.
#pragma once

#include <filesystem>
#include <imgui.h>

namespace clothlab::ui {

struct Fonts {
    ImFont* regular = nullptr;
    ImFont* bold = nullptr;
    ImFont* mono = nullptr;
};

/// Loads the fonts of a folder, icons merged in. Throws std::runtime_error that names the file that is missing. Sizes
/// follow the display: ImGui draws glyphs anew for every size, so text is crisp at any scale.
void load_fonts(const std::filesystem::path& folder);
/// Those of load_fonts in the present ImGui context.
Fonts fonts();

/// Sets colours and sizes for a display scale (1 for 96 dpi).
void apply_theme(float scale);

namespace colour {
inline constexpr ImVec4 accent{0.88f, 0.44f, 0.31f, 1}; ///< the cloth's own
inline constexpr ImVec4 text{0.90f, 0.91f, 0.93f, 1};
inline constexpr ImVec4 faint{0.58f, 0.62f, 0.67f, 1};
inline constexpr ImVec4 good{0.45f, 0.76f, 0.52f, 1};
inline constexpr ImVec4 warning{0.95f, 0.73f, 0.30f, 1};
inline constexpr ImVec4 error{0.95f, 0.42f, 0.40f, 1};
} // namespace colour

} // namespace clothlab::ui
