// Words in pictures: TrueType text drawn into an Image, and the strip below a picture that says what it shows. Needs no
// GL.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/image.h"

namespace clothlab::render {

/// An 8-bit sRGB colour.
using Rgb = std::array<std::uint8_t, 3>;

/// A typeface that is drawn in any size. Sizes are the height of a line in px, from the highest to the lowest letter.
class Typeface {
public:
    /// Reads a TrueType file. Throws std::runtime_error with its path and the reason.
    explicit Typeface(const std::filesystem::path& file);
    ~Typeface();
    Typeface(Typeface&&) noexcept;
    Typeface& operator=(Typeface&&) noexcept;

    /// The width of a line of UTF-8 text in px.
    double width(std::string_view text, double size) const;
    /// Draws a line from `x` to the right with its upper edge at `top`; what does not fit into the picture is cut off.
    void draw(Image& image, double x, double top, std::string_view text, double size, Rgb colour) const;
    /// The text in lines of at most `most` px, broken at spaces; a word that is longer has a line of its own.
    std::vector<std::string> wrapped(std::string_view text, double size, double most) const;

private:
    struct Outlines;
    std::unique_ptr<Outlines> outlines_;
};

struct LabelLine {
    std::string text;
    Rgb colour{0xB6, 0xBE, 0xC8};
};

/// What the colours of a picture mean: a bar of them between what its ends stand for.
struct LabelScale {
    std::string low, high;
    std::vector<std::array<float, 3>> colours; ///< sRGB, 0 to 1, from low to high
};

/// What a strip says: a title, and lines below it that are wrapped where they are longer than the picture; a scale
/// stands between the two.
struct Label {
    std::string title;
    std::vector<LabelLine> lines;
    std::optional<LabelScale> scale;
};

struct LabelFaces {
    Typeface regular, bold;
};

/// The picture with a strip below it, as high as the label needs. The title is in bold letters of `size` px, the lines
/// in smaller regular ones.
Image labelled(const Image& picture, const Label& label, const LabelFaces& faces, double size);

} // namespace clothlab::render
