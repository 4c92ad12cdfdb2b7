#include "render/procedural.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/colour_maps.h"
#include "render/procedural_environments.h"
#include "render/procedural_patterns.h"

namespace clothlab::render {

namespace {

constexpr BuiltInTexture table[] = {
    {"bricks", "Bricks", TextureUsage::colour, bricks},
    {"weave", "Woven fabric", TextureUsage::colour, weave},
    {"skin", "Skin", TextureUsage::colour, skin},
    {"checker", "Checker", TextureUsage::colour, checker},
    {"white", "White", TextureUsage::colour, white},
    {"bricks-height", "Bricks, heights", TextureUsage::height, bricks_height},
    {"weave-height", "Woven fabric, heights", TextureUsage::height, weave_height},
    {"skin-height", "Skin, heights", TextureUsage::height, skin_height},
    {"noise-height", "Hills, heights", TextureUsage::height, noise_height},
    {"toon-ramp", "Four steps of light", TextureUsage::ramp, toon_ramp},
    {"viridis", "Viridis: blue to yellow", TextureUsage::ramp, viridis},
    {"cividis", "Cividis: blue to yellow, the same to all eyes", TextureUsage::ramp, cividis},
    {"inferno", "Inferno: black to yellow", TextureUsage::ramp, inferno},
    {"blue-orange", "Blue to orange, white in the middle", TextureUsage::ramp, blue_orange},
    {"sky", "Sky and sun", TextureUsage::environment, sky},
    {"room", "Room with windows", TextureUsage::environment, room},
    {"six-colours", "Six colours, one for each side", TextureUsage::environment, six_colours},
};

void write(const Image& image, const std::filesystem::path& folder, const char* name) {
    write_png(image, folder / (std::string(name) + ".png"));
}

void write(const GreyImage& heights, const std::filesystem::path& folder, const char* name) {
    Image image{heights.width, heights.height, {}};
    for (const float value : heights.values) {
        const auto grey = static_cast<std::uint8_t>(std::lround(value * 255));
        image.rgba.insert(image.rgba.end(), {grey, grey, grey, 255});
    }
    write(image, folder, name);
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder, error))
        throw std::runtime_error("cannot make the folder " + folder.string() + ": " +
                                 (error ? error.message() : "a file of that name is in the way"));
}

void write(const Cube<Image>& cube, const std::filesystem::path& folder, const char* name) {
    make_folder(folder / name);
    for (std::size_t face = 0; face < cube.size(); ++face)
        write(cube[face], folder / name, cube_face_names[face]);
}

} // namespace

std::array<float, 3> cube_direction(int face, float s, float t) {
    switch (face) {
    case 0:
        return {1, -t, -s};
    case 1:
        return {-1, -t, s};
    case 2:
        return {s, 1, t};
    case 3:
        return {s, -1, -t};
    case 4:
        return {s, -t, 1};
    default:
        return {-s, -t, -1};
    }
}

const char* usage_name(TextureUsage usage) {
    static constexpr const char* names[] = {"colour", "height", "ramp", "environment"};
    return names[static_cast<std::size_t>(usage)];
}

std::span<const BuiltInTexture> built_in_textures() {
    return table;
}

const BuiltInTexture* find_built_in(std::string_view name) {
    const auto found = std::find_if(std::begin(table), std::end(table),
                                    [name](const BuiltInTexture& texture) { return name == texture.name; });
    return found == std::end(table) ? nullptr : found;
}

void write_built_in_textures(const std::filesystem::path& folder) {
    make_folder(folder);
    for (const BuiltInTexture& texture : table)
        std::visit([&](auto make) { write(make(), folder, texture.name); }, texture.make);
}

} // namespace clothlab::render
