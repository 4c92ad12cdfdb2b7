// Draws experiments::Chart with ImPlot: in panels, and, by the app, into PNG pictures.
#pragma once

#include <cstddef>
#include <optional>

#include <imgui.h>

#include "experiments/chart.h"
#include "experiments/table.h"

namespace clothlab::ui {

/// What the mouse has to do with a chart.
struct ChartMouse {
    std::optional<std::size_t> hovered; ///< row of the table
    std::optional<std::size_t> clicked;
};

/// Draws a chart of a size in px into the present window. `id` tells charts of one window apart; with another one, or
/// with `fit`, all of it is shown, and after that what the user zoomed in on. The point of `marked`, a row of the
/// table, has a ring. Hovering over a point or a cell shows its row of the table. Its title is drawn only if `titled`.
ChartMouse draw_chart(const experiments::Chart& chart, const experiments::Table& table, const char* id, ImVec2 size,
                      bool fit, bool titled, std::optional<std::size_t> marked = {});

/// Where axes begin and end so that all of a chart is seen, with a margin.
struct ChartLimits {
    double x_low, x_high, y_low, y_high;
};
ChartLimits limits_of(const experiments::Chart& chart);

} // namespace clothlab::ui
