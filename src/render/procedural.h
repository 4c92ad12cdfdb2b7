// The textures that clothlab brings along: made by code when they are first used, the same on every run. Needs no GL.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string_view>
#include <variant>

#include "render/image.h"
#include "render/options.h"

namespace clothlab::render {

/// The faces of a cube map in OpenGL's order +x, -x, +y, -y, +z, -z, each square and with its rows as OpenGL has them
/// (OpenGL 4.1 core, table 3.18): seen from inside the cube, right and left are exchanged, as in every such set of
/// pictures.
template <class Picture>
using Cube = std::array<Picture, 6>;

/// How the faces' files are named, in the same order.
inline constexpr std::array<const char*, 6> cube_face_names = {"posx", "negx", "posy", "negy", "posz", "negz"};

/// The direction from the cube's middle, not normalised, to a point of a face: s to the right and t down its picture,
/// both -1 to 1.
std::array<float, 3> cube_direction(int face, float s, float t);

/// "colour", "height", "ramp" or "environment".
const char* usage_name(TextureUsage usage);

struct BuiltInTexture {
    const char* name;  ///< as shaders and scenes write it
    const char* title; ///< for lists
    TextureUsage usage;
    /// Makes it: colours and ramps are an Image, height maps a GreyImage, environments a Cube.
    std::variant<Image (*)(), GreyImage (*)(), Cube<Image> (*)()> make;
};

/// All of them, by usage.
std::span<const BuiltInTexture> built_in_textures();
/// The one of this name, or none.
const BuiltInTexture* find_built_in(std::string_view name);

/// Writes every built-in texture into a folder, made where it is missing: NAME.png, and for an environment a folder
/// NAME with one PNG for each face. Throws std::runtime_error with path and reason.
void write_built_in_textures(const std::filesystem::path& folder);

} // namespace clothlab::render
