#include "experiments/stability/map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "experiments/formatted.h"
#include "experiments/run_parallel.h"
#include "experiments/stability/axis.h"
#include "experiments/stability/boundary.h"
#include "experiments/stability/chart.h"
#include "experiments/stability/prediction.h"
#include "experiments/stability/refinement.h"
#include "experiments/trial.h"

namespace clothlab::experiments {
namespace {

class Mapping {
public:
    Mapping(const StabilityMapConfig& config, const Progress& progress)
        : config_(config), progress_(progress), x_(read_axis(config.x, config.resolution, config.scene)),
          y_(read_axis(config.y, config.resolution, config.scene)), along_x_(looks_along_x(x_, y_)),
          along_(along_x_ ? x_ : y_), across_(along_x_ ? y_ : x_) {
        if (x_.quantity.key == y_.quantity.key)
            throw Refusal(x_.quantity.key + ": the two axes of a map have to differ");
        if (config.blocks < 1)
            throw Refusal("the coarse lattice needs at least one block");
    }

    Findings run() {
        const Lattice lattice{.x = {x_.values.size(), !x_.categorical},
                              .y = {y_.values.size(), !y_.categorical},
                              .blocks = config_.blocks,
                              .group = [](int kind) { return kind == static_cast<int>(Verdict::stable) ? 0 : 1; }};
        refined_ = refine(lattice, [this](const std::vector<LatticePoint>& points) { return judge_all(points); });
        predict();
        const std::size_t columns = x_.values.size();
        border_ = boundary(
            along_, across_.values.size(),
            [&](std::size_t line, std::size_t i) {
                const std::size_t x = along_x_ ? i : line, y = along_x_ ? line : i;
                return refined_.kind[y * columns + x] == static_cast<int>(Verdict::stable);
            },
            predicted_);
        fill_table();
        findings_.title =
            "Stability of " + config_.scene.name + ": " + y_.quantity.label + " over " + x_.quantity.label;
        findings_.charts.push_back(stability_chart({x_, y_, refined_, border_, predicted_}));
        findings_.charts.back().title = findings_.title;
        say();
        return std::move(findings_);
    }

private:
    Settings settings(std::size_t x, std::size_t y) const {
        Settings both = x_.values[x].settings;
        both.insert(both.end(), y_.values[y].settings.begin(), y_.values[y].settings.end());
        return both;
    }

    /// What is done so far, of about as much as there is to do: the coarse lattice, and three runs for each step along
    /// a border across the map.
    void tell(std::size_t done) const {
        const auto side = [&](const VariedAxis& axis) {
            return axis.categorical ? axis.values.size() : std::min(config_.blocks + 1, axis.values.size());
        };
        const double expected = static_cast<double>(side(x_) * side(y_) + 3 * (x_.values.size() + y_.values.size()));
        progress_.tell(std::min(0.9, 0.9 * static_cast<double>(done) / expected), formatted("run %zu", done + 1));
    }

    std::vector<int> judge_all(const std::vector<LatticePoint>& points) {
        const std::size_t before = judged_.size();
        judged_.resize(before + points.size());
        run_parallel(
            points.size(), config_.threads,
            [&](std::size_t i, const Check& check) {
                const scene::Scene scene = with(config_.scene, settings(points[i].x, points[i].y));
                judged_[before + i] = judge(scene.simulation, config_.judge, check);
            },
            [&](std::size_t done) { tell(before + done); });
        std::vector<int> kinds;
        for (std::size_t i = before; i < judged_.size(); ++i)
            kinds.push_back(static_cast<int>(judged_[i].verdict));
        return kinds;
    }

    void predict() {
        predicted_.resize(across_.values.size());
        if (along_.categorical)
            return;
        std::vector<double> values; // every eighth, and the last
        for (std::size_t i = 0; i < along_.values.size(); i += 8)
            values.push_back(along_.values[i].at);
        if (values.back() != along_.values.back().at)
            values.push_back(along_.values.back().at);
        run_parallel(
            across_.values.size(), config_.threads,
            [&](std::size_t line, const Check& check) {
                predicted_[line] = crossings(
                    [&](double value) {
                        check();
                        Settings at = across_.values[line].settings;
                        for (const std::string& setting : settings_of(along_.quantity, value, config_.scene))
                            at.push_back(setting);
                        return limit_ratio(with(config_.scene, at).simulation);
                    },
                    values, along_.log, along_.quantity.whole);
            },
            [&](std::size_t done) {
                progress_.tell(0.9 + 0.1 * static_cast<double>(done) / static_cast<double>(across_.values.size()),
                               "predicted boundary");
            });
    }

