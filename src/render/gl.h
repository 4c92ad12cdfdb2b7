// OpenGL objects that delete themselves, and the check that the context can do what the renderer needs. Whoever uses
// them has made a context current and loaded glad (gladLoadGL); objects must be destroyed while it is current.
#pragma once

#include <utility>

#include <glad/gl.h>

namespace clothlab::render {

/// Throws std::runtime_error, naming the version there is, when the current context has not OpenGL 3.3 or glad was
/// not loaded.
void require_gl();

/// Whether the driver draws on the CPU (Mesa's llvmpipe or softpipe): every sample of a pixel then costs its full
/// share.
bool software_rendering();

/// One OpenGL object: moved, never copied, deleted with its handle. 0 when empty.
template <class Kind>
class Handle {
public:
    Handle() = default;
    explicit Handle(GLuint id) : id_(id) {}
    static Handle create() { return Handle(Kind::create()); }
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0u)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~Handle() {
        if (id_ != 0)
            Kind::destroy(id_);
    }
    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }

private:
    GLuint id_ = 0;
};

namespace kind {

#define CLOTHLAB_GL_KIND(name, generate, remove)                                                                       \
    struct name {                                                                                                      \
        static GLuint create() {                                                                                       \
            GLuint id = 0;                                                                                             \
            generate(1, &id);                                                                                          \
            return id;                                                                                                 \
        }                                                                                                              \
        static void destroy(GLuint id) { remove(1, &id); }                                                             \
    };
CLOTHLAB_GL_KIND(Buffer, glGenBuffers, glDeleteBuffers)
CLOTHLAB_GL_KIND(VertexArray, glGenVertexArrays, glDeleteVertexArrays)
CLOTHLAB_GL_KIND(Texture, glGenTextures, glDeleteTextures)
CLOTHLAB_GL_KIND(Framebuffer, glGenFramebuffers, glDeleteFramebuffers)
CLOTHLAB_GL_KIND(Renderbuffer, glGenRenderbuffers, glDeleteRenderbuffers)
#undef CLOTHLAB_GL_KIND

struct Shader {
    static void destroy(GLuint id) { glDeleteShader(id); }
};
struct Program {
    static GLuint create() { return glCreateProgram(); }
    static void destroy(GLuint id) { glDeleteProgram(id); }
};

} // namespace kind

using Buffer = Handle<kind::Buffer>;
using VertexArray = Handle<kind::VertexArray>;
using Texture = Handle<kind::Texture>;
using Framebuffer = Handle<kind::Framebuffer>;
using Renderbuffer = Handle<kind::Renderbuffer>;
using ShaderHandle = Handle<kind::Shader>;
using ProgramHandle = Handle<kind::Program>;

} // namespace clothlab::render
