#include "experiments/sweep/chart.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace clothlab::experiments {
namespace {

std::string status_of(const Table& table, std::size_t row) {
    return table.text(row, "status");
}

/// The number that a row has in the chart, if any.
std::optional<double> charted(const Table& table, std::size_t row, const std::string& plot) {
    const double number = table.number(row, plot);
    if (!std::isfinite(number) || status_of(table, row) == "diverged")
        return std::nullopt;
    return number;
}

/// "cloth.ks=500": a varied parameter's value in a row.
std::string with_value(const Table& table, std::size_t row, const SweepAxis& axis) {
    return axis.key + "=" + table.text(row, axis.key);
}

std::string rest_of(const Table& table, std::size_t row, const std::vector<SweepAxis>& axes) {
    std::string name;
    for (std::size_t i = 1; i < axes.size(); ++i)
        name += (i > 1 ? ", " : "") + with_value(table, row, axes[i]);
    return name;
}

double place_of(const SweepAxis& axis, const Table& table, std::size_t row) {
    if (axis.numeric)
        return table.number(row, axis.key);
    const auto at = std::find(axis.values.begin(), axis.values.end(), table.text(row, axis.key));
    return static_cast<double>(at - axis.values.begin());
}

std::size_t count_of(const Table& table, const std::string& status) {
    std::size_t count = 0;
    for (std::size_t row = 0; row < table.rows.size(); ++row)
        count += status_of(table, row) == status;
    return count;
}

} // namespace

Chart sweep_chart(const std::vector<SweepAxis>& axes, const std::string& plot, const Table& table) {
    const SweepAxis& first = axes.front();
    Chart chart;
    const std::string& title = table.columns[table.column(plot)].title;
    chart.x.label = table.columns[table.column(first.key)].title;
    chart.title = title + " against " + chart.x.label;
    chart.x.log = first.log;
    if (!first.numeric)
        chart.x.names = first.values;
    chart.y.label = title;
    std::vector<std::size_t> rows(table.rows.size());
    std::iota(rows.begin(), rows.end(), 0);
    std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
        return place_of(first, table, a) < place_of(first, table, b);
    });
    for (const std::size_t row : rows) {
        const std::optional<double> number = charted(table, row, plot);
        if (!number)
            continue;
        const std::string name = axes.size() > 1 ? rest_of(table, row, axes) : title;
        auto series =
            std::find_if(chart.series.begin(), chart.series.end(), [&](const Series& s) { return s.name == name; });
        if (series == chart.series.end()) {
            series = chart.series.insert(series, Series{});
            series->name = name;
            series->mark = first.numeric ? Mark::line_and_points : Mark::points;
        }
        series->x.push_back(place_of(first, table, row));
        series->y.push_back(*number);
        series->rows.push_back(row);
    }
    return chart;
}

std::vector<std::string> sweep_sentences(const SweepConfig& config, std::size_t cells, const Table& table) {
    std::string ends;
    for (const char* status : {"ok", "jitter", "diverged"})
        if (const std::size_t count = count_of(table, status))
            ends += (ends.empty() ? ": " : ", ") + std::to_string(count) + " " + status;
    std::vector<std::string> sentences{std::to_string(table.rows.size()) + " of " + std::to_string(cells) + " cells" +
                                       ends + "."};
    std::optional<std::pair<double, std::size_t>> least, most;
    for (std::size_t row = 0; row < table.rows.size(); ++row)
        if (const std::optional<double> number = charted(table, row, config.plot)) {
            if (!least || *number < least->first)
                least = {*number, row};
            if (!most || *number > most->first)
                most = {*number, row};
        }
    if (least && most->first > least->first) {
        const auto end = [&](std::size_t row) {
            std::string where;
            for (const SweepAxis& axis : config.axes)
                where += (where.empty() ? "" : ", ") + with_value(table, row, axis);
            return table.text(row, config.plot) + " at " + where;
        };
        sentences.push_back(table.columns[table.column(config.plot)].title + " goes from " + end(least->second) +
                            " to " + end(most->second) + ".");
    }
    return sentences;
}

std::vector<std::string> sweep_notes(const SweepConfig& config, const Table& table) {
    std::vector<std::string> notes;
    const SweepLength& length = config.length;
    notes.push_back("Each cell was run for " +
                    (length.seconds ? number_text(*length.seconds) + " simulated seconds"
                                    : std::to_string(length.frames) + " frames") +
                    ", or until it diverged; the numbers are those of its last moment.");
    if (const std::size_t diverged = count_of(table, "diverged"))
        notes.push_back("Not in the chart: " + std::to_string(diverged) + " that diverged.");
    if (config.times)
        notes.push_back(
            "Wall times are of single runs beside others on the same machine; no two sweeps have the same.");
    return notes;
}

} // namespace clothlab::experiments
