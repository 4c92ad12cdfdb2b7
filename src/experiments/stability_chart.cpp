#include "experiments/stability_chart.h"

#include <algorithm>
#include <array>
#include <optional>

#include "experiments/stability_cell.h"

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
        const std::size_t columns = p_.x.values.size();
        for (std::size_t i = 0; i < p_.refined.judged.size(); ++i) {
            const auto [x, y] = p_.refined.judged[i];
            add_cell({x, x, y, y}, p_.refined.kind[y * columns + x], i);
        }
        for (const LatticeBlock& block : p_.refined.blocks)
            add_unjudged(block);

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
    void add_cell(const LatticeBlock& b, int kind, std::size_t row) {
        chart_.cells.push_back({p_.x.border(b.x0), p_.x.border(b.x1 + 1), p_.y.border(b.y0), p_.y.border(b.y1 + 1),
                                static_cast<std::size_t>(kind), row});
    }

    /// What lies between a block's judged points: in rows of its longest stretches of points that were not.
    void add_unjudged(const LatticeBlock& block) {
        const std::size_t columns = p_.x.values.size();
        const auto open = [&](std::size_t x, std::size_t y) {
            // A rim that two blocks share belongs to the one above or to the right of it.
            return p_.refined.judged_as[y * columns + x] == not_judged && (x < block.x1 || x + 1 == columns) &&
                   (y < block.y1 || y + 1 == p_.y.values.size());
        };
        const std::size_t corner = block.y0 * columns + block.x0;
        for (std::size_t y = block.y0; y <= block.y1; ++y)
            for (std::size_t x = block.x0; x <= block.x1; ++x) {
                if (!open(x, y))
                    continue;
                const std::size_t from = x;
                while (x + 1 <= block.x1 && open(x + 1, y))
                    ++x;
                add_cell({from, x, y, y}, p_.refined.kind[corner], p_.refined.judged_as[corner]);
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
