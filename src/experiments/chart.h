// A chart as data: experiments make it, ui/charts draws it, on screen and into PNG pictures alike.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace clothlab::experiments {

struct Axis {
    std::string label; ///< with the unit
    bool log = false;
    std::vector<std::string> names = {}; ///< of the places 0, 1, 2, ... where the axis has things on it, not numbers
};

enum class Mark : std::uint8_t { line, points, line_and_points, dashed };

inline constexpr std::size_t no_row = std::numeric_limits<std::size_t>::max();

struct Series {
    std::string name; ///< in the legend; series of one name are shown and hidden as one
    Mark mark = Mark::line_and_points;
    int colour = -1;         ///< a number of the palette: series of one number look alike; -1: the next that is free
    bool emphasised = false; ///< drawn thicker and over the others, such as a Pareto front
    std::vector<double> x = {}, y = {};
    /// The table's row of each point, for what is clicked; empty, or no_row: nothing to click.
    std::vector<std::size_t> rows = {};
    std::vector<double> x_low = {}, x_high = {}; ///< the spread of x, drawn as bars; empty: none
};

/// A line across the whole chart.
struct Guide {
    std::string name;
    bool vertical = false;
    double at = 0;
};

/// What a cell of a map may be.
struct CellKind {
    std::string name;
    std::array<float, 3> colour; ///< sRGB
};

/// A rectangle of a map, in the axes' units.
struct Cell {
    double x0, x1, y0, y1;
    std::size_t kind;         ///< of Chart::cell_kinds
    std::size_t row = no_row; ///< of the table
};

struct Chart {
    std::string title;
    Axis x, y;
    std::vector<Series> series = {};
    std::vector<Guide> guides = {};
    std::vector<CellKind> cell_kinds = {};
    std::vector<Cell> cells = {}; ///< under the series
};

} // namespace clothlab::experiments
