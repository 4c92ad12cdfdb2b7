#include "app/shader_list.h"

#include <algorithm>

#include "render/shader_files.h"
#include "scene/error.h"

namespace clothlab::app {
namespace fs = std::filesystem;
namespace {

scene::ShaderDeclaration read_shader(const fs::path& folder, const std::string& name) {
    scene::ShaderDeclaration shader;
    shader.name = shader.title = name;
    render::ShaderSource source;
    try {
        const fs::path fragment = fs::path("cloth") / (name + ".frag");
        source = render::read_shader(folder, fragment);
        std::error_code error;
        const fs::path vertex = fs::path("cloth") / (name + ".vert");
        if (fs::exists(folder / vertex, error)) {
            render::ShaderSource more = render::read_shader(folder, vertex);
            source.text += more.text;
            for (render::ShaderSource::Line line : more.lines)
                source.lines.push_back({line.file + source.files.size(), line.number});
            source.files.insert(source.files.end(), more.files.begin(), more.files.end());
        }
        return scene::read_shader_declaration(name, source.text);
    } catch (const scene::ShaderDeclarationError& e) {
        const render::ShaderSource::Line& line = source.lines.at(static_cast<std::size_t>(e.line() - 1));
        shader.error = source.files[line.file].string() + ":" + std::to_string(line.number) + ": " + e.what();
    } catch (const render::ShaderError& e) {
        shader.error = e.what();
    }
    return shader;
}

} // namespace

std::vector<scene::ShaderDeclaration> read_shader_list(const fs::path& folder) {
    std::vector<scene::ShaderDeclaration> shaders;
    for (const std::string& name : render::list_surface_shaders(folder))
        shaders.push_back(read_shader(folder, name));
    return shaders;
}

const scene::ShaderDeclaration& find_shader(const std::vector<scene::ShaderDeclaration>& shaders,
                                            const std::string& name) {
    const auto found = std::find_if(shaders.begin(), shaders.end(),
                                    [&](const scene::ShaderDeclaration& shader) { return shader.name == name; });
    if (found != shaders.end())
        return *found;
    std::string names;
    for (const scene::ShaderDeclaration& shader : shaders)
        names += (names.empty() ? "" : ", ") + shader.name;
    throw scene::SceneError("there is no shader \"" + name + "\"; there are " + names);
}

} // namespace clothlab::app
