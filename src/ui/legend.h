// What the colours in the picture mean.
#pragma once

#include <imgui.h>

#include "ui/lab.h"

namespace clothlab::ui {

/// Draws the legend of the shader in use at the upper left of the picture: the kinds of springs, or a heat map's
/// colours with numbers and unit. Nothing where colours are only looks. The right
/// part of a split view has its own beside the divider.
void draw_legend(const Lab& lab, ImVec2 corner, ImVec2 size);

} // namespace clothlab::ui
