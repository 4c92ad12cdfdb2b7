// What a texture is for. Needs no GL.
#pragma once

namespace clothlab::render {

/// What a texture is for decides its format, its edges and its filters (see TextureLibrary).
enum class TextureUsage {
    colour,     ///< a picture over the surface: sRGB, repeated
    height,     ///< a height map: linear, one channel, repeated
    ramp,       ///< a colour map or a toon ramp, left to right: sRGB, clamped
    environment ///< the surroundings, as a cube map
};

/// "colour", "height", "ramp" or "environment".
constexpr const char* usage_name(TextureUsage usage) {
    constexpr const char* names[] = {"colour", "height", "ramp", "environment"};
    return names[static_cast<int>(usage)];
}

} // namespace clothlab::render
