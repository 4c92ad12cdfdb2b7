// How a scene is to be drawn: what the UI offers and scene files keep. Plain data; colours are sRGB, 0 to 1.
#pragma once

#include <array>
#include <string>

#include <glm/glm.hpp>

#include "sim/grid.h"

namespace clothlab::render {

/// An sRGB colour from 0xRRGGBB.
constexpr glm::vec3 colour(unsigned rgb) {
    return {static_cast<float>(rgb >> 16 & 255u) / 255.f, static_cast<float>(rgb >> 8 & 255u) / 255.f,
            static_cast<float>(rgb & 255u) / 255.f};
}

/// Colours of structural, shear and bending springs, for lines and legends: three of Okabe and Ito's palette, which
/// colour-blind people tell apart.
inline constexpr std::array<glm::vec3, sim::spring_kinds> spring_colours = {colour(0x56B4E9), colour(0xE69F00),
                                                                            colour(0xCC79A7)};
inline constexpr glm::vec3 pin_colour = colour(0xFFFFFF);

/// A point light: the light that arrives at distance r is intensity / r².
struct Light {
    glm::vec3 position{1.9f, 3.2f, 2.6f}; ///< m
    float intensity = 9.5f;               ///< at 1 m, in the unit in which 1 lights a white surface fully
    bool operator==(const Light&) const = default;
};

struct Options {
    std::string shader = "diffuse"; ///< one of list_surface_shaders()
    /// By SpringKind. The wireframe draws these lines alone; other shaders only with springs_over_surface.
    std::array<bool, sim::spring_kinds> show_springs = {true, true, true};
    bool springs_over_surface = false; ///< the surface is then drawn darker
    bool show_pins = true;
    bool show_colliders = true;
    bool swap_sides = false; ///< front and back colour the other way round, see below
    /// The front is the side that looks up when the cloth is horizontal (-z when it is vertical).
    glm::vec3 cloth_colour = colour(0xE0714F);
    glm::vec3 back_colour = colour(0x9AA5B1);
    glm::vec3 sphere_colour = colour(0xB4B8BD);
    glm::vec3 background_top = colour(0x1D2126);
    glm::vec3 background_bottom = colour(0x2F363E);
    Light light;
    float ambient = 0.16f;     ///< light from everywhere; 1 lights a white surface fully
    float fill = 0.36f;        ///< light from over the beholder's left shoulder, in the same unit
    int sphere_lat_lines = 40; ///< 3 and up
    int sphere_lon_lines = 40; ///< 3 and up
    float line_width = 1.5f;   ///< px; drawn thinner where the cells of the cloth are only a few pixels wide
    float pin_size = 11;       ///< px
    bool operator==(const Options&) const = default;
};

} // namespace clothlab::render
