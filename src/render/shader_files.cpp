#include "render/shader_files.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

namespace clothlab::render {

namespace {

struct Asked {
    std::filesystem::path by; ///< empty: not by a file
    int line = 0;
};

std::string read_text(const ShaderFolders& folders, const std::filesystem::path& path, const Asked& asked) {
    if (auto text = folders.text(path))
        return std::move(*text);
    const std::string what = "cannot read the shader " + path.string();
    if (asked.by.empty())
        throw ShaderError(what, {{path, 0, what}});
    throw ShaderError(asked.by.string() + ":" + std::to_string(asked.line) + ": " + what,
                      {{asked.by, asked.line, what}});
}

/// The path in a line `#include "path"`, else empty.
std::string included(const std::string& line) {
    static const std::regex pattern(R"(^\s*#\s*include\s+"([^"]+)\"\s*(//.*)?$)");
    if (line.find("include") == std::string::npos)
        return {};
    std::smatch match;
    return std::regex_match(line, match, pattern) ? match[1].str() : std::string();
}

void append(ShaderSource& source, const ShaderFolders& folders, const std::filesystem::path& path, const Asked& asked) {
    const std::string text = read_text(folders, path, asked);
    const std::size_t number = source.files.size();
    source.files.push_back(path);
    std::istringstream lines(text);
    std::string line;
    for (int n = 1; std::getline(lines, line); ++n) {
        const std::string name = included(line);
        if (name.empty()) {
            source.text += line + "\n";
            source.lines.push_back({number, n});
            continue;
        }
        const std::filesystem::path file = folders.find(name);
        if (std::find(source.files.begin(), source.files.end(), file) == source.files.end())
            append(source, folders, file, {path, n});
    }
}

/// Adds a file and what it includes to `files`, each once; files that cannot be read are left out.
void collect(std::vector<std::filesystem::path>& files, const ShaderFolders& folders, const std::string& name) {
    const std::filesystem::path file = folders.find(name);
    const auto text = folders.text(file);
    if (!text || std::find(files.begin(), files.end(), file) != files.end())
        return;
    files.push_back(file);
    std::istringstream lines(*text);
    for (std::string line; std::getline(lines, line);)
        if (const std::string other = included(line); !other.empty())
            collect(files, folders, other);
}

/// What a driver says after the line's number, "(5): error: ...", " : error C1008: ..." or ": ...": the sentence alone.
std::string sentence(const std::string& after_the_line) {
    static const std::regex start(R"(^(\(\d+\))?[\s:]*(error:\s*)?)", std::regex::icase);
    return std::regex_replace(after_the_line, start, "", std::regex_constants::format_first_only);
}

} // namespace

std::filesystem::path ShaderFolders::find(const std::filesystem::path& name) const {
    for (const std::filesystem::path& folder : folders_) {
        const std::filesystem::path file = (folder / name).lexically_normal();
        std::error_code error;
        if (edited.contains(file) || std::filesystem::is_regular_file(file, error))
            return file;
    }
    return (folders_.back() / name).lexically_normal();
}

bool ShaderFolders::has(const std::filesystem::path& name) const {
    const std::filesystem::path file = find(name);
    std::error_code error;
    return edited.contains(file) || std::filesystem::is_regular_file(file, error);
}

std::optional<std::string> ShaderFolders::text(const std::filesystem::path& file) const {
    if (const auto found = edited.find(file); found != edited.end())
        return found->second;
    std::ifstream in(file, std::ios::binary);
    std::error_code error;
    if (!in || std::filesystem::is_directory(file, error))
        return std::nullopt;
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (text.starts_with("\xEF\xBB\xBF"))
        text.erase(0, 3);
    std::erase(text, '\r');
    return text;
}

std::vector<std::string> list_surface_shaders(const ShaderFolders& folders) {
    std::vector<std::string> names;
    for (const std::filesystem::path& folder : folders.folders()) {
        std::error_code error;
        std::filesystem::directory_iterator entries(folder / "cloth", error), end;
        for (; !error && entries != end; entries.increment(error)) {
            const std::filesystem::path& path = entries->path();
            if (path.extension() == ".frag")
                names.push_back(path.stem().string());
        }
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

ProgramFiles surface_files(const ShaderFolders& folders, const std::string& shader) {
    const std::string stem = "cloth/" + shader;
    ProgramFiles files{stem + ".frag", stem + ".vert", stem + ".geom"};
    if (!folders.has(files.vertex))
        files.vertex = "cloth/default.vert";
    if (!folders.has(files.geometry))
        files.geometry.clear();
    return files;
}

std::vector<std::filesystem::path> files_of_surface(const ShaderFolders& folders, const std::string& shader) {
    const ProgramFiles names = surface_files(folders, shader);
    std::vector<std::filesystem::path> stages, files;
    for (const std::string& name : {names.fragment, names.vertex, names.geometry})
        if (!name.empty() && folders.has(name))
            stages.push_back(folders.find(name));
    for (const std::string& name : {names.fragment, names.vertex, names.geometry})
        if (!name.empty())
            collect(files, folders, name);
    // The shader's own files first, then what they share with others.
    std::stable_partition(files.begin(), files.end(), [&](const std::filesystem::path& file) {
        return std::find(stages.begin(), stages.end(), file) != stages.end();
    });
    return files;
}

ShaderSource read_shader(const ShaderFolders& folders, const std::filesystem::path& name) {
    ShaderSource source;
    append(source, folders, folders.find(name), {});
    return source;
}

ShaderMessage locate(const ShaderSource& source, const std::string& driver_log) {
    // "0:12(5): error" (Mesa), "0(12) : error" (NVIDIA), "ERROR: 0:12:" (macOS, Intel, AMD): string number, then line.
    static const std::regex pattern(R"((^|\s)0(?::(\d{1,7})|\((\d{1,7})\)))");
    ShaderMessage message;
    std::istringstream lines(driver_log);
    std::string line;
    while (std::getline(lines, line)) {
        std::erase(line, '\0');
        std::smatch match;
        if (std::regex_search(line, match, pattern)) {
            const std::size_t n = std::stoul(match[2].matched ? match[2].str() : match[3].str());
            if (n >= 1 && n <= source.lines.size()) {
                const ShaderSource::Line& origin = source.lines[n - 1];
                const std::filesystem::path& file = source.files[origin.file];
                if (line.find("warning") == std::string::npos)
                    message.faults.push_back({file, origin.number, sentence(match.suffix().str())});
                line = match.prefix().str() + match[1].str() + file.string() + ":" + std::to_string(origin.number) +
                       match.suffix().str();
            }
        }
        if (!line.empty())
            message.text += (message.text.empty() ? "" : "\n") + line;
    }
    if (message.faults.empty())
        message.faults.push_back(
            {source.files.empty() ? std::filesystem::path() : source.files.front(), 0, message.text});
    return message;
}

} // namespace clothlab::render
