// The picture in the window: with a driver that draws on the CPU, or offscreen, one that is kept and drawn only where
// it changes.
#pragma once

#include <optional>

#include "app/gui/imgui_layer.h"
#include "app/window.h"
#include "render/offscreen.h"

namespace clothlab::app {

class WindowPicture {
public:
    /// Both must outlive it.
    WindowPicture(Window& window, ImGuiLayer& imgui);

    /// Ends ImGui's frame and draws it. `new_contents` is a texture that has been drawn into since the last call, 0 for
    /// none. False when the window is known to show just that already.
    bool draw(unsigned new_contents);
    /// What was drawn, opaque. After show() only offscreen.
    render::Image read();
    /// On the screen, if it is not there already; in step with the display.
    void show();

private:
    Window& window_;
    ImGuiLayer& imgui_;
    std::optional<render::Target> kept_;
    bool changed_ = true; ///< the last draw() has changed something
};

} // namespace clothlab::app
