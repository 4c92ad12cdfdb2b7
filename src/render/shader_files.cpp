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

std::string read_text(const std::filesystem::path& path, const Asked& asked) {
    std::ifstream file(path, std::ios::binary);
    std::error_code error;
    if (!file || std::filesystem::is_directory(path, error)) {
        const std::string what = "cannot read the shader " + path.string();
        if (asked.by.empty())
            throw ShaderError(what, path, 0);
        throw ShaderError(asked.by.string() + ":" + std::to_string(asked.line) + ": " + what, asked.by, asked.line);
    }
    std::string text{std::istreambuf_iterator<char>(file), {}};
    if (text.starts_with("\xEF\xBB\xBF"))
        text.erase(0, 3);
    std::erase(text, '\r');
    return text;
}

/// The path in a line `#include "path"`, else empty.
std::string included(const std::string& line) {
    static const std::regex pattern(R"(^\s*#\s*include\s+"([^"]+)\"\s*(//.*)?$)");
    if (line.find("include") == std::string::npos)
        return {};
    std::smatch match;
    return std::regex_match(line, match, pattern) ? match[1].str() : std::string();
}

void append(ShaderSource& source, const std::filesystem::path& folder, const std::filesystem::path& path,
            const Asked& asked) {
    const std::string text = read_text(path, asked);
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
        const std::filesystem::path file = (folder / name).lexically_normal();
        if (std::find(source.files.begin(), source.files.end(), file) == source.files.end())
            append(source, folder, file, {path, n});
    }
}

} // namespace

std::vector<std::string> list_surface_shaders(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    std::filesystem::directory_iterator entries(folder / "cloth", error), end;
    for (; !error && entries != end; entries.increment(error)) {
        const std::filesystem::path& path = entries->path();
        if (path.extension() == ".frag")
            names.push_back(path.stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

ShaderSource read_shader(const std::filesystem::path& folder, const std::filesystem::path& file) {
    ShaderSource source;
    append(source, folder, (folder / file).lexically_normal(), {});
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
                if (message.file.empty() && line.find("warning") == std::string::npos) {
                    message.file = file;
                    message.line = origin.number;
                }
                line = match.prefix().str() + match[1].str() + file.string() + ":" + std::to_string(origin.number) +
                       match.suffix().str();
            }
        }
        if (!line.empty())
            message.text += (message.text.empty() ? "" : "\n") + line;
    }
    if (message.file.empty() && !source.files.empty())
        message.file = source.files.front();
    return message;
}

} // namespace clothlab::render
