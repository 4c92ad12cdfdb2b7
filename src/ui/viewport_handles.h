// What can be dragged in the picture itself: the divider of a split view, and the lamps.
#pragma once

#include <imgui.h>

#include "ui/lab.h"

namespace clothlab::ui {

/// Draws the handles over the picture at a place on the screen, and lets the mouse drag them. Call after the item that
/// owns the rest of the picture, with overlap allowed.
void draw_viewport_handles(Lab& lab, ImVec2 corner, ImVec2 size);

} // namespace clothlab::ui
