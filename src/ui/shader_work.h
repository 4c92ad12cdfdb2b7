// What the shader panel shows and asks for: the files of the chosen shader, and what is wrong with them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace clothlab::ui {

struct ShaderFile {
    std::string name;           ///< below its folder: "cloth/diffuse.frag"
    std::filesystem::path file; ///< that shaders are made of now
    std::string saved;          ///< its text on disk
    bool shipped = false;       ///< comes with the program: saving makes a copy in the user's folder, used from then on
    bool hides_shipped = false; ///< the user's copy of a shipped file
    bool operator==(const ShaderFile&) const = default;
};

struct ShaderFault {
    std::filesystem::path file;
    int line = 0; ///< from 1; 0 when it is not known
    std::string text;
    bool operator==(const ShaderFault&) const = default;
};

/// Draw with this text in place of a file's, nothing: with the file's.
struct EditShader {
    std::string name;
    std::optional<std::string> text;
};
struct SaveShader {
    std::string name, text;
};
/// A copy of a shader's own files under a new name, which is then chosen.
struct CopyShader {
    std::string from, name;
};
/// Puts the user's copy of a shipped file aside.
struct UseShippedShader {
    std::string name;
};
using ShaderRequest = std::variant<EditShader, SaveShader, CopyShader, UseShippedShader>;

struct ShaderEditors; ///< the panel's own: texts, cursors, what was undone

struct ShaderWork {
    std::vector<ShaderFile> files;    ///< of the chosen shader, of faults and of unsaved texts
    std::vector<ShaderFault> faults;  ///< while there are any, the last good shaders draw
    std::string notice;               ///< what became of the last request, until the next edit
    std::filesystem::path folder;     ///< where shaders are saved; empty: nowhere
    std::optional<ShaderFault> go_to; ///< the panel is to show this place
    bool asking_to_quit = false;      ///< what is to become of unsaved texts?
    double pause_s = 0.4;             ///< the picture follows what is typed once nothing was typed for so long
    std::shared_ptr<ShaderEditors> editors;
};

/// How a fault's file is named for people: below the shader folder where it is known.
std::string place_of(const ShaderWork& work, const ShaderFault& fault);

} // namespace clothlab::ui
