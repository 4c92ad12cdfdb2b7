// Charts as pictures: with any OpenGL context that is current, whether there is a window or not.
#pragma once

#include "experiments/chart.h"
#include "render/image.h"

namespace clothlab::app {

/// Draws a chart as the panels do, with text of the size of a page's, in an ImGui of its own. Leaves the present one
/// as it is. Throws std::runtime_error when the driver cannot draw pictures of that size.
render::Image chart_picture(const experiments::Chart& chart, int width, int height);

} // namespace clothlab::app
