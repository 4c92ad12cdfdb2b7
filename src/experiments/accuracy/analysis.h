// What the accuracy experiment's runs come to: rows of the table, lines of the charts with their slopes, the front.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "experiments/accuracy/convergence.h"
#include "experiments/accuracy/report.h"
#include "sim/integrators/integrator.h"

namespace clothlab::experiments {

/// A row of the table: an attempt with so many threads.
struct AccuracyRow {
    std::size_t attempt, thread; ///< of AccuracyRuns::attempts, of AccuracyConfig::threads
    bool pareto = false;
};

/// All attempts of a candidate in one precision.
struct AccuracyLine {
    std::size_t candidate;
    sim::Precision precision;
    std::size_t first, last; ///< of the attempts; last not included
    std::optional<Slope> slope = {};
};

/// Refers to what it is made of.
class AccuracyAnalysis {
public:
    AccuracyAnalysis(const AccuracyConfig& config, const AccuracyRuns& runs);

    const AccuracyConfig& config;
    const AccuracyRuns& runs;
    const ErrorQuantityInfo& quantity;
    double floor; ///< smaller errors are not told from the reference's own
    std::vector<AccuracyLine> lines;
    std::vector<AccuracyRow> rows; ///< of what was not left out

    bool timed() const { return config.rounds > 0; }
    double seconds() const; ///< simulated s
    const Attempt& attempt(const AccuracyRow& row) const { return runs.attempts[row.attempt]; }
    const sim::IntegratorInfo& method(std::size_t candidate) const;
    double error(const Attempt& attempt) const; ///< in the quantity's unit; NaN where it diverged
    double cost(const AccuracyRow& row) const;  ///< wall s per simulated s; NaN where it was not timed
    bool resolved(const Attempt& attempt) const { return error(attempt) >= floor; }
    /// Slopes are of the more exact of the precisions: the other shows its rounding.
    bool has_slope(const AccuracyLine& line) const { return line.precision == config.precisions.back(); }
    const AccuracyLine& line_of(const AccuracyRow& row) const;
    bool is_of(const AccuracyRow& row, const AccuracyLine& line, std::size_t thread) const {
        return row.thread == thread && row.attempt >= line.first && row.attempt < line.last;
    }

private:
    void find_lines();
    void find_rows();
    void find_front();
};

const char* name_of(sim::Precision precision);
std::string count_of(int n, const char* what); ///< "1 thread", "2 threads"

Chart cost_chart(const AccuracyAnalysis& analysis);
Chart step_chart(const AccuracyAnalysis& analysis);
std::vector<std::string> accuracy_sentences(const AccuracyAnalysis& analysis);
std::vector<std::string> accuracy_notes(const AccuracyAnalysis& analysis);

} // namespace clothlab::experiments
