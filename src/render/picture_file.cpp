#include "render/picture_file.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>

// All of stb's reader is in this file, and private to it, so that another library's copy is no clash.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_FAILURE_USERMSG
#define STBI_NO_GIF
#define STBI_NO_PIC
#define STBI_NO_PNM
#define STBI_NO_PSD
#define STBI_NO_TGA // which takes almost any file
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace clothlab::render {

namespace {

struct FreePixels {
    void operator()(void* pixels) const { stbi_image_free(pixels); }
};
template <class Value>
using Pixels = std::unique_ptr<Value, FreePixels>;

const stbi_uc* first_byte(const std::string& bytes) {
    return reinterpret_cast<const stbi_uc*>(bytes.data());
}

int length(const std::string& bytes) {
    return static_cast<int>(bytes.size());
}

/// Where the compressed part of a JPEG file begins: after the first start-of-scan marker (ITU T.81, annex B); the
/// file's size when there is none.
std::size_t first_scan(const std::string& bytes) {
    const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i])); };
    std::size_t at = 2; // after the start-of-image marker
    while (at + 4 <= bytes.size() && byte(at) == 0xFF && byte(at + 1) != 0xDA)
        at += 2 + 256 * byte(at + 2) + byte(at + 3);
    return std::min(at, bytes.size());
}

std::array<float, 256> make_linear_table() {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = linear_from_srgb(static_cast<float>(i) / 255);
    return table;
}

} // namespace

void PictureFile::fail(const std::string& why) const {
    throw std::runtime_error("cannot read the picture " + path_.string() + ": " + why);
}

PictureFile::PictureFile(const std::filesystem::path& path) : path_(path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
        fail("it is a folder");
    if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
        fail("it is not a regular file"); // a pipe would be waited for
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file)
        fail(errno == 0 ? "unknown error" : std::strerror(errno));
    if (std::filesystem::file_size(path, error) > std::numeric_limits<int>::max())
        fail("it is larger than 2 GB");
    bytes_.assign(std::istreambuf_iterator<char>(file), {});
    if (bytes_.empty())
        fail("it is empty");
    int channels = 0;
    if (stbi_info_from_memory(first_byte(bytes_), length(bytes_), &width_, &height_, &channels) == 0)
        fail("it is damaged, or no PNG, JPEG, BMP or HDR picture");
    if (width_ < 1 || height_ < 1)
        fail("it has no pixels");
    high_range_ = stbi_is_hdr_from_memory(first_byte(bytes_), length(bytes_)) != 0;
    check_end();
}

/// stb fills in what a file that was cut short has lost, where the format lets it.
void PictureFile::check_end() const {
    if (bytes_.compare(0, 2, "\xFF\xD8") == 0 && bytes_.find("\xFF\xD9", first_scan(bytes_)) == std::string::npos)
        fail("it is cut short");
    // Lines of HDR pictures so narrow or so wide are not compressed: four bytes a pixel, after an empty line and one
    // with the size.
    if (high_range_ && (width_ < 8 || width_ >= 32768)) {
        const std::size_t begin = bytes_.find('\n', bytes_.find("\n\n") + 2) + 1;
        if (bytes_.size() - begin < 4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_))
            fail("it is cut short");
    }
}

Image PictureFile::rgba8() const {
    int width = 0, height = 0, channels = 0;
    const Pixels<stbi_uc> pixels(
        stbi_load_from_memory(first_byte(bytes_), length(bytes_), &width, &height, &channels, 4));
    if (!pixels)
        fail(stbi_failure_reason());
    Image image{width, height, {}};
    image.rgba.assign(pixels.get(),
                      pixels.get() + static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
    return image;
}

FloatImage PictureFile::linear() const {
    FloatImage image;
    if (!high_range_) {
        static const std::array<float, 256> table = make_linear_table();
        const Image eight = rgba8();
        image = {eight.width, eight.height, {}};
        image.rgb.reserve(eight.rgba.size() / 4 * 3);
        for (std::size_t i = 0; i < eight.rgba.size(); i += 4)
            for (std::size_t k = 0; k < 3; ++k)
                image.rgb.push_back(table[eight.rgba[i + k]]);
        return image;
    }
    int channels = 0;
    const Pixels<float> pixels(
        stbi_loadf_from_memory(first_byte(bytes_), length(bytes_), &image.width, &image.height, &channels, 3));
    if (!pixels)
        fail(stbi_failure_reason());
    image.rgb.assign(pixels.get(),
                     pixels.get() + static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
    return image;
}

GreyImage PictureFile::grey() const {
    GreyImage image;
    if (high_range_) {
        const FloatImage colours = linear();
        image = {colours.width, colours.height, {}};
        image.values.reserve(colours.rgb.size() / 3);
        for (std::size_t i = 0; i < colours.rgb.size(); i += 3) // Rec. 709
            image.values.push_back(0.2126f * colours.rgb[i] + 0.7152f * colours.rgb[i + 1] +
                                   0.0722f * colours.rgb[i + 2]);
        return image;
    }
    int channels = 0;
    const Pixels<stbi_us> pixels(
        stbi_load_16_from_memory(first_byte(bytes_), length(bytes_), &image.width, &image.height, &channels, 1));
    if (!pixels)
        fail(stbi_failure_reason());
    const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    image.values.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        image.values.push_back(static_cast<float>(pixels.get()[i]) / 65535);
    return image;
}

} // namespace clothlab::render