    void fill_table() {
        Table& table = findings_.table;
        const auto axis_column = [](const VariedAxis& axis) {
            return Column{axis.quantity.column, axis.quantity.label, 5};
        };
        const std::string unit = along_.quantity.unit.empty() ? "" : " (" + along_.quantity.unit + ")";
        table.columns = {axis_column(x_),
                         axis_column(y_),
                         {"verdict", "Verdict"},
                         {"omega_dt_over_limit", "omega dt / limit", 4},
                         {"judged_after_s", "Judged after (s)", 4},
                         {"predicted_" + along_.quantity.column, "Predicted boundary" + unit, 5},
                         {"observed_" + along_.quantity.column, "Observed boundary" + unit, 5},
                         {"distance_percent", "Observed beyond predicted (%)", 3},
                         {"half_cell_percent", "Half a cell (%)", 3},
                         {"cause", "Cause"}};
        const auto value = [](const VariedAxis& axis, std::size_t i) -> Value {
            return axis.categorical ? Value(axis.values[i].text) : Value(axis.values[i].at);
        };
        for (std::size_t i = 0; i < judged_.size(); ++i) {
            const auto [x, y] = refined_.judged[i];
            const Judged& run = judged_[i];
            Value ratio;
            if (run.limit > 0 && std::isfinite(run.omega_dt))
                ratio = run.omega_dt / run.limit;
            table.rows.push_back({value(x_, x), value(y_, y), verdict_names[static_cast<std::size_t>(run.verdict)],
                                  ratio, run.time, Value(), Value(), Value(), Value(), run.cause});
            findings_.settings.push_back(settings(x, y));
        }
        for (const BoundaryPoint& point : border_) {
            const std::size_t i = point.stable_below ? point.below : point.below + 1;
            const std::size_t x = along_x_ ? i : point.line, y = along_x_ ? point.line : i;
            const std::size_t row = refined_.like[y * x_.values.size() + x];
            if (point.predicted) {
                table.rows[row][5] = *point.predicted;
                table.rows[row][7] = *point.distance();
            }
            table.rows[row][6] = point.observed;
            table.rows[row][8] = point.half_cell;
        }
    }

    void say() {
        std::vector<double> distances, halves;
        for (const BoundaryPoint& point : border_)
            if (point.predicted) {
                distances.push_back(std::abs(*point.distance()));
                halves.push_back(point.half_cell);
            }
        const auto median = [](std::vector<double>& v) {
            std::sort(v.begin(), v.end());
            return v.size() % 2 ? v[v.size() / 2] : 0.5 * (v[v.size() / 2 - 1] + v[v.size() / 2]);
        };
        const char* key = along_.quantity.key.c_str();
        if (!distances.empty())
            findings_.sentences.push_back(formatted(
                "Observed and predicted boundary are %.2g %% of %s apart in the median, %.2g %% at most, at %zu "
                "points; half a cell is %.2g %%.",
                median(distances), key, *std::max_element(distances.begin(), distances.end()), distances.size(),
                median(halves)));
        else if (border_.empty())
            findings_.sentences.push_back(
                formatted("There is no boundary in this map: every run that was judged is %s.",
                          refined_.kind[0] == 0 ? "stable" : "unstable"));
        else
            findings_.sentences.push_back("No boundary is predicted where one was observed.");
        const std::size_t alone = border_.size() - distances.size();
        if (alone > 0 && !distances.empty())
            findings_.sentences.push_back(
                formatted("At %zu more points a boundary was observed and none predicted.", alone));
        std::array<std::size_t, verdict_names.size()> counts{};
        for (const int kind : refined_.kind)
            ++counts[static_cast<std::size_t>(kind)];
        std::string list;
        for (std::size_t i = 0; i < counts.size(); ++i)
            list += formatted("%s%zu %s",
                              i == 0                   ? ""
                              : i + 1 == counts.size() ? " and "
                                                       : ", ",
                              counts[i], verdict_names[i]);
        findings_.sentences.push_back(formatted("Of %zu cells %s.", refined_.kind.size(), list.c_str()));
        const auto runs = static_cast<double>(judged_.size()), full = static_cast<double>(refined_.kind.size());
        findings_.sentences.push_back(formatted(
            "It took %.0f runs; the full grid would have taken %.0f, %.1f times as many.", runs, full, full / runs));

        findings_.notes = {
            formatted(
                "Cells are runs of a coarse lattice of %zu blocks a side, and of points next to a change of verdict; "
                "the "
                "others are taken to be like those around them. An island between coarse points would be missed.",
                config_.blocks),
            formatted(
                "At the start every point is moved by up to %g of the shortest rest length, so that there is something "
                "to grow.",
                start_noise),
            config_.judge.frames || config_.judge.seconds
                ? "A run without trouble is stable at its end."
                : formatted("A run without trouble is stable after %g s and %llu steps.", default_seconds,
                            static_cast<unsigned long long>(default_steps)),
            "Predicted is omega dt of the fastest mode of the start pose against the method's limit; contacts and the "
            "stretch limit are not part of it."};
    }

    const StabilityMapConfig& config_;
    const Progress& progress_;
    VariedAxis x_, y_;
    bool along_x_;
    const VariedAxis &along_, &across_;
    std::vector<Judged> judged_; ///< in the order of refined_.judged
    Refined refined_;
    std::vector<std::vector<double>> predicted_;
    std::vector<BoundaryPoint> border_;
    Findings findings_;
};

} // namespace

Findings map_stability(const StabilityMapConfig& config, const Progress& progress) {
    return Mapping(config, progress).run();
}

} // namespace clothlab::experiments
