// What has changed in the window's picture since it was last drawn. A driver that draws on the CPU takes longer over
// the panels than over the cloth, and most of them look as they did.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include <imgui.h>

namespace clothlab::app {

/// In pixels, from the top left corner of the window; x1 and y1 are beyond it.
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool operator==(const PixelRect&) const = default;
};

class Damage {
public:
    /// The parts of the picture that are to be drawn anew: all where ImGui's windows differ from those of the last
    /// call. `new_contents` is a texture that has been drawn into since, 0 for none. The rectangles may overlap:
    /// whoever draws clears each of them first.
    std::vector<PixelRect> update(const ImDrawData& data, ImTextureID new_contents);
    /// The picture is lost, or has another size: the next call finds all of it changed.
    void forget() { lists_.clear(); }

private:
    struct List {
        std::uint64_t looks = 0; ///< a hash of its vertices and commands
        std::uint64_t order = 0; ///< and of the names of those under it: a window that comes to the front hides others
        PixelRect at;
        bool operator==(const List&) const = default;
    };
    std::unordered_map<std::string, List> lists_; ///< by ImGui's name of the window
};

/// Draws the part of ImGui's picture that lies in a rectangle. The commands are clipped while it draws, and are then as
/// they were.
void draw_part(ImDrawData& data, const PixelRect& part);

} // namespace clothlab::app
