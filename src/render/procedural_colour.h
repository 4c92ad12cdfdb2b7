// Colours while a texture is being made. Needs no GL.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "render/image.h"

namespace clothlab::render {

inline void append(Image& image, const glm::vec3& srgb) {
    for (int k = 0; k < 3; ++k)
        image.rgba.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(srgb[k], 0.f, 1.f) * 255)));
    image.rgba.push_back(255);
}

/// A square picture from a function of u and v, 0 to 1 from the left and the top, at the middle of every pixel; it
/// returns an sRGB colour.
template <class Colour>
Image paint(int size, Colour colour_at) {
    Image image{size, size, {}};
    image.rgba.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 4);
    const float step = 1 / static_cast<float>(size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            append(image, colour_at((static_cast<float>(x) + 0.5f) * step, (static_cast<float>(y) + 0.5f) * step));
    return image;
}

/// The same for heights, cut off at 0 and 1.
template <class Height>
GreyImage model(int size, Height height_at) {
    GreyImage image{size, size, {}};
    image.values.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    const float step = 1 / static_cast<float>(size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            image.values.push_back(std::clamp(
                height_at((static_cast<float>(x) + 0.5f) * step, (static_cast<float>(y) + 0.5f) * step), 0.f, 1.f));
    return image;
}

} // namespace clothlab::render
