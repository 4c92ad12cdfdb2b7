// A GLFW window with an OpenGL context: on the desktop, or without any display on GLFW's null platform. One code path
// for both; only what framebuffer 0 is good for differs.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

struct GLFWwindow;

namespace clothlab::app {

/// There is no display to open a window on.
class NoDisplay : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

class Window {
public:
    enum class Kind { desktop, offscreen };

    /// Opens a window of a size in screen coordinates and makes its context current. Throws NoDisplay when a desktop
    /// window is asked for and there is no display, std::runtime_error when there is no OpenGL 3.3.
    Window(Kind kind, int width, int height, const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    Kind kind() const { return kind_; }
    GLFWwindow* handle() const { return handle_; }
    bool should_close() const;
    /// Takes the user's wish to close the window back.
    void keep_open();
    void framebuffer_size(int& width, int& height) const;
    bool minimised() const;
    /// 1 for 96 dpi; the user's setting of the monitor that the window is on.
    float content_scale() const;
    void set_title(const std::string& title);
    /// Shows what was drawn (desktop), in step with the display.
    void swap();
    /// Whether the display has lost what was shown, as where another window lay over this one, since the last call.
    bool take_uncovered() { return std::exchange(uncovered_, false); }
    /// Handles what happened; waits up to so many seconds for it first.
    void poll(double wait_seconds = 0);
    /// Called with the files that the user drops onto the window.
    std::function<void(std::vector<std::string>)> on_drop;

private:
    Kind kind_;
    GLFWwindow* handle_ = nullptr;
    std::string title_;
    bool uncovered_ = false;
};

} // namespace clothlab::app
