// Programs built from the files of shader folders, each compiled when it is first asked for, and kept when files become
// faulty.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

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

    explicit ShaderLibrary(ShaderFolders folders) : folders_(std::move(folders)) {}
    const ShaderFolders& folders() const { return folders_; }

    /// The program of the files name.vert, name.frag and, where there is one, name.geom, below the folders. After
    /// reload(), texts that do not compile leave the program that was there before in use, and errors() tells of them.
    /// Throws ShaderError when there has never been one.
    const Program& program(const std::string& name);
    /// The same for a cloth shader: see surface_files().
    const Program& surface(const std::string& name);

    /// The files may have changed: each program is looked at anew when it is next asked for, and compiled anew when its
    /// text is another one.
    void reload();
    /// The same, with other unsaved texts in place of files.
    void reload(std::map<std::filesystem::path, std::string> edited);
    /// What is wrong with the texts of programs that were asked for since the last reload and go on as they were before
    /// it; by name.
    std::vector<ShaderError> errors() const;

private:
    struct Entry {
        std::optional<Program> program;   ///< the last that there was no error in
        std::string text;                 ///< that it was made of
        std::optional<ShaderError> error; ///< of what came after it
        std::string faulty_text;          ///< that does not compile; known, so that it is not tried at every draw
        bool fresh = false;               ///< looked at since the last reload
    };
    const Program& find(const std::string& name, const ProgramFiles& files);
    void build(Entry& entry, const ProgramFiles& files);
    /// Keeps the last program, or throws where there is none.
    const Program& refuse(Entry& entry, const ShaderError& error);
    ShaderFolders folders_;
    std::map<std::string, Entry> entries_;
};

} // namespace clothlab::render
