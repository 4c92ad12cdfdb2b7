#include "app/core/data_folder.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace clothlab::app {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> data_folders() {
    std::vector<fs::path> folders;
    if (const char* named = std::getenv("CLOTHLAB_DATA"); named && *named)
        folders.emplace_back(named);
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (!error) {
        const fs::path folder = program.parent_path();
        folders.insert(folders.end(), {folder, folder.parent_path(), folder.parent_path() / "share" / "clothlab"});
    }
    folders.emplace_back(CLOTHLAB_SOURCE_DIR);
    return folders;
}

/// The files of a folder with an extension, sorted; none when there is no such folder.
std::vector<fs::path> files_in(const fs::path& folder, const char* extension) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
        if (entry.path().extension() == extension)
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace

fs::path data_path(const fs::path& name) {
    std::string looked;
    for (const fs::path& folder : data_folders()) {
        std::error_code error;
        if (fs::exists(folder / name, error))
            return (folder / name).lexically_normal();
        looked += (looked.empty() ? "" : ", ") + folder.string();
    }
    throw std::runtime_error(name.string() + " is missing; looked in " + looked +
                             "; set CLOTHLAB_DATA to the folder that holds it");
}

fs::path scene_path(const std::string& what) {
    std::error_code error;
    if (fs::exists(what, error))
        return what;
    for (const fs::path& file : shipped_scenes())
        if (file.stem() == what || file.filename() == what)
            return file;
    return what;
}

std::vector<fs::path> shipped_scenes() {
    return files_in(data_path("scenes"), ".json");
}

std::vector<std::string> shipped_shaders() {
    std::vector<std::string> names;
    for (const fs::path& file : files_in(data_path("shaders") / "cloth", ".frag"))
        names.push_back(file.stem().string());
    return names;
}

fs::path user_shader_folder() {
    if (const char* data = std::getenv("XDG_DATA_HOME"); data && *data)
        return fs::path(data) / "clothlab" / "shaders";
    if (const char* home = std::getenv("HOME"); home && *home)
        return fs::path(home) / ".local" / "share" / "clothlab" / "shaders";
    return {};
}

std::vector<fs::path> shader_folders() {
    std::vector<fs::path> folders;
    if (fs::path own = user_shader_folder(); !own.empty())
        folders.push_back(std::move(own));
    folders.push_back(data_path("shaders"));
    return folders;
}

std::vector<std::string> known_shaders() {
    std::vector<std::string> names = shipped_shaders();
    if (const fs::path own = user_shader_folder(); !own.empty())
        for (const fs::path& file : files_in(own / "cloth", ".frag"))
            names.push_back(file.stem().string());
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

} // namespace clothlab::app
