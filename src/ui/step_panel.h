// The inside of a step in the viewport, and what the lab has to ask for so that it can be looked at.
#pragma once

#include <imgui.h>

#include "ui/lab.h"

namespace clothlab::ui {

/// Asks for the inside of the next step as long as its panel is seen and the run is paused. After the panels.
void follow_step_panel(Lab& lab);

/// Says what of a step a picture at `corner` shows, and lets a click with Shift on the last item, the picture, pick a
/// point.
void draw_step_in_viewport(Lab& lab, ImVec2 corner, ImVec2 size);

} // namespace clothlab::ui
