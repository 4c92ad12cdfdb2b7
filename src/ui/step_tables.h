// The numbers of a step's inside.
#pragma once

#include <imgui.h>

#include "ui/lab.h"

namespace clothlab::ui {

/// A stage's colour, fainter where the model does not have it.
ImU32 stage_tint(std::size_t stage, bool active);

/// The point with the largest force.
std::uint32_t strongest(const sim::StepTrace& trace);

/// What every stage did to all points, a row each; a click on a row shows the stage.
void draw_stage_table(Lab& lab, const sim::StepTrace& trace);
/// What every stage did to one point.
void draw_point_table(const sim::StepTrace& trace, std::uint32_t point);

} // namespace clothlab::ui
