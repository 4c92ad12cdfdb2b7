// An OpenGL 4.1 context with no window and no display, for as long as the object lives: what a drawing test starts
// with.
#pragma once

#include <stdexcept>

#include <glad/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace clothlab::test {

class GlContext {
public:
    GlContext() {
        glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_NULL);
        if (glfwInit() == GLFW_FALSE)
            fail("GLFW's null platform does not start");
        glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 1);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
        window_ = glfwCreateWindow(16, 16, "test", nullptr, nullptr);
        if (window_ == nullptr)
            fail("there is no EGL context of OpenGL 4.1 (is Mesa's software rasteriser there?)");
        glfwMakeContextCurrent(window_);
        if (gladLoadGL(glfwGetProcAddress) == 0)
            fail("OpenGL cannot be loaded");
    }
    ~GlContext() { glfwTerminate(); }
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

private:
    [[noreturn]] static void fail(const char* what) {
        glfwTerminate();
        throw std::runtime_error(what);
    }
    GLFWwindow* window_ = nullptr;
};

} // namespace clothlab::test
