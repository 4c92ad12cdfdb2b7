#include "render/label.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_truetype.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace clothlab::render {
namespace {

constexpr Rgb strip_colour{0x14, 0x17, 0x1B}, title_colour{0xF2, 0xF4, 0xF7};

/// The code points of UTF-8 text; a byte that is none begins a replacement character.
std::vector<int> code_points(std::string_view text) {
    std::vector<int> result;
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const std::size_t length = byte < 0x80 ? 1 : byte >= 0xF0 ? 4 : byte >= 0xE0 ? 3 : byte >= 0xC0 ? 2 : 0;
        if (length == 0 || i + length > text.size()) {
            result.push_back(0xFFFD);
            ++i;
            continue;
        }
        int code = length == 1 ? byte : byte & (0xFF >> (length + 1));
        for (std::size_t k = 1; k < length; ++k)
            code = code << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3F);
        result.push_back(code);
        i += length;
    }
    return result;
}

/// Blends a letter's coverage over the picture. In encoded values: light letters on a dark strip look as thick as they
/// should.
void blend(Image& image, int left, int top, int width, int height, const unsigned char* coverage, Rgb colour) {
    for (int y = std::max(0, -top); y < height && top + y < image.height; ++y)
        for (int x = std::max(0, -left); x < width && left + x < image.width; ++x) {
            const int share = coverage[y * width + x];
            const std::size_t at = 4 * (static_cast<std::size_t>(top + y) * static_cast<std::size_t>(image.width) +
                                        static_cast<std::size_t>(left + x));
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint8_t& channel = image.rgba[at + k];
                channel = static_cast<std::uint8_t>((channel * (255 - share) + colour[k] * share + 127) / 255);
            }
        }
}

void fill(Image& image, int x, int top, int height, const std::array<float, 3>& colour) {
    for (int y = top; y < top + height; ++y)
        for (std::size_t k = 0; k < 3; ++k)
            image.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                            static_cast<std::size_t>(x)) +
                       k] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(colour[k], 0.f, 1.f)));
}

/// Draws a scale from `x` on: what its low end stands for, half the picture's width of colours, its high end.
void draw_scale(Image& image, double x, double top, const LabelScale& scale, const Typeface& face, double size) {
    face.draw(image, x, top, scale.low, size, title_colour);
    const int begin = static_cast<int>(x + face.width(scale.low, size) + 0.5 * size);
    const int end = std::min(image.width, begin + image.width / 2);
    for (int at = begin; at < end && !scale.colours.empty(); ++at) {
        const std::size_t n = scale.colours.size();
        fill(image, at, static_cast<int>(top + 0.15 * size), static_cast<int>(0.8 * size),
             scale.colours[static_cast<std::size_t>(at - begin) * n / static_cast<std::size_t>(end - begin)]);
    }
    face.draw(image, end + 0.5 * size, top, scale.high, size, title_colour);
}

} // namespace

struct Typeface::Outlines {
    std::string bytes;
    stbtt_fontinfo font{};
    float scale(double size) const { return stbtt_ScaleForPixelHeight(&font, static_cast<float>(size)); }
    /// Calls visit(code point, x in px) for every letter, and returns where the line ends.
    template <class Visit>
    double for_each_letter(std::string_view text, double size, Visit visit) const {
        const double s = static_cast<double>(scale(size));
        double x = 0;
        int before = 0;
        for (const int code : code_points(text)) {
            if (before != 0)
                x += s * stbtt_GetCodepointKernAdvance(&font, before, code);
            visit(code, x);
            int advance = 0;
            stbtt_GetCodepointHMetrics(&font, code, &advance, nullptr);
            x += s * advance;
            before = code;
        }
        return x;
    }
};

Typeface::Typeface(const std::filesystem::path& file) : outlines_(std::make_unique<Outlines>()) {
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw std::runtime_error("cannot read the font " + file.string() + ": " + std::strerror(errno));
    outlines_->bytes.assign(std::istreambuf_iterator<char>(in), {});
    const auto* bytes = reinterpret_cast<const unsigned char*>(outlines_->bytes.data());
    // stb_truetype reads tables without looking where the file ends; a file too short for a header is none to begin
    // with.
    const int offset = outlines_->bytes.size() > 1024 ? stbtt_GetFontOffsetForIndex(bytes, 0) : -1;
    if (offset < 0 || stbtt_InitFont(&outlines_->font, bytes, offset) == 0)
        throw std::runtime_error("cannot read the font " + file.string() + ": it is no TrueType font");
}

