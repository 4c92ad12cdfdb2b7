// Pictures in memory: what the renderer reads back, the command line writes as PNG and the tests compare. Needs no GL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace clothlab::render {

/// 8 bits per channel, sRGB, red green blue alpha, the top row first.
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;

    /// The four channels of a pixel; x from the left, y from the top, both inside the picture.
    const std::uint8_t* pixel(int x, int y) const {
        return rgba.data() +
               4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    }
    bool operator==(const Image&) const = default;
};

/// Linear values, 0 and up, red green blue, the top row first.
struct FloatImage {
    int width = 0, height = 0;
    std::vector<float> rgb;
    const float* pixel(int x, int y) const {
        return rgb.data() +
               3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    }
};

/// One linear value for each pixel, the top row first: a height map, mostly 0 to 1.
struct GreyImage {
    int width = 0, height = 0;
    std::vector<float> values;
    float pixel(int x, int y) const {
        return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
    bool operator==(const GreyImage&) const = default;
};

/// sRGB, 0 to 1, to linear values (IEC 61966-2-1), and back.
float linear_from_srgb(float srgb);
float srgb_from_linear(float linear);

/// Writes a PNG, whole or not at all. Throws std::runtime_error with the path and the reason when it cannot be written.
void write_png(const Image& image, const std::filesystem::path& path);

/// Reads a PNG (or another format that PictureFile knows). Throws std::runtime_error with the path and the reason.
Image read_png(const std::filesystem::path& path);

/// The picture that looks like `over_black` on black and like `over_white` on white, by its alpha: what is not drawn
/// has alpha 0, and at an edge that covers part of a pixel the colour is the edge's own, with no dark rim. Both of one
/// size, or std::runtime_error is thrown.
Image transparent(const Image& over_black, const Image& over_white);

/// How different two pictures look, 0 (the same) to 1 (black and white): both are averaged down to 64 x 36 cells, and
/// the absolute differences of red, green and blue averaged. Sizes may differ; an empty picture is black.
double difference(const Image& a, const Image& b);

} // namespace clothlab::render
