#include "render/image.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>

// All of stb's writer is in this file, and private to it, so that another library's copy is no clash.
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#include "render/picture_file.h"

namespace clothlab::render {

namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& path, const std::string& why) {
    throw std::runtime_error(std::string(what) + " " + path.string() + ": " + why);
}

std::string last_error() {
    return errno == 0 ? "unknown error" : std::strerror(errno);
}

constexpr int cells_x = 64, cells_y = 36;
using Cells = std::array<double, cells_x * cells_y * 3>;

/// The part of [i, i+1) that lies in cell c of n cells over size pixels, in pixels.
double overlap(int i, int c, int n, int size) {
    const double scale = static_cast<double>(size) / n;
    return std::max(0.0, std::min<double>(i + 1, (c + 1) * scale) - std::max<double>(i, c * scale));
}

/// Each cell is the mean of the pixels under it, those on its edge in part.
Cells averaged(const Image& image) {
    Cells cells{};
    if (image.width <= 0 || image.height <= 0)
        return cells;
    const double area = static_cast<double>(image.width) / cells_x * image.height / cells_y * 255;
    const auto range = [](int c, int n, int size) {
        const auto first = static_cast<int>(static_cast<long long>(c) * size / n);
        const auto last = static_cast<int>((static_cast<long long>(c + 1) * size + n - 1) / n);
        return std::pair(first, std::min(last, size));
    };
    for (int cy = 0; cy < cells_y; ++cy) {
        const auto [y0, y1] = range(cy, cells_y, image.height);
        for (int cx = 0; cx < cells_x; ++cx) {
            const auto [x0, x1] = range(cx, cells_x, image.width);
            double* cell = &cells[static_cast<std::size_t>(cy * cells_x + cx) * 3];
            for (int y = y0; y < y1; ++y) {
                const double wy = overlap(y, cy, cells_y, image.height);
                for (int x = x0; x < x1; ++x) {
                    const double weight = wy * overlap(x, cx, cells_x, image.width) / area;
                    const std::uint8_t* p = image.pixel(x, y);
                    for (int k = 0; k < 3; ++k)
                        cell[k] += weight * p[k];
                }
            }
        }
    }
    return cells;
}

} // namespace

void write_png(const Image& image, const std::filesystem::path& path) {
    const char* what = "cannot write the picture";
    if (image.width <= 0 || image.height <= 0)
        fail(what, path, "it is empty");
    std::string bytes;
    const auto append = [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
    };
    if (stbi_write_png_to_func(append, &bytes, image.width, image.height, 4, image.rgba.data(), 4 * image.width) == 0)
        fail(what, path, "it cannot be encoded");
    errno = 0;
    std::ofstream file(path, std::ios::binary);
    if (!file)
        fail(what, path, last_error());
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) {
        const std::string why = last_error();
        std::error_code ignored;
        if (std::filesystem::is_regular_file(path, ignored))
            std::filesystem::remove(path, ignored);
        fail(what, path, why);
    }
}

Image read_png(const std::filesystem::path& path) {
    return PictureFile(path).rgba8();
}

float linear_from_srgb(float srgb) {
    return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

float srgb_from_linear(float linear) {
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

Image transparent(const Image& over_black, const Image& over_white) {
    if (over_black.width != over_white.width || over_black.height != over_white.height)
        throw std::runtime_error("the pictures over black and over white are not of one size");
    Image image = over_black;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        // What a background adds is what shines through. Where the channels do not agree, as with colours that were
        // blended in linear values, the least: no colour then has to be brighter than white.
        int through = 255;
        for (std::size_t k = i; k < i + 3; ++k)
            through = std::min(through, std::max(0, over_white.rgba[k] - over_black.rgba[k]));
        const int alpha = 255 - through;
        image.rgba[i + 3] = static_cast<std::uint8_t>(alpha);
        for (std::size_t k = i; k < i + 3 && alpha > 0; ++k)
            image.rgba[k] = static_cast<std::uint8_t>(std::min(255, (255 * over_black.rgba[k] + alpha / 2) / alpha));
    }
    return image;
}

double difference(const Image& a, const Image& b) {
    const Cells cells_a = averaged(a), cells_b = averaged(b);
    double sum = 0;
    for (std::size_t i = 0; i < cells_a.size(); ++i)
        sum += std::abs(cells_a[i] - cells_b[i]);
    return sum / static_cast<double>(cells_a.size());
}

} // namespace clothlab::render
