#include "experiments/accuracy/analysis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/formatted.h"

namespace clothlab::experiments {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

} // namespace

const char* name_of(sim::Precision precision) {
    return precision == sim::Precision::single_precision ? "single" : "double";
}
std::string count_of(int n, const char* what) {
    return formatted("%d %s%s", n, what, n == 1 ? "" : "s");
}

AccuracyAnalysis::AccuracyAnalysis(const AccuracyConfig& config_, const AccuracyRuns& runs_)
    : config(config_), runs(runs_), quantity(error_quantities()[static_cast<std::size_t>(config.quantity)]),
      floor(resolution * runs.reference.error[static_cast<std::size_t>(config.quantity)]) {
    find_lines();
    find_rows();
    find_front();
}

double AccuracyAnalysis::seconds() const {
    return static_cast<double>(runs.frames) / config.scene.simulation.stepping.frames_per_second;
}

const sim::IntegratorInfo& AccuracyAnalysis::method(std::size_t candidate) const {
    return sim::integrators()[static_cast<std::size_t>(runs.candidates[candidate].integrator)];
}

double AccuracyAnalysis::error(const Attempt& attempt) const {
    return attempt.error ? (*attempt.error)[static_cast<std::size_t>(config.quantity)] : nothing;
}

double AccuracyAnalysis::cost(const AccuracyRow& row) const {
    const std::vector<Measured>& costs = attempt(row).cost;
    return costs.empty() ? nothing : costs[row.thread].median;
}

const AccuracyLine& AccuracyAnalysis::line_of(const AccuracyRow& row) const {
    return *std::find_if(lines.begin(), lines.end(), [&](const AccuracyLine& line) { return row.attempt < line.last; });
}

void AccuracyAnalysis::find_lines() {
    const std::size_t of_each = config.substeps.size();
    for (std::size_t first = 0; first < runs.attempts.size(); first += of_each) {
        AccuracyLine line{runs.attempts[first].candidate, runs.attempts[first].precision, first, first + of_each, {}};
        std::vector<double> dt, errors;
        std::vector<bool> usable;
        for (std::size_t i = line.first; i < line.last; ++i) {
            const Attempt& at = runs.attempts[i];
            dt.push_back(at.dt);
            errors.push_back(error(at));
            usable.push_back(at.status == sim::Status::ok && resolved(at));
        }
        if (has_slope(line) && method(line.candidate).order > 0)
            line.slope = fit_slope(dt, errors, usable);
        lines.push_back(line);
    }
}

void AccuracyAnalysis::find_rows() {
    for (const AccuracyLine& line : lines)
        for (std::size_t thread = 0; thread < config.threads.size(); ++thread)
            for (std::size_t i = line.first; i < line.last; ++i)
                if (!runs.attempts[i].left_out)
                    rows.push_back({i, thread});
}

void AccuracyAnalysis::find_front() {
    std::vector<double> costs, errors;
    for (const AccuracyRow& row : rows) {
        const Attempt& at = attempt(row);
        costs.push_back(at.status == sim::Status::ok ? cost(row) : nothing);
        // What is nearer than the reference can tell is as good as what is just that near.
        errors.push_back(std::max(error(at), floor));
    }
    const std::vector<bool> front = pareto_front(costs, errors);
    for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i].pareto = front[i];
}

} // namespace clothlab::experiments
