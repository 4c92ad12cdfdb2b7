// Colour maps for heat maps that colour-blind people can read too, from published tables. Needs no GL.
#pragma once

#include "render/image.h"

namespace clothlab::render {

// Each is 256 x 1 pixels, the low end on the left.
Image viridis();
Image cividis();
Image inferno();
/// Diverging: blue below, almost white in the middle, orange above.
Image blue_orange();

} // namespace clothlab::render
