#include "app/gui/shader_desk.h"

#include <algorithm>
#include <regex>

#include "app/shader_list.h"
#include "scene/io.h"

namespace clothlab::app {
namespace fs = std::filesystem;
namespace {

/// The text of a shader's copy: it is called by its new name in lists.
std::string renamed(const std::string& text, const std::string& name) {
    static const std::regex title(R"re((//@\s*shader\b[^\n]*\btitle=")[^"\n]*")re");
    return std::regex_replace(text, title, "$1" + name + "\"", std::regex_constants::format_first_only);
}

bool is_plain_name(const std::string& name) {
    static const std::regex plain("[A-Za-z0-9][A-Za-z0-9_-]*");
    return std::regex_match(name, plain);
}

} // namespace

ShaderDesk::ShaderDesk(render::Renderer& renderer, ui::Lab& lab, fs::path user_folder, double seconds)
    : renderer_(renderer), lab_(lab), user_folder_(std::move(user_folder)), seconds_(seconds),
      watch_(renderer.shader_folders().folders()) {
    lab_.shader_work.folder = user_folder_;
    list_shaders();
}

void ShaderDesk::reload() {
    // By name, as the file of a name is another one after the first save of a shipped shader.
    const render::ShaderFolders disk(renderer_.shader_folders().folders());
    std::map<fs::path, std::string> texts;
    for (const auto& [name, text] : edited_)
        texts.emplace(disk.find(name), text);
    renderer_.reload_shaders(std::move(texts));
    list_shaders();
    changed_ = files_changed_ = true;
}

void ShaderDesk::list_shaders() {
    misdeclared_.clear();
    std::vector<scene::ShaderDeclaration> shaders = read_shader_list(renderer_.shader_folders(), &misdeclared_);
    // As the program of a faulty shader goes on, so do its parameters.
    for (scene::ShaderDeclaration& shader : shaders) {
        const auto before = std::find_if(lab_.shaders.begin(), lab_.shaders.end(),
                                         [&](const scene::ShaderDeclaration& s) { return s.name == shader.name; });
        if (shader.error.empty() || before == lab_.shaders.end())
            continue;
        std::string error = std::move(shader.error);
        shader = *before;
        shader.error = std::move(error);
    }
    lab_.shaders = std::move(shaders);
}

void ShaderDesk::update() {
    if (watch_.look_after(seconds_))
        reload();
    if (files_changed_ || listed_ != lab_.scene.look.shader)
        list_files();
}

bool ShaderDesk::take_changed() {
    return std::exchange(changed_, false);
}

std::string ShaderDesk::name_of(const fs::path& file) const {
    for (const fs::path& folder : renderer_.shader_folders().folders())
        if (const fs::path below = file.lexically_relative(folder.lexically_normal());
            !below.empty() && *below.begin() != "..")
            return below.generic_string();
    return file.string();
}

bool ShaderDesk::is_shipped(const fs::path& file) const {
    return user_folder_.empty() ||
           file == (renderer_.shader_folders().folders().back() / name_of(file)).lexically_normal();
}

void ShaderDesk::list_files() {
    const render::ShaderFolders& folders = renderer_.shader_folders();
    std::vector<fs::path> paths = render::files_of_surface(folders, lab_.scene.look.shader);
    const auto add = [&](const fs::path& file) {
        if (std::find(paths.begin(), paths.end(), file) == paths.end() && folders.text(file))
            paths.push_back(file);
    };
    for (const auto& [name, text] : edited_)
        add(folders.find(name));
    for (const ui::ShaderFault& fault : lab_.shader_work.faults)
        add(fault.file);

    const render::ShaderFolders disk(folders.folders());
    std::vector<ui::ShaderFile> files;
    for (const fs::path& path : paths) {
        ui::ShaderFile file;
        file.name = name_of(path);
        file.file = path;
        file.saved = disk.text(path).value_or("");
        file.shipped = is_shipped(path);
        std::error_code error;
        file.hides_shipped = !file.shipped && fs::is_regular_file(folders.folders().back() / file.name, error);
        files.push_back(std::move(file));
    }
    lab_.shader_work.files = std::move(files);
    listed_ = lab_.scene.look.shader;
    files_changed_ = false;
}

void ShaderDesk::tell(const render::ShaderError* chosen) {
    std::vector<ui::ShaderFault> faults;
    const auto add = [&](const render::ShaderError& error) {
        for (const render::ShaderFault& f : error.faults())
            if (const ui::ShaderFault fault{f.file, f.line, f.text};
                std::find(faults.begin(), faults.end(), fault) == faults.end())
                faults.push_back(fault);
    };
    if (chosen != nullptr)
        add(*chosen);
    for (const render::ShaderError& error : renderer_.shader_errors())
        add(error);
    const scene::Look& look = lab_.scene.look;
    for (const auto& [shader, fault] : misdeclared_)
        if (shader == look.shader || (look.split.on && shader == look.split.shader))
            add(render::ShaderError("", {fault}));
    if (faults == lab_.shader_work.faults)
        return;
    lab_.shader_work.faults = std::move(faults);
    files_changed_ = true;
}

void ShaderDesk::carry_out(const ui::ShaderRequest& request) {
    try {
        std::visit([this](const auto& r) { carry_out(r); }, request);
    } catch (const std::exception& e) { // a folder that cannot be written
        lab_.messages.push_back({true, e.what()});
    }
    reload();
}

void ShaderDesk::carry_out(const ui::EditShader& r) {
    lab_.shader_work.notice.clear();
    if (r.text)
        edited_[r.name] = *r.text;
    else
        edited_.erase(r.name);
}

void ShaderDesk::save(const std::string& name, const std::string& text) {
    if (user_folder_.empty())
        throw std::runtime_error(name + " cannot be saved: there is no folder for the user's shaders (neither HOME nor "
                                        "XDG_DATA_HOME is set)");
    const fs::path file = user_folder_ / name;
    fs::create_directories(file.parent_path());
    scene::write_text_file(text, file);
}

void ShaderDesk::carry_out(const ui::SaveShader& r) {
    const bool copy = is_shipped(renderer_.shader_folders().find(r.name));
    save(r.name, r.text);
    edited_.erase(r.name);
    lab_.shader_work.notice = "saved as " + (user_folder_ / r.name).string();
    if (copy)
        lab_.shader_work.notice += ", a copy that is used from now on";
}

void ShaderDesk::carry_out(const ui::CopyShader& r) {
    const render::ShaderFolders& folders = renderer_.shader_folders();
    if (!is_plain_name(r.name))
        throw std::runtime_error("\"" + r.name + "\" is no name for a shader: letters, digits, - and _ make one");
    if (folders.has("cloth/" + r.name + ".frag"))
        throw std::runtime_error("there is a shader \"" + r.name + "\" already");
    for (const char* stage : {".vert", ".geom", ".frag"})
        if (const std::string name = "cloth/" + r.from + stage; folders.has(name))
            save("cloth/" + r.name + stage, renamed(folders.text(folders.find(name)).value_or(""), r.name));
    lab_.scene.look.shader = r.name;
}

void ShaderDesk::carry_out(const ui::UseShippedShader& r) {
    const fs::path file = user_folder_ / r.name, aside = file.string() + "~";
    fs::rename(file, aside);
    edited_.erase(r.name);
    lab_.shader_work.notice = "the shipped file is used again; your copy is kept as " + aside.string();
}

} // namespace clothlab::app
