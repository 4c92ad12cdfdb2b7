#include "render/gl.h"

#include <stdexcept>
#include <string>

namespace clothlab::render {

namespace {

std::string text(GLenum name) {
    const GLubyte* s = glGetString(name);
    return s == nullptr ? std::string("unknown") : std::string(reinterpret_cast<const char*>(s));
}

} // namespace

void require_gl() {
    if (glGetIntegerv == nullptr || glGetString == nullptr)
        throw std::runtime_error("OpenGL is not loaded: no context is current");
    GLint major = 0, minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    if (major > 3 || (major == 3 && minor >= 3))
        return;
    throw std::runtime_error("OpenGL 3.3 is needed, but the driver (" + text(GL_RENDERER) + ") offers " +
                             text(GL_VERSION));
}

bool software_rendering() {
    const std::string renderer = text(GL_RENDERER);
    return renderer.find("llvmpipe") != std::string::npos || renderer.find("softpipe") != std::string::npos;
}

} // namespace clothlab::render
