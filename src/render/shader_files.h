// Shader sources as files: which cloth shaders a folder offers, and a source with its includes put in. Needs no GL.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace clothlab::render {

/// The shader that draws springs over surfaces: lines in one colour.
inline constexpr const char* wireframe_shader = "wireframe";

/// A shader that cannot be read, compiled or linked. The message names file, line where there is one, and what the
/// driver said.
class ShaderError : public std::runtime_error {
public:
    ShaderError(const std::string& message, std::filesystem::path file, int line)
        : std::runtime_error(message), file_(std::move(file)), line_(line) {}
    const std::filesystem::path& file() const { return file_; }
    /// The first faulty line, from 1; 0 when it is not known.
    int line() const { return line_; }

private:
    std::filesystem::path file_;
    int line_;
};

/// The names of the cloth's shaders in a shader folder: the stem of every cloth/*.frag, sorted.
std::vector<std::string> list_surface_shaders(const std::filesystem::path& folder);

/// A shader's text, ready for the compiler, and where each of its lines comes from. The text has no #line directives:
/// Mesa reports undeclared names as if they were in file 0, whatever a directive said; a table of our own is right with
/// every driver.
struct ShaderSource {
    struct Line {
        std::size_t file; ///< an index into files
        int number;       ///< from 1
    };
    std::string text;
    std::vector<Line> lines;
    std::vector<std::filesystem::path> files;
};

/// Reads a shader and puts in the files named by lines `#include "path"`, each once; paths are relative to the shader
/// folder. Throws ShaderError for a file that cannot be read, naming the line that asked for it.
ShaderSource read_shader(const std::filesystem::path& folder, const std::filesystem::path& file);

/// A driver's message with lines of the text made files and lines again, and the place of the first error.
struct ShaderMessage {
    std::string text;
    std::filesystem::path file;
    int line = 0;
};
ShaderMessage locate(const ShaderSource& source, const std::string& driver_log);

} // namespace clothlab::render
