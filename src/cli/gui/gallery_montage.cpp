#include "cli/gui/gallery_montage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace clothlab::cli {
namespace {

constexpr std::array<std::uint8_t, 4> ground{0x0C, 0x0E, 0x11, 0xFF};

/// Light of an sRGB value (IEC 61966-2-1), 0 to 1.
const std::array<float, 256>& light_of() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> t{};
        for (std::size_t i = 0; i < t.size(); ++i) {
            const double v = static_cast<double>(i) / 255;
            t[i] = static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
        }
        return t;
    }();
    return table;
}

std::uint8_t srgb_of(double light) {
    const double v = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0, 1.0)));
}

} // namespace

render::Image plain_ground(int width, int height) {
    render::Image image{width, height, {}};
    image.rgba.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        image.rgba[i] = ground[i % 4];
    return image;
}

render::Image shrunk(const render::Image& image, int width, int height) {
    render::Image small{width, height, {}};
    small.rgba.reserve(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const auto& light = light_of();
    for (int y = 0; y < height; ++y) {
        const int y0 = y * image.height / height, y1 = std::max(y0 + 1, (y + 1) * image.height / height);
        for (int x = 0; x < width; ++x) {
            const int x0 = x * image.width / width, x1 = std::max(x0 + 1, (x + 1) * image.width / width);
            std::array<double, 3> sum{};
            for (int j = y0; j < y1; ++j)
                for (int i = x0; i < x1; ++i)
                    for (std::size_t k = 0; k < 3; ++k)
                        sum[k] += static_cast<double>(light[image.pixel(i, j)[k]]);
            for (const double s : sum)
                small.rgba.push_back(srgb_of(s / ((y1 - y0) * (x1 - x0))));
            small.rgba.push_back(255);
        }
    }
    return small;
}

render::Image montage(const std::vector<render::Image>& pictures, int gap) {
    if (pictures.empty())
        return {};
    const int width = pictures.front().width + gap;
    int height = 0;
    for (const render::Image& p : pictures)
        height = std::max(height, p.height + gap);
    const auto count = static_cast<int>(pictures.size());
    const int columns = std::clamp(static_cast<int>(std::lround(std::sqrt(1.5 * count * height / width))), 1, count);
    const int rows = (count + columns - 1) / columns;
    render::Image whole = plain_ground(columns * width + gap, rows * height + gap);
    for (int n = 0; n < count; ++n) {
        const render::Image& p = pictures[static_cast<std::size_t>(n)];
        for (int y = 0; y < p.height; ++y) {
            const std::size_t at =
                static_cast<std::size_t>(n / columns * height + gap + y) * static_cast<std::size_t>(whole.width) +
                static_cast<std::size_t>(n % columns * width + gap);
            std::memcpy(&whole.rgba[4 * at], p.pixel(0, y), 4 * static_cast<std::size_t>(p.width));
        }
    }
    return whole;
}

} // namespace clothlab::cli