Typeface::~Typeface() = default;
Typeface::Typeface(Typeface&&) noexcept = default;
Typeface& Typeface::operator=(Typeface&&) noexcept = default;

double Typeface::width(std::string_view text, double size) const {
    return outlines_->for_each_letter(text, size, [](int, double) {});
}

void Typeface::draw(Image& image, double x, double top, std::string_view text, double size, Rgb colour) const {
    const stbtt_fontinfo* font = &outlines_->font;
    const float scale = outlines_->scale(size);
    int ascent = 0;
    stbtt_GetFontVMetrics(font, &ascent, nullptr, nullptr);
    const int baseline = static_cast<int>(std::lround(top + static_cast<double>(scale) * ascent));
    std::vector<unsigned char> coverage;
    outlines_->for_each_letter(text, size, [&](int code, double offset) {
        const double at = x + offset, pixel = std::floor(at);
        const auto shift = static_cast<float>(at - pixel);
        int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
        stbtt_GetCodepointBitmapBoxSubpixel(font, code, scale, scale, shift, 0, &x0, &y0, &x1, &y1);
        if (x1 <= x0 || y1 <= y0)
            return;
        coverage.assign(static_cast<std::size_t>(x1 - x0) * static_cast<std::size_t>(y1 - y0), 0);
        stbtt_MakeCodepointBitmapSubpixel(font, coverage.data(), x1 - x0, y1 - y0, x1 - x0, scale, scale, shift, 0,
                                          code);
        blend(image, static_cast<int>(pixel) + x0, baseline + y0, x1 - x0, y1 - y0, coverage.data(), colour);
    });
}

std::vector<std::string> Typeface::wrapped(std::string_view text, double size, double most) const {
    std::vector<std::string> lines;
    std::string line;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const std::string word(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::string longer = line.empty() ? word : line + " " + word;
        if (!line.empty() && width(longer, size) > most) {
            lines.push_back(line);
            line = word;
        } else {
            line = longer;
        }
    }
    if (!line.empty())
        lines.push_back(line);
    return lines;
}

Image labelled(const Image& picture, const Label& label, const LabelFaces& faces, double size) {
    struct Row {
        const Typeface* face;
        std::string text;
        double size;
        Rgb colour;
    };
    const double margin = 0.6 * size, most = picture.width - 2 * margin;
    std::vector<Row> rows;
    const auto add = [&](const Typeface& face, const std::string& text, double letters, Rgb colour) {
        for (std::string& line : face.wrapped(text, letters, most))
            rows.push_back({&face, std::move(line), letters, colour});
    };
    add(faces.bold, label.title, size, title_colour);
    for (const LabelLine& line : label.lines)
        add(faces.regular, line.text, 0.8 * size, line.colour);
    const double scale_height = label.scale ? 1.15 * size : 0;
    double height = 2 * 0.4 * size + scale_height;
    for (const Row& row : rows)
        height += 1.18 * row.size;

    Image image{picture.width, picture.height + static_cast<int>(std::lround(height)), picture.rgba};
    image.rgba.reserve(4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    for (std::size_t left =
             static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height - picture.height);
         left > 0; --left)
        image.rgba.insert(image.rgba.end(), {strip_colour[0], strip_colour[1], strip_colour[2], 255});
    double top = picture.height + 0.4 * size;
    bool scale_due = label.scale.has_value();
    for (const Row& row : rows) {
        if (scale_due && row.face == &faces.regular) {
            draw_scale(image, margin, top, *label.scale, faces.regular, 0.8 * size);
            top += scale_height;
            scale_due = false;
        }
        row.face->draw(image, margin, top, row.text, row.size, row.colour);
        top += 1.18 * row.size;
    }
    if (scale_due)
        draw_scale(image, margin, top, *label.scale, faces.regular, 0.8 * size);
    return image;
}

} // namespace clothlab::render
