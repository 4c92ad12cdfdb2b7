// What the texture tests share: picture files made by hand, and messages of errors.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "render/image.h"
#include "support/files.h"

namespace clothlab::test {

/// The message of what an action throws; empty when it does not.
template <class Action>
std::string error_of(Action action) {
    try {
        action();
    } catch (const std::exception& error) {
        return error.what();
    }
    return {};
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

inline render::Image plain_picture(int width, int height, std::array<std::uint8_t, 3> colour) {
    render::Image image{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(4 * width * height), 255)};
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
        std::copy(colour.begin(), colour.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(i));
    return image;
}

/// A Radiance HDR file of pixels that are not compressed, so narrower than 8: red green blue, the top row first.
inline std::string hdr_file(int width, int height, const std::vector<std::array<float, 3>>& pixels) {
    std::string bytes =
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
    for (const auto& pixel : pixels) {
        int exponent = 0;
        const float largest = std::max({pixel[0], pixel[1], pixel[2]});
        std::frexp(largest, &exponent);
        for (const float value : pixel)
            bytes += static_cast<char>(std::lround(std::ldexp(value, 8 - exponent)));
        bytes += static_cast<char>(exponent + 128);
    }
    return bytes;
}

/// A grey PNG of 16 bits and a few pixels, without checksums, which our reader does not look at.
inline std::string png_of_16_bits(int width, const std::vector<std::uint16_t>& pixels) {
    const auto big = [](std::size_t value) {
        std::string s;
        for (int shift = 24; shift >= 0; shift -= 8)
            s += static_cast<char>(value >> shift & 255u);
        return s;
    };
    const auto chunk = [&](const std::string& type, const std::string& data) {
        return big(data.size()) + type + data + big(0);
    };
    const std::size_t columns = static_cast<std::size_t>(width), rows = pixels.size() / columns;
    std::string raw;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (i % columns == 0)
            raw += '\0'; // no filter
        raw += {static_cast<char>(pixels[i] >> 8), static_cast<char>(pixels[i] & 255)};
    }
    // One stored block of a zlib stream (RFC 1950, 1951).
    const auto low = static_cast<char>(raw.size() & 255u), high = static_cast<char>(raw.size() >> 8);
    const std::string stream =
        std::string("\x78\x01\x01") + low + high + static_cast<char>(~low) + static_cast<char>(~high) + raw + big(0);
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", big(columns) + big(rows) + std::string("\x10\0\0\0\0", 5)) +
           chunk("IDAT", stream) + chunk("IEND", "");
}

/// Writes the six faces of a cube as PNG files.
inline void write_faces(const std::filesystem::path& folder, const std::array<render::Image, 6>& faces) {
    static constexpr const char* names[] = {"posx", "negx", "posy", "negy", "posz", "negz"};
    std::filesystem::create_directories(folder);
    for (std::size_t face = 0; face < 6; ++face)
        render::write_png(faces[face], folder / (std::string(names[face]) + ".png"));
}

/// Faces of 2 x 2 pixels, all 24 of them different: the face is in red, the column in green, the row in blue.
inline std::array<render::Image, 6> marked_faces() {
    std::array<render::Image, 6> faces;
    for (std::size_t face = 0; face < 6; ++face) {
        const auto red = static_cast<std::uint8_t>(40 * face + 20);
        faces[face] = {2, 2, {red, 60, 50, 255, red, 220, 50, 255, red, 60, 200, 255, red, 220, 200, 255}};
    }
    return faces;
}

} // namespace clothlab::test
