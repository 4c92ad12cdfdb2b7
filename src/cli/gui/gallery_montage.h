// Many pictures in one: the gallery at a glance.
#pragma once

#include <vector>

#include "render/image.h"
#include "render/label.h"

namespace clothlab::cli {

/// Of words that say what went wrong in a run.
inline constexpr render::Rgb trouble_colour{0xF5, 0xA9, 0x7F};

/// A picture of nothing but the ground that pictures are put on.
render::Image plain_ground(int width, int height);

/// A smaller copy; every pixel is the mean, of light, of those it covers.
render::Image shrunk(const render::Image& image, int width, int height);

/// The pictures, all of one width, row by row on a plain ground; the number of columns makes the whole about 3:2. An
/// empty picture where there are none.
render::Image montage(const std::vector<render::Image>& pictures, int gap);

} // namespace clothlab::cli
