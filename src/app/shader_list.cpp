#include "app/shader_list.h"

#include <algorithm>

#include "scene/error.h"

namespace clothlab::app {
namespace {

scene::ShaderDeclaration read_shader(const render::ShaderFolders& folders, const std::string& name,
                                     std::map<std::string, render::ShaderFault>* faults) {
    scene::ShaderDeclaration shader;
    shader.name = shader.title = name;
    render::ShaderSource source;
    try {
        const render::ProgramFiles files = render::surface_files(folders, name);
        source = render::read_shader(folders, files.fragment);
        if (files.vertex == "cloth/" + name + ".vert") {
            render::ShaderSource more = render::read_shader(folders, files.vertex);
            source.text += more.text;
            for (render::ShaderSource::Line line : more.lines)
                source.lines.push_back({line.file + source.files.size(), line.number});
            source.files.insert(source.files.end(), more.files.begin(), more.files.end());
        }
        return scene::read_shader_declaration(name, source.text);
    } catch (const scene::ShaderDeclarationError& e) {
        const render::ShaderSource::Line& line = source.lines.at(static_cast<std::size_t>(e.line() - 1));
        const render::ShaderFault fault{source.files[line.file], line.number, e.what()};
        shader.error = fault.file.string() + ":" + std::to_string(fault.line) + ": " + fault.text;
        if (faults != nullptr)
            faults->emplace(name, fault);
    } catch (const render::ShaderError& e) {
        shader.error = e.what();
    }
    return shader;
}

} // namespace

std::vector<scene::ShaderDeclaration> read_shader_list(const render::ShaderFolders& folders,
                                                       std::map<std::string, render::ShaderFault>* faults) {
    std::vector<scene::ShaderDeclaration> shaders;
    for (const std::string& name : render::list_surface_shaders(folders))
        shaders.push_back(read_shader(folders, name, faults));
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
