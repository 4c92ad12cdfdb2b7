#include "cli/experiment/sweep_pictures.h"

#include <cstdio>

namespace clothlab::cli {
namespace {

/// No side of the whole picture is longer, in px.
constexpr double longest = 32768;

std::size_t columns_of(const experiments::Sweep& sweep) {
    return sweep.config().axes.front().values.size();
}

/// "Max strain 0.0123"; a number of a run that diverged means nothing.
std::string caption_of(const experiments::Sweep& sweep, const experiments::Table& table) {
    if (table.text(0, "status") == "diverged")
        return "";
    const std::string& plot = sweep.config().plot;
    return table.columns[table.column(plot)].title + " " + table.text(0, plot);
}

} // namespace

std::string objection_to_grid(const experiments::Sweep& sweep, int width, int height) {
    if (sweep.config().axes.size() > 2)
        return "a grid has two directions; vary one or two parameters";
    const std::size_t columns = columns_of(sweep), rows = sweep.cells() / columns;
    if (static_cast<double>(columns) * width > longest || static_cast<double>(rows) * height > longest)
        return std::to_string(columns) + " x " + std::to_string(rows) + " pictures of " + std::to_string(width) +
               " x " + std::to_string(height) + " px are too many for one; name a smaller --picture-size";
    return "";
}

SceneGrid sweep_pictures(const experiments::Sweep& sweep, const experiments::SweepRows& rows) {
    const auto& axes = sweep.config().axes;
    SceneGrid grid;
    grid.source = sweep.config().name;
    grid.columns = columns_of(sweep);
    const std::size_t lines = sweep.cells() / grid.columns;
    for (const std::string& value : axes.front().values)
        grid.column_labels.push_back(axes.front().key + " = " + value);
    if (axes.size() > 1)
        for (const std::string& value : axes.back().values)
            grid.row_labels.push_back(axes.back().key + " = " + value);
    for (std::size_t row = 0; row < lines; ++row)
        for (std::size_t column = 0; column < grid.columns; ++column) {
            const std::size_t cell = column * lines + row; // the last parameter changes fastest
            const experiments::Table table{sweep.columns(), {rows.at(cell)}};
            const std::string status = table.text(0, "status");
            grid.cells.push_back(
                {sweep.scene(cell), sweep.frames(cell), caption_of(sweep, table), status == "ok" ? "" : status});
        }
    return grid;
}

} // namespace clothlab::cli
