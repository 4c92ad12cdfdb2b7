// The list of breakpoints in the Moments panel.
#pragma once

#include "ui/lab.h"

namespace clothlab::ui {

void draw_breakpoints(Lab& lab);

/// How a breakpoint's value is shown: strains in percent, all else in the unit that it is kept in.
struct ShownValue {
    double factor = 1; ///< from the value to what is shown
    const char* unit = "";
};
ShownValue shown_value(timeline::BreakpointKind kind);

} // namespace clothlab::ui
