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
    /// Draws the frame into the window.
    void end_frame();
    /// Draws what has changed since the last frame into a framebuffer object of the window's size that still holds that
    /// one. `new_contents` is a texture that has been drawn into since, 0 for none. False when nothing has changed.
    bool end_frame(unsigned framebuffer, unsigned new_contents);
    /// What the framebuffer of the other end_frame() held is lost.
    void forget_picture() { damage_.forget(); }
    /// Back to the default layout with the next frame.
    void reset_layout() { default_layout_wanted_ = true; }

    ImGuiContext* context() const { return context_; }

private:
    void prepare_to_draw(unsigned framebuffer);
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
