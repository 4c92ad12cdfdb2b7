#include "render/gl.h"

#include <stdexcept>
#include <string>

namespace clothlab::render {

void require_gl() {
    if (glGetIntegerv == nullptr || glGetString == nullptr)
        throw std::runtime_error("OpenGL is not loaded: no context is current");
    GLint major = 0, minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    if (major > 4 || (major == 4 && minor >= 1))
        return;
    const auto text = [](GLenum name) {
        const GLubyte* s = glGetString(name);
        return s == nullptr ? std::string("unknown") : std::string(reinterpret_cast<const char*>(s));
    };
    throw std::runtime_error("OpenGL 4.1 is needed, but the driver (" + text(GL_RENDERER) + ") offers " +
                             text(GL_VERSION));
}

} // namespace clothlab::render
