// Dear ImGui on a window: context, fonts, theme, layout file, and one frame of it.
#pragma once

#include <filesystem>

#include "app/gui/damage.h"
#include "app/window.h"

struct ImGuiContext;
struct ImPlotContext;

namespace clothlab::app {

class ImGuiLayer {
public:
    /// `layout` is where the user's layout is kept: loaded when it is there, else the default of `default_layout`;
    /// saved when it changes. An empty path keeps none. `scale` overrides the display's when above 0.
    ImGuiLayer(Window& window, std::filesystem::path layout, std::filesystem::path default_layout, float scale = 0);
    ~ImGuiLayer();
    ImGuiLayer(const ImGuiLayer&) = delete;
    ImGuiLayer& operator=(const ImGuiLayer&) = delete;

    void begin_frame();
    /// Draws the frame into the framebuffer that is bound, of the window's size.
    void end_frame();
    /// Draws what has changed since the last frame, which that framebuffer still holds. `new_contents` is a texture
    /// that has been drawn into since, 0 for none. False when nothing has changed.
    bool end_frame_over_last(unsigned new_contents);
    /// The last frame is no longer there: the next one is drawn whole.
    void forget_last() { damage_.forget(); }
    /// Back to the default layout with the next frame.
    void reset_layout() { default_layout_wanted_ = true; }

    ImGuiContext* context() const { return context_; }

private:
    void render();
    void load_default_layout();
    void save_layout_if_changed();

    Window& window_;
    Damage damage_;
    std::filesystem::path layout_, default_layout_;
    ImGuiContext* context_ = nullptr;
    ImPlotContext* plots_ = nullptr;
    float forced_scale_, scale_ = 0;
    bool default_layout_wanted_ = false;
};

/// $XDG_CONFIG_HOME/clothlab/imgui.ini or ~/.config/clothlab/imgui.ini; empty when there is no home.
std::filesystem::path user_layout_file();

} // namespace clothlab::app
