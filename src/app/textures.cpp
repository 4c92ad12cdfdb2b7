#include "app/textures.h"

#include <algorithm>
#include <cctype>

#include "render/procedural.h"

namespace clothlab::app {
namespace fs = std::filesystem;
namespace {

std::string extension(const fs::path& file) {
    std::string text = file.extension().string();
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

/// Calls change(path) for every texture of a look that is a file.
template <class Change>
void for_each_file(scene::Look& look, const std::vector<scene::ShaderDeclaration>& shaders, Change change) {
    for (const scene::ShaderDeclaration& shader : shaders) {
        const auto values = look.shaders.find(shader.name);
        if (values == look.shaders.end())
            continue;
        for (auto& [name, value] : values->second) {
            const scene::ShaderParameter* parameter = shader.find(name);
            auto* text = std::get_if<std::string>(&value);
            if (parameter && parameter->type == scene::ShaderParameterType::texture && text && !text->empty() &&
                !render::find_built_in(*text))
                *text = change(fs::path(*text)).string();
        }
    }
}

} // namespace

void resolve_textures(scene::Look& look, const std::vector<scene::ShaderDeclaration>& shaders, const fs::path& folder) {
    for_each_file(look, shaders, [&](const fs::path& file) {
        std::error_code error;
        const fs::path absolute = fs::absolute(folder, error);
        return file.is_absolute() || error ? file : (absolute / file).lexically_normal();
    });
}

void relate_textures(scene::Look& look, const std::vector<scene::ShaderDeclaration>& shaders, const fs::path& folder) {
    for_each_file(look, shaders, [&](const fs::path& file) {
        std::error_code error;
        const fs::path absolute = fs::absolute(folder, error).lexically_normal();
        const fs::path relative = file.lexically_relative(absolute);
        return error || !file.is_absolute() || relative.empty() || *relative.begin() == ".." ? file : relative;
    });
}

const scene::ShaderParameter* parameter_for_picture(const scene::ShaderDeclaration& shader, const fs::path& picture) {
    const auto find = [&](bool environment) -> const scene::ShaderParameter* {
        for (const scene::ShaderParameter& p : shader.parameters)
            if (p.type == scene::ShaderParameterType::texture &&
                (p.usage == scene::TextureUsage::environment) == environment)
                return &p;
        return nullptr;
    };
    const bool panorama = extension(picture) == ".hdr";
    const scene::ShaderParameter* wanted = find(panorama);
    return wanted ? wanted : find(!panorama);
}

std::vector<std::array<float, 3>> ramp_colours(const std::string& name) {
    render::Image image;
    if (const render::BuiltInTexture* built_in = render::find_built_in(name)) {
        if (const auto* make = std::get_if<render::Image (*)()>(&built_in->make))
            image = (*make)();
    } else {
        try {
            image = render::read_png(name);
        } catch (const std::exception&) {
            return {}; // whoever draws with it says what is wrong
        }
    }
    std::vector<std::array<float, 3>> colours;
    for (int x = 0; x < image.width; ++x) {
        const std::uint8_t* c = image.pixel(x, image.height / 2);
        colours.push_back(
            {static_cast<float>(c[0]) / 255, static_cast<float>(c[1]) / 255, static_cast<float>(c[2]) / 255});
    }
    return colours;
}

bool is_picture(const fs::path& file) {
    const std::string end = extension(file);
    return end == ".png" || end == ".jpg" || end == ".jpeg" || end == ".hdr";
}

} // namespace clothlab::app
