#include "experiments/stability/chart.h"

#include <algorithm>
#include <array>
#include <optional>

#include "experiments/stability/cell.h"

namespace clothlab::experiments {
namespace {

constexpr std::array<std::array<float, 3>, verdict_names.size()> colours{
    {{0.36f, 0.62f, 0.44f}, {0.93f, 0.83f, 0.42f}, {0.91f, 0.58f, 0.24f}, {0.72f, 0.24f, 0.22f}}};

class Drawing {
public:
    explicit Drawing(const StabilityPicture& picture)
        : p_(picture), along_x_(looks_along_x(picture.x, picture.y)), across_(along_x_ ? picture.y : picture.x) {}

    Chart draw() {
        chart_.x = p_.x.chart_axis();
        chart_.y = p_.y.chart_axis();
        for (std::size_t i = 0; i < verdict_names.size(); ++i)
            chart_.cell_kinds.push_back({verdict_names[i], colours[i]});
        add_cells();

        std::size_t ranks = 0;
        for (const BoundaryPoint& point : p_.border)
            ranks = std::max(ranks, point.rank + 1);
        for (std::size_t rank = 0; rank < ranks; ++rank)
            add_lines("observed", Mark::line, 0, [&](std::size_t line) -> std::optional<double> {
                for (const BoundaryPoint& point : p_.border)
                    if (point.line == line && point.rank == rank)
                        return point.observed;
                return std::nullopt;
            });
        std::size_t most = 0;
        for (const std::vector<double>& line : p_.predicted)
            most = std::max(most, line.size());
        for (std::size_t rank = 0; rank < most; ++rank)
            add_lines("predicted", Mark::dashed, 1, [&](std::size_t line) -> std::optional<double> {
                return rank < p_.predicted[line].size() ? std::optional(p_.predicted[line][rank]) : std::nullopt;
            });
        return std::move(chart_);
    }

private:
    /// A cell for each run; what is like it beside it, in rows of those that are next to each other.
    void add_cells() {
        const std::size_t columns = p_.x.values.size();
        for (std::size_t y = 0; y < p_.y.values.size(); ++y)
            for (std::size_t x = 0; x < columns; ++x) {
                const std::size_t first = x, row = p_.refined.like[y * columns + x];
                if (!p_.refined.was_judged({x, y}, columns))
                    while (x + 1 < columns && p_.refined.like[y * columns + x + 1] == row &&
                           !p_.refined.was_judged({x + 1, y}, columns))
                        ++x;
                chart_.cells.push_back({p_.x.border(first), p_.x.border(x + 1), p_.y.border(y), p_.y.border(y + 1),
                                        static_cast<std::size_t>(p_.refined.kind[y * columns + x]), row});
            }
    }

    /// A line of the places that lines have, broken where one has none. Where lines are no numbers, a dash for each.
    template <class Place>
    void add_lines(const char* name, Mark mark, int colour, Place place) {
        std::optional<std::size_t> open;
        for (std::size_t line = 0; line < across_.values.size(); ++line) {
            const std::optional<double> at = place(line);
            if (!at || across_.categorical)
                open.reset();
            if (!at)
                continue;
            if (!open) {
                open = chart_.series.size();
                chart_.series.push_back({name, mark, colour, true, {}, {}});
            }
            Series& series = chart_.series[*open];
            const auto add = [&](double across) {
                series.x.push_back(along_x_ ? *at : across);
                series.y.push_back(along_x_ ? across : *at);
            };
            if (across_.categorical) {
                add(across_.border(line));
                add(across_.border(line + 1));
            } else {
                add(across_.values[line].at);
            }
        }
    }

    const StabilityPicture& p_;
    bool along_x_;
    const VariedAxis& across_;
    Chart chart_;
};

} // namespace

Chart stability_chart(const StabilityPicture& picture) {
    return Drawing(picture).draw();
}

} // namespace clothlab::experiments
