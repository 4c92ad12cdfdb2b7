#include "render/shader_library.h"

#include <algorithm>

namespace clothlab::render {

namespace {

ShaderHandle compile(const ShaderSource& source, GLenum stage) {
    ShaderHandle shader(glCreateShader(stage));
    const char* text = source.text.c_str();
    glShaderSource(shader.id(), 1, &text, nullptr);
    glCompileShader(shader.id());
    GLint compiled = GL_FALSE, length = 0;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE)
        return shader;
    glGetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader.id(), length, nullptr, log.data());
    const ShaderMessage message = locate(source, log);
    const ShaderFault& first = message.faults.front();
    const std::string place = first.file.string() + (first.line > 0 ? ":" + std::to_string(first.line) : std::string());
    throw ShaderError(place + ": the shader does not compile:\n" + message.text, message.faults);
}

ProgramHandle link(const ShaderHandle& vertex, const ShaderHandle& geometry, const ShaderHandle& fragment,
                   const std::filesystem::path& file) {
    ProgramHandle program = ProgramHandle::create();
    for (const ShaderHandle* shader : {&vertex, &geometry, &fragment})
        if (*shader)
            glAttachShader(program.id(), shader->id());
    glBindAttribLocation(program.id(), ShaderLibrary::position, "position");
    glBindAttribLocation(program.id(), ShaderLibrary::normal, "normal");
    glBindAttribLocation(program.id(), ShaderLibrary::uv, "uv");
    glBindAttribLocation(program.id(), ShaderLibrary::tangent, "tangent");
    glBindAttribLocation(program.id(), ShaderLibrary::quantity, "quantity");
    glLinkProgram(program.id());
    for (const ShaderHandle* shader : {&vertex, &geometry, &fragment})
        if (*shader)
            glDetachShader(program.id(), shader->id());
    GLint linked = GL_FALSE, length = 0;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
        glGetProgramiv(program.id(), GL_INFO_LOG_LENGTH, &length);
        std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
        glGetProgramInfoLog(program.id(), length, nullptr, log.data());
        std::erase(log, '\0');
        throw ShaderError(file.string() + ": the shader does not link:\n" + log,
                          {{file, 0, "the shader does not link: " + log}});
    }
    const GLuint block = glGetUniformBlockIndex(program.id(), "Frame");
    if (block != GL_INVALID_INDEX)
        glUniformBlockBinding(program.id(), block, ShaderLibrary::frame_binding);
    return program;
}

} // namespace

const Program& ShaderLibrary::refuse(Entry& entry, const ShaderError& error) {
    entry.error = error;
    if (!entry.program)
        throw error;
    entry.fresh = true;
    return *entry.program;
}

void ShaderLibrary::build(Entry& entry, const ProgramFiles& files) {
    const ShaderSource fragment = read_shader(folders_, files.fragment), vertex = read_shader(folders_, files.vertex);
    ShaderSource geometry;
    if (!files.geometry.empty())
        geometry = read_shader(folders_, files.geometry);
    std::string text = fragment.text + '\0' + vertex.text + '\0' + geometry.text;
    if (entry.program && text == entry.text)
        return;
    if (entry.error && text == entry.faulty_text)
        throw ShaderError(*entry.error);
    entry.faulty_text = text;
    const ShaderHandle fragment_shader = compile(fragment, GL_FRAGMENT_SHADER),
                       vertex_shader = compile(vertex, GL_VERTEX_SHADER);
    ShaderHandle geometry_shader;
    if (!files.geometry.empty())
        geometry_shader = compile(geometry, GL_GEOMETRY_SHADER);
    entry.program.emplace(link(vertex_shader, geometry_shader, fragment_shader, fragment.files.front()));
    entry.text = std::move(text);
}

const Program& ShaderLibrary::find(const std::string& name, const ProgramFiles& files) {
    Entry& entry = entries_[name];
    if (entry.program && entry.fresh)
        return *entry.program;
    try {
        build(entry, files);
    } catch (const ShaderError& error) {
        return refuse(entry, error);
    }
    entry.error.reset();
    entry.faulty_text.clear();
    entry.fresh = true;
    return *entry.program;
}

const Program& ShaderLibrary::program(const std::string& name) {
    ProgramFiles files{name + ".frag", name + ".vert", name + ".geom"};
    if (!folders_.has(files.geometry))
        files.geometry.clear();
    return find(name, files);
}

const Program& ShaderLibrary::surface(const std::string& name) {
    const bool plain = !name.empty() && name.find_first_of("/\\") == std::string::npos;
    const ProgramFiles files = surface_files(folders_, name);
    if (plain && folders_.has(files.fragment))
        return find("cloth/" + name, files);

    std::string names, places;
    for (const std::string& other : list_surface_shaders(folders_))
        names += (names.empty() ? "" : ", ") + other;
    for (const std::filesystem::path& folder : folders_.folders())
        places += (places.empty() ? "" : " or ") + folder.string();
    const std::string what = "there is no shader \"" + name + "\" in " + places;
    const ShaderError error(what + "; there are: " + names, {{folders_.find(files.fragment), 0, what}});
    if (!plain)
        throw error;
    return refuse(entries_["cloth/" + name], error);
}

void ShaderLibrary::reload() {
    for (auto& [name, entry] : entries_)
        entry.fresh = false;
}

void ShaderLibrary::reload(std::map<std::filesystem::path, std::string> edited) {
    folders_.edited = std::move(edited);
    reload();
}

std::vector<ShaderError> ShaderLibrary::errors() const {
    std::vector<ShaderError> errors;
    for (const auto& [name, entry] : entries_)
        if (entry.fresh && entry.error)
            errors.push_back(*entry.error);
    return errors;
}

} // namespace clothlab::render
