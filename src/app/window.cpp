#include "app/window.h"

#include <GLFW/glfw3.h>
#include <glad/gl.h>

#include <cstdlib>

namespace clothlab::app {
namespace {

std::string last_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "unknown reason";
}

bool is_set(const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value;
}

/// The platform to ask GLFW for. Asking it for a Wayland display where there is none makes libwayland complain to the
/// user.
int desktop_platform() {
#ifdef __linux__
    const bool wayland = is_set("WAYLAND_DISPLAY") || is_set("WAYLAND_SOCKET");
    if (!wayland && !is_set("DISPLAY"))
        throw NoDisplay("neither DISPLAY nor WAYLAND_DISPLAY is set");
    if (!wayland)
        return GLFW_PLATFORM_X11;
#endif
    return GLFW_ANY_PLATFORM;
}

void set_context_hints(bool offscreen) {
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, offscreen ? GLFW_EGL_CONTEXT_API : GLFW_NATIVE_CONTEXT_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0); // the scene is drawn into a framebuffer of its own
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
}

} // namespace

Window::Window(Kind kind, int width, int height, const std::string& title) : kind_(kind), title_(title) {
    const bool offscreen = kind == Kind::offscreen;
    glfwInitHint(GLFW_PLATFORM, offscreen ? GLFW_PLATFORM_NULL : desktop_platform());
    if (!glfwInit()) {
        const std::string why = last_error();
        if (offscreen)
            throw std::runtime_error("GLFW cannot be initialised: " + why);
        throw NoDisplay(why);
    }
    set_context_hints(offscreen);
    handle_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (!handle_) {
        const std::string why = last_error();
        glfwTerminate();
        throw std::runtime_error("no OpenGL 3.3 context: " + why +
                                 "; Mesa's software rasteriser (package libgl1-mesa-dri) provides one without a GPU");
    }
    glfwMakeContextCurrent(handle_);
    if (!gladLoadGL(glfwGetProcAddress)) {
        glfwDestroyWindow(handle_);
        glfwTerminate();
        throw std::runtime_error("OpenGL's functions cannot be loaded");
    }
    if (!offscreen)
        glfwSwapInterval(1);
    glfwSetWindowUserPointer(handle_, this);
    glfwSetWindowRefreshCallback(
        handle_, [](GLFWwindow* window) { static_cast<Window*>(glfwGetWindowUserPointer(window))->uncovered_ = true; });
    glfwSetDropCallback(handle_, [](GLFWwindow* window, int count, const char** paths) {
        auto* self = static_cast<Window*>(glfwGetWindowUserPointer(window));
        if (self->on_drop)
            self->on_drop({paths, paths + count});
    });
}

Window::~Window() {
    glfwDestroyWindow(handle_);
    glfwTerminate();
}

bool Window::should_close() const {
    return glfwWindowShouldClose(handle_) != 0;
}

void Window::keep_open() {
    glfwSetWindowShouldClose(handle_, GLFW_FALSE);
}

void Window::framebuffer_size(int& width, int& height) const {
    glfwGetFramebufferSize(handle_, &width, &height);
}

bool Window::minimised() const {
    int width = 0, height = 0;
    framebuffer_size(width, height);
    return width <= 0 || height <= 0 || glfwGetWindowAttrib(handle_, GLFW_ICONIFIED) != 0;
}

float Window::content_scale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(handle_, &x, &y);
    return x > 0 ? x : 1;
}

void Window::set_title(const std::string& title) {
    if (title == title_)
        return;
    title_ = title;
    glfwSetWindowTitle(handle_, title.c_str());
}

void Window::swap() {
    if (kind_ == Kind::desktop)
        glfwSwapBuffers(handle_);
}

void Window::poll(double wait_seconds) {
    if (wait_seconds > 0)
        glfwWaitEventsTimeout(wait_seconds);
    else
        glfwPollEvents();
}

} // namespace clothlab::app
