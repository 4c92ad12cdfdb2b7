// Programs built from the files of a shader folder, each compiled when it is first asked for.
#pragma once

#include <map>
#include <string>

#include <glm/glm.hpp>

#include "render/gl.h"
#include "render/shader_files.h"

namespace clothlab::render {

/// A linked program. Uniforms that the program does not have are ignored, as a shader need not use them all.
class Program {
public:
    explicit Program(ProgramHandle handle) : handle_(std::move(handle)) {}
    void use() const { glUseProgram(handle_.id()); }
    GLuint id() const { return handle_.id(); }

    // Set uniforms of the program in use.
    void set(const char* name, int value) const { glUniform1i(location(name), value); }
    void set(const char* name, float value) const { glUniform1f(location(name), value); }
    void set(const char* name, const glm::vec2& v) const { glUniform2f(location(name), v.x, v.y); }
    void set(const char* name, const glm::vec3& v) const { glUniform3f(location(name), v.x, v.y, v.z); }
    void set(const char* name, const glm::vec4& v) const { glUniform4f(location(name), v.x, v.y, v.z, v.w); }
    void set(const char* name, const glm::mat4& m) const { glUniformMatrix4fv(location(name), 1, GL_FALSE, &m[0][0]); }

private:
    GLint location(const char* name) const { return glGetUniformLocation(handle_.id(), name); }
    ProgramHandle handle_;
};

class ShaderLibrary {
public:
    /// The vertex attributes that every mesh has in the same places.
    enum Attribute : GLuint { position = 0, normal = 1, uv = 2, tangent = 3, quantity = 4 };
    /// The binding point of the uniform block Frame (shaders/common/frame.glsl).
    static constexpr GLuint frame_binding = 0;

    explicit ShaderLibrary(std::filesystem::path folder) : folder_(std::move(folder)) {}
    const std::filesystem::path& folder() const { return folder_; }

    /// The program of the files name.vert, name.frag and, where there is one, name.geom, below the folder. Throws
    /// ShaderError, every time that it is asked for while the files stay as they are.
    const Program& program(const std::string& name) { return find(name, name + ".vert"); }
    /// The program of a cloth shader: cloth/name.frag with cloth/name.vert or else cloth/default.vert.
    const Program& surface(const std::string& name);
    /// Forgets every program: the files are read anew.
    void reload() { programs_.clear(); }

private:
    const Program& find(const std::string& name, const std::string& vertex_file);
    std::filesystem::path folder_;
    std::map<std::string, Program> programs_;
};

} // namespace clothlab::render
