#include "experiments/accuracy/report.h"

#include "experiments/accuracy/analysis.h"

namespace clothlab::experiments {
namespace {

/// A number, or nothing.
void add(std::vector<Value>& values, const std::optional<double>& value) {
    values.emplace_back();
    if (value)
        values.back() = *value;
}

void fill_table(const AccuracyAnalysis& a, Findings& findings) {
    Table& table = findings.table;
    table.columns = {{"method", "Method"},     {"rule", "Rule"},     {"precision", "Precision"}, {"threads", "Threads"},
                     {"substeps", "Substeps"}, {"dt_ms", "dt (ms)"}, {"status", "Status"}};
    for (const ErrorQuantityInfo& quantity : error_quantities())
        table.columns.push_back({quantity.column, quantity.title, 3});
    for (const Column& column : {Column{"cost_s_per_s", "Cost (s/s)", 3}, Column{"cost_min_s_per_s", "Least (s/s)", 3},
                                 Column{"cost_max_s_per_s", "Most (s/s)", 3}, Column{"resolved", "Resolved"},
                                 Column{"pareto", "Pareto"}, Column{"order", "Order"}, Column{"slope", "Slope", 3}})
        table.columns.push_back(column);
    for (const AccuracyRow& row : a.rows) {
        const Attempt& attempt = a.attempt(row);
        const Candidate& candidate = a.runs.candidates[attempt.candidate];
        const sim::IntegratorInfo& method = a.method(attempt.candidate);
        std::vector<Value> values{std::string(method.name),
                                  candidate.rule.empty() ? "physical" : candidate.rule,
                                  name_of(attempt.precision),
                                  static_cast<double>(a.config.threads[row.thread]),
                                  static_cast<double>(attempt.substeps),
                                  attempt.dt * 1000,
                                  sim::status_names[static_cast<std::size_t>(attempt.status)]};
        for (std::size_t q = 0; q < error_quantities().size(); ++q)
            add(values, attempt.error ? std::optional((*attempt.error)[q]) : std::nullopt);
        const auto cost = attempt.cost.empty() ? std::nullopt : std::optional(attempt.cost[row.thread]);
        add(values, cost ? std::optional(cost->median) : std::nullopt);
        add(values, cost ? std::optional(cost->min) : std::nullopt);
        add(values, cost ? std::optional(cost->max) : std::nullopt);
        values.emplace_back();
        if (attempt.error)
            values.back() = a.resolved(attempt) ? "yes" : "below the reference's own error";
        values.emplace_back();
        if (a.timed())
            values.back() = row.pareto ? "yes" : "no";
        values.emplace_back(static_cast<double>(method.order));
        const AccuracyLine& line = a.line_of(row);
        add(values, line.slope ? std::optional(line.slope->slope) : std::nullopt);
        if (method.order == 0)
            values.back() = "does not converge to the springs' motion";
        table.rows.push_back(std::move(values));
        findings.settings.push_back(attempt.settings);
    }
}

} // namespace

Findings accuracy_findings(const AccuracyConfig& config, const AccuracyRuns& runs) {
    const AccuracyAnalysis analysis(config, runs);
    Findings findings;
    findings.title = "Accuracy against speed: " + config.scene_name;
    fill_table(analysis, findings);
    findings.reference = runs.reference.settings;
    findings.seconds = static_cast<double>(runs.frames) / config.scene.simulation.stepping.frames_per_second;
    if (analysis.timed())
        findings.charts.push_back(cost_chart(analysis));
    findings.charts.push_back(step_chart(analysis));
    findings.sentences = accuracy_sentences(analysis);
    findings.notes = accuracy_notes(analysis);
    return findings;
}

} // namespace clothlab::experiments
