// Picture files as the user has them. Needs no GL.
#pragma once

#include <filesystem>
#include <string>

#include "render/image.h"

namespace clothlab::render {

/// A picture file in memory, PNG, JPEG, BMP or Radiance HDR: its size is known before it is decoded. Everything throws
/// std::runtime_error with the path and the reason.
class PictureFile {
public:
    /// Reads the file, and of its content the header.
    explicit PictureFile(const std::filesystem::path& path);
    int width() const { return width_; }
    int height() const { return height_; }
    /// Whether it is Radiance HDR: linear values without an upper end.
    bool high_range() const { return high_range_; }

    /// As sRGB; a file of high range is cut off at 1.
    Image rgba8() const;
    /// As linear values; those of an 8-bit file are decoded from sRGB.
    FloatImage linear() const;
    /// The luma of the stored values, which are taken for linear as in all height maps, with 16 bits where the file has
    /// them. 0 to 1, or without an upper end for a file of high range.
    GreyImage grey() const;

private:
    [[noreturn]] void fail(const std::string& why) const;
    void check_end() const;
    std::filesystem::path path_;
    std::string bytes_;
    int width_ = 0, height_ = 0;
    bool high_range_ = false;
};

} // namespace clothlab::render
