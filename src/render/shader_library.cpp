#include "render/shader_library.h"

#include <algorithm>

namespace clothlab::render {

namespace {

ShaderHandle compile(const ShaderSource& source, GLenum stage) {
    ShaderHandle shader(glCreateShader(stage));
    const char* text = source.text.c_str();
    glShaderSource(shader.id(), 1, &text, nullptr);
    glCompileShader(shader.id());
    GLint compiled = GL_FALSE, length = 0;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE)
        return shader;
    glGetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader.id(), length, nullptr, log.data());
    const ShaderMessage message = locate(source, log);
    const std::string place =
        message.file.string() + (message.line > 0 ? ":" + std::to_string(message.line) : std::string());
    throw ShaderError(place + ": the shader does not compile:\n" + message.text, message.file, message.line);
}

ProgramHandle link(const ShaderHandle& vertex, const ShaderHandle& geometry, const ShaderHandle& fragment,
                   const std::filesystem::path& file) {
    ProgramHandle program = ProgramHandle::create();
    for (const ShaderHandle* shader : {&vertex, &geometry, &fragment})
        if (*shader)
            glAttachShader(program.id(), shader->id());
    glBindAttribLocation(program.id(), ShaderLibrary::position, "position");
    glBindAttribLocation(program.id(), ShaderLibrary::normal, "normal");
    glBindAttribLocation(program.id(), ShaderLibrary::uv, "uv");
    glBindAttribLocation(program.id(), ShaderLibrary::tangent, "tangent");
    glBindAttribLocation(program.id(), ShaderLibrary::quantity, "quantity");
    glLinkProgram(program.id());
    for (const ShaderHandle* shader : {&vertex, &geometry, &fragment})
        if (*shader)
            glDetachShader(program.id(), shader->id());
    GLint linked = GL_FALSE, length = 0;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
        glGetProgramiv(program.id(), GL_INFO_LOG_LENGTH, &length);
        std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
        glGetProgramInfoLog(program.id(), length, nullptr, log.data());
        std::erase(log, '\0');
        throw ShaderError(file.string() + ": the shader does not link:\n" + log, file, 0);
    }
    const GLuint block = glGetUniformBlockIndex(program.id(), "Frame");
    if (block != GL_INVALID_INDEX)
        glUniformBlockBinding(program.id(), block, ShaderLibrary::frame_binding);
    return program;
}

} // namespace

const Program& ShaderLibrary::find(const std::string& name, const std::string& vertex_file) {
    const auto found = programs_.find(name);
    if (found != programs_.end())
        return found->second;

    const std::filesystem::path fragment_file = name + ".frag", geometry_file = name + ".geom";
    const ShaderHandle fragment = compile(read_shader(folder_, fragment_file), GL_FRAGMENT_SHADER);
    const ShaderHandle vertex = compile(read_shader(folder_, vertex_file), GL_VERTEX_SHADER);
    ShaderHandle geometry;
    std::error_code error;
    if (std::filesystem::exists(folder_ / geometry_file, error))
        geometry = compile(read_shader(folder_, geometry_file), GL_GEOMETRY_SHADER);
    return programs_.emplace(name, Program(link(vertex, geometry, fragment, folder_ / fragment_file))).first->second;
}

const Program& ShaderLibrary::surface(const std::string& name) {
    std::error_code error;
    const bool known = std::filesystem::exists(folder_ / "cloth" / (name + ".frag"), error);
    const bool plain = !name.empty() && name.find_first_of("/\\") == std::string::npos;
    if (!known || !plain) {
        std::string names;
        for (const std::string& other : list_surface_shaders(folder_))
            names += (names.empty() ? "" : ", ") + other;
        throw ShaderError("there is no shader \"" + name + "\" in " + folder_.string() + "; there are: " + names,
                          folder_ / "cloth" / (name + ".frag"), 0);
    }
    const std::string own = "cloth/" + name + ".vert";
    return find("cloth/" + name, std::filesystem::exists(folder_ / own, error) ? own : "cloth/default.vert");
}

} // namespace clothlab::render
