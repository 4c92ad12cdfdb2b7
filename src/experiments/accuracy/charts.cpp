// The charts of the accuracy experiment.
#include <algorithm>

#include "experiments/accuracy/analysis.h"
#include "experiments/formatted.h"

namespace clothlab::experiments {
namespace {

Series series_of(const AccuracyAnalysis& a, const AccuracyLine& line, std::size_t thread) {
    const Candidate& candidate = a.runs.candidates[line.candidate];
    const bool exact = line.precision == a.config.precisions.back();
    Series series;
    series.name = candidate.name;
    series.colour = static_cast<int>(candidate.rule.empty() ? static_cast<std::size_t>(candidate.integrator)
                                                            : sim::integrators().size() + line.candidate);
    series.mark =
        exact ? (thread == 0 ? Mark::line_and_points : Mark::line) : (thread == 0 ? Mark::dashed : Mark::points);
    return series;
}

/// What the marks mean, of the precisions and threads that there are.
std::string legend(const AccuracyAnalysis& a) {
    std::string text;
    const auto add = [&](sim::Precision precision, std::size_t thread, const char* mark) {
        text += (text.empty() ? "" : "; ") + std::string(mark) + " " + name_of(precision) + ", " +
                count_of(a.config.threads[thread], "thread");
    };
    for (std::size_t thread = 0; thread < a.config.threads.size(); ++thread) {
        add(a.config.precisions.back(), thread, thread == 0 ? "points joined" : "line");
        if (a.config.precisions.size() > 1)
            add(a.config.precisions.front(), thread, thread == 0 ? "dashed" : "points");
    }
    return text;
}

} // namespace

Chart cost_chart(const AccuracyAnalysis& a) {
    Chart chart;
    chart.title =
        formatted("%s: %s after %.3g s against cost", a.config.scene_name.c_str(), a.quantity.title, a.seconds());
    chart.x = {"Cost (wall s per simulated s): " + legend(a), true};
    chart.y = {a.quantity.title, true};
    chart.guides.push_back({"real time", true, 1});
    Series front{.name = "Pareto front", .mark = Mark::line, .emphasised = true, .x = {}, .y = {}};
    std::vector<std::size_t> on_front;
    for (const AccuracyLine& line : a.lines)
        for (std::size_t thread = 0; thread < a.config.threads.size(); ++thread) {
            Series series = series_of(a, line, thread);
            for (std::size_t i = 0; i < a.rows.size(); ++i) {
                const AccuracyRow& row = a.rows[i];
                const Attempt& attempt = a.attempt(row);
                if (!a.is_of(row, line, thread) || attempt.cost.empty() || !(a.error(attempt) > 0))
                    continue;
                series.x.push_back(a.cost(row));
                series.y.push_back(a.error(attempt));
                series.rows.push_back(i);
                series.x_low.push_back(attempt.cost[thread].min);
                series.x_high.push_back(attempt.cost[thread].max);
                if (row.pareto)
                    on_front.push_back(i);
            }
            if (!series.x.empty())
                chart.series.push_back(std::move(series));
        }
    std::sort(on_front.begin(), on_front.end(),
              [&](std::size_t i, std::size_t j) { return a.cost(a.rows[i]) < a.cost(a.rows[j]); });
    for (const std::size_t i : on_front) {
        front.x.push_back(a.cost(a.rows[i]));
        front.y.push_back(a.error(a.attempt(a.rows[i])));
        front.rows.push_back(i);
    }
    chart.series.push_back(std::move(front));
    return chart;
}

Chart step_chart(const AccuracyAnalysis& a) {
    Chart chart;
    chart.title = formatted("%s: %s after %.3g s against the step, %s precision", a.config.scene_name.c_str(),
                            a.quantity.title, a.seconds(), name_of(a.config.precisions.back()));
    chart.x = {"Step dt (ms)", true};
    chart.y = {a.quantity.title, true};
    if (a.floor > 0)
        chart.guides.push_back({formatted("%g times the reference's own error", resolution), false, a.floor});
    for (const AccuracyLine& line : a.lines) {
        if (!a.has_slope(line))
            continue;
        Series series = series_of(a, line, 0);
        if (line.slope)
            series.name += formatted(", slope %.2f", line.slope->slope);
        for (std::size_t i = 0; i < a.rows.size(); ++i) {
            const AccuracyRow& row = a.rows[i];
            const Attempt& attempt = a.attempt(row);
            if (!a.is_of(row, line, 0) || !(a.error(attempt) > 0))
                continue;
            series.x.push_back(attempt.dt * 1000);
            series.y.push_back(a.error(attempt));
            series.rows.push_back(i);
        }
        if (!series.x.empty())
            chart.series.push_back(std::move(series));
    }
    return chart;
}

} // namespace clothlab::experiments
