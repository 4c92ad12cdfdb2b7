// Where the files lie that the program comes with: shaders/, scenes/, fonts/, imgui.ini.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace clothlab::app {

/// A file or folder that the program comes with. Looked for in the folder named by the environment variable
/// CLOTHLAB_DATA, beside the program, one folder above it (a build folder in a checkout), in ../share/clothlab
/// (installed) and in the checkout that it was built from. Throws std::runtime_error that names all of these when it is
/// in none.
std::filesystem::path data_path(const std::filesystem::path& name);

/// The scene that a user means by `what`: a file, or the name of one that the program comes with, with or without
/// ".json". Where it is neither, `what` itself, so that reading it says what is wrong.
std::filesystem::path scene_path(const std::string& what);

/// The scene files that the program comes with, by name.
std::vector<std::filesystem::path> shipped_scenes();

/// The names of the shaders that the program comes with: a file shaders/cloth/NAME.frag each.
std::vector<std::string> shipped_shaders();

/// Where the user's own shaders lie, and changed copies of shipped ones: $XDG_DATA_HOME/clothlab/shaders or
/// ~/.local/share/clothlab/shaders, with the same files in it as in the shipped folder. Empty when there is no home. It
/// is made when the first shader is saved.
std::filesystem::path user_shader_folder();

/// The folders that shaders are looked for in: the user's, where there is a home, and the shipped one, which the first
/// hides files of.
std::vector<std::filesystem::path> shader_folders();

/// The names of all shaders, the user's and the shipped ones, sorted.
std::vector<std::string> known_shaders();

} // namespace clothlab::app
