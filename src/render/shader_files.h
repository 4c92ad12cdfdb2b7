// Shader sources as files: which cloth shaders there are, a source with its includes put in, and the places in files
// that a driver's messages mean. Needs no GL.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace clothlab::render {

/// The shader that draws springs over surfaces: lines in one colour.
inline constexpr const char* wireframe_shader = "wireframe";

/// A mistake in a shader, where the driver or the reader of files saw it.
struct ShaderFault {
    std::filesystem::path file;
    int line = 0;     ///< from 1; 0 when it is not known
    std::string text; ///< what is wrong, without the place
    bool operator==(const ShaderFault&) const = default;
};

/// A shader that cannot be read, compiled or linked. The message names file, line where there is one, and what the
/// driver said.
class ShaderError : public std::runtime_error {
public:
    ShaderError(const std::string& message, std::vector<ShaderFault> faults)
        : std::runtime_error(message), faults_(std::move(faults)) {}
    /// At least one, in the order of the text.
    const std::vector<ShaderFault>& faults() const { return faults_; }
    const std::filesystem::path& file() const { return faults_.front().file; }
    /// The first faulty line, from 1; 0 when it is not known.
    int line() const { return faults_.front().line; }

private:
    std::vector<ShaderFault> faults_;
};

/// Where shaders are read from: folders like the repository's shaders/, of which the first that has a file wins, and
/// texts that stand for files as long as an editor has them unsaved.
class ShaderFolders {
public:
    /// A path or text that names one folder.
    template <class Folder>
    requires std::is_convertible_v<Folder, std::filesystem::path> ShaderFolders(const Folder& folder)
        : folders_{std::filesystem::path(folder)} {}
    /// At least one.
    ShaderFolders(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}

    const std::vector<std::filesystem::path>& folders() const { return folders_; }
    /// The file of a name like "cloth/diffuse.frag": in the first folder that has it, else where the last would have
    /// it.
    std::filesystem::path find(const std::filesystem::path& name) const;
    bool has(const std::filesystem::path& name) const;
    /// A file's text, read or edited, without a byte order mark and with \n at the ends of its lines; nothing when it
    /// cannot be read.
    std::optional<std::string> text(const std::filesystem::path& file) const;

    /// From files, as find() gives them, to their unsaved texts.
    std::map<std::filesystem::path, std::string> edited;

private:
    std::vector<std::filesystem::path> folders_;
};

/// The names of the cloth's shaders in shader folders: the stem of every cloth/*.frag, sorted.
std::vector<std::string> list_surface_shaders(const ShaderFolders& folders);

/// The names of a program's files: "cloth/diffuse.frag", "cloth/default.vert"; a geometry stage only where there is
/// one.
struct ProgramFiles {
    std::string fragment, vertex, geometry;
};
/// Those of a cloth shader: cloth/NAME.frag with cloth/NAME.vert or else cloth/default.vert.
ProgramFiles surface_files(const ShaderFolders& folders, const std::string& shader);

/// The files that a cloth shader is made of: its stages, and what they include. Names that cannot be read are left out.
std::vector<std::filesystem::path> files_of_surface(const ShaderFolders& folders, const std::string& shader);

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
/// folders. Throws ShaderError for a file that cannot be read, naming the line that asked for it.
ShaderSource read_shader(const ShaderFolders& folders, const std::filesystem::path& name);

/// A driver's message with lines of the text made files and lines again, and its errors one by one: at least one, the
/// whole message where the driver names no place.
struct ShaderMessage {
    std::string text;
    std::vector<ShaderFault> faults;
};
ShaderMessage locate(const ShaderSource& source, const std::string& driver_log);

} // namespace clothlab::render
