// How a scene is to be drawn. Plain data; colours are sRGB, 0 to 1, unless said otherwise.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "sim/grid.h"

namespace clothlab::render {

/// An sRGB colour from 0xRRGGBB.
constexpr glm::vec3 colour(unsigned rgb) {
    return {static_cast<float>(rgb >> 16 & 255u) / 255.f, static_cast<float>(rgb >> 8 & 255u) / 255.f,
            static_cast<float>(rgb & 255u) / 255.f};
}

/// sRGB to linear values (IEC 61966-2-1).
glm::vec3 linear(const glm::vec3& srgb);

/// Colours of structural, shear and bending springs, for lines and legends: three of Okabe and Ito's palette, which
/// colour-blind people tell apart.
inline constexpr std::array<glm::vec3, sim::spring_kinds> spring_colours = {colour(0x56B4E9), colour(0xE69F00),
                                                                            colour(0xCC79A7)};
inline constexpr glm::vec3 pin_colour = colour(0xFFFFFF);
inline constexpr glm::vec3 ghost_colour = colour(0xB48CFF);

/// A point light: the light that arrives at distance r is intensity / r².
struct Light {
    glm::vec3 position{1.9f, 3.2f, 2.6f}; ///< m
    float intensity = 0;                  ///< at 1 m, in the unit in which 1 lights a white surface fully; 0: off
    bool operator==(const Light&) const = default;
};

/// How a shader reads a picture: see TextureLibrary.
enum class TextureUsage : std::uint8_t { colour, height, ramp, environment };
struct TextureName {
    std::string name; ///< of a built-in texture, or a path
    TextureUsage usage = TextureUsage::colour;
    bool operator==(const TextureName&) const = default;
};

/// A value for one of the surface shader's own uniforms; a vec3 is set as it is.
struct Uniform {
    std::string name;
    std::variant<float, int, bool, glm::vec3, TextureName> value;
    bool operator==(const Uniform&) const = default;
};

/// How cloth, and spheres with the cloth's shader, are drawn.
struct Surface {
    std::string shader = "diffuse"; ///< one of list_surface_shaders()
    bool lines = false;             ///< the shader draws springs, not triangles
    bool translucent = false;       ///< drawn last, from the back to the front, and blended
    bool second_quantity = false;   ///< the attribute `quantity` is the snapshot's second one
    std::vector<Uniform> uniforms;  ///< all that the shader declares
    int sphere_lat_lines = 40;      ///< 3 and up
    int sphere_lon_lines = 40;      ///< 3 and up
    bool operator==(const Surface&) const = default;
};

struct Options {
    Surface surface;
    /// By SpringKind. A shader of lines draws these alone; other shaders only with springs_over_surface.
    std::array<bool, sim::spring_kinds> show_springs = {true, true, true};
    bool springs_over_surface = false; ///< the surface is then drawn darker
    bool show_pins = true;
    bool show_colliders = true;
    bool ground_grid = false;        ///< at y = 0
    bool spheres_like_cloth = false; ///< with the surface's shader
    bool swap_sides = false;         ///< the front is the side that looks up when the cloth is horizontal (-z when it
                                     ///< is vertical); swapped, shaders take the other for it
    glm::vec3 sphere_colour = colour(0xB4B8BD);
    glm::vec3 background_top = colour(0x1D2126);
    glm::vec3 background_bottom = colour(0x2F363E);
    std::array<Light, 2> lights{Light{{1.9f, 3.2f, 2.6f}, 9.5f}, Light{}};
    float ambient = 0.16f;   ///< light from everywhere; 1 lights a white surface fully
    float fill = 0.36f;      ///< light from over the beholder's left shoulder, in the same unit
    bool shadow = false;     ///< of the first light
    float line_width = 1.5f; ///< px; drawn thinner where the cells of the cloth are only a few pixels wide
    float pin_size = 11;     ///< px
    bool operator==(const Options&) const = default;
};

} // namespace clothlab::render
