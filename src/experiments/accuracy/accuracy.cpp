#include "experiments/accuracy/accuracy.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "experiments/accuracy/physical_model.h"
#include "experiments/accuracy/reference.h"
#include "experiments/accuracy/report.h"
#include "experiments/accuracy/run.h"
#include "experiments/accuracy/timing.h"
#include "experiments/formatted.h"

namespace clothlab::experiments {
namespace {

// Shares of the whole that progress is told in.
constexpr double errors_begin = 0.1, timing_begins = 0.6;
/// The reference's budget in those of a run.
constexpr double reference_budget = 10;

template <class T>
void sort_and_thin(std::vector<T>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// With its lists filled in, each value once.
AccuracyConfig completed(AccuracyConfig config) {
    if (config.integrators.empty())
        for (const sim::IntegratorInfo& method : sim::integrators())
            config.integrators.push_back(method.id);
    if (config.substeps.empty())
        for (int n = 1; n <= 1024; n *= 2)
            config.substeps.push_back(n);
    if (config.tolerances.empty())
        config.tolerances = {10, 1, 0.1, 0.01};
    if (config.jobs == 0)
        config.jobs = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
    sort_and_thin(config.integrators);
    sort_and_thin(config.substeps);
    sort_and_thin(config.precisions);
    sort_and_thin(config.threads);
    std::sort(config.tolerances.rbegin(), config.tolerances.rend());
    return config;
}

std::vector<Candidate> candidates_of(const AccuracyConfig& config) {
    std::vector<Candidate> candidates;
    for (const sim::IntegratorId id : config.integrators) {
        const sim::IntegratorInfo& method = sim::integrators()[static_cast<std::size_t>(id)];
        Candidate candidate{id, std::string(method.name), "", {"simulation.integrator=" + std::string(method.name)}};
        if (method.divides_steps)
            candidate.settings.emplace_back("simulation.tolerance=0");
        candidates.push_back(std::move(candidate));
    }
    if (!config.rules)
        return candidates;
    const sim::IntegratorId own = config.scene.simulation.stepping.integrator;
    const std::string name(sim::integrators()[static_cast<std::size_t>(own)].name);
    for (const RuleChange& change : course_rules(config.scene)) {
        Settings settings = change.settings;
        settings.push_back("simulation.integrator=" + name);
        candidates.push_back({own, name + ", " + change.name, change.name, std::move(settings)});
    }
    return candidates;
}

std::vector<Attempt> attempts_of(const AccuracyConfig& config, const AccuracyRuns& runs) {
    std::vector<Attempt> attempts;
    for (std::size_t i = 0; i < runs.candidates.size(); ++i)
        for (const sim::Precision precision : config.precisions)
            for (const int substeps : config.substeps) {
                Attempt attempt;
                attempt.candidate = i;
                attempt.precision = precision;
                attempt.substeps = substeps;
                attempt.settings = runs.reference.model;
                for (const std::string& setting : runs.candidates[i].settings)
                    attempt.settings.push_back(setting);
                attempt.settings.push_back(std::string("simulation.precision=") +
                                           (precision == sim::Precision::single_precision ? "single" : "double"));
                attempt.settings.push_back("simulation.substeps=" + std::to_string(substeps));
                attempt.description = with(config.scene, attempt.settings).simulation;
                attempt.dt = sim::step_length(attempt.description);
                attempts.push_back(std::move(attempt));
            }
    return attempts;
}

void measure_errors(const AccuracyConfig& config, AccuracyRuns& runs, const Progress& progress) {
    std::vector<Attempt>& attempts = runs.attempts;
    const auto task = [&](std::size_t i, const Tick& tick) {
        Attempt& attempt = attempts[i];
        const Ending ending = run_to_end(attempt.description, runs.frames, config.budget, tick);
        attempt.status = ending.status;
        attempt.step = ending.seconds / static_cast<double>(ending.steps);
        attempt.left_out = !ending.finished && ending.status != sim::Status::diverged;
        if (ending.finished)
            attempt.error = errors_between(ending, runs.reference.ending);
    };
    run_tasks(attempts.size(), config.jobs, task, [&](std::size_t done) {
        const double share = static_cast<double>(done) / static_cast<double>(attempts.size());
        progress.tell(errors_begin + (timing_begins - errors_begin) * share,
                      formatted("errors, run %zu of %zu", std::min(done + 1, attempts.size()), attempts.size()));
    });
}

void measure_costs(const AccuracyConfig& config, AccuracyRuns& runs, const Progress& progress) {
    std::vector<Timed> timed;
    std::vector<Attempt*> of;
    for (Attempt& attempt : runs.attempts)
        if (attempt.error)
            for (const int threads : config.threads) {
                timed.push_back({attempt.description, threads, attempt.step});
                of.push_back(&attempt);
            }
    const auto tell = [&](double share) {
        progress.tell(timing_begins + (1 - timing_begins) * share, "times, by turns");
    };
    sim::Description description = runs.reference.description;
    description.stepping.substeps = runs.reference.substeps[0];
    const Moments moments = moments_of(description, runs.frames, [&](double) { tell(0); });
    const std::vector<Measured> costs = time_by_turns(timed, moments, runs.frames, config.rounds, config.slot, tell);
    for (std::size_t i = 0; i < costs.size(); ++i)
        of[i]->cost.push_back(costs[i]);
}

} // namespace

const std::vector<ErrorQuantityInfo>& error_quantities() {
    static const std::vector<ErrorQuantityInfo> list{
        {ErrorQuantity::rms, "rms", "rms_error_mm", "RMS error (mm)", "mm", "root mean square over the points, in mm"},
        {ErrorQuantity::largest, "largest", "largest_error_mm", "Largest error (mm)", "mm",
         "of the worst point, in mm"},
        {ErrorQuantity::sag, "sag", "sag_error_mm", "Sag error (mm)", "mm",
         "of how far the mean height has fallen, in mm"},
        {ErrorQuantity::drape, "drape", "drape_error_mm", "Drape height error (mm)", "mm",
         "of the height from the lowest to the highest point, in mm"},
        {ErrorQuantity::energy, "energy", "energy_error_mJ", "Energy error (mJ)", "mJ",
         "of the total energy, kinetic, of springs and of gravity, in mJ"}};
    return list;
}

std::vector<int> spread_substeps(int first, int last, int count) {
    std::vector<int> numbers;
    for (int i = 0; i < count; ++i)
        numbers.push_back(static_cast<int>(
            std::lround(first * std::pow(static_cast<double>(last) / first, static_cast<double>(i) / (count - 1)))));
    sort_and_thin(numbers);
    return numbers;
}

Findings run_accuracy(const AccuracyConfig& wanted, const Progress& progress) {
    const AccuracyConfig config = completed(wanted);
    AccuracyRuns runs;
    const double frames = std::round(config.seconds * config.scene.simulation.stepping.frames_per_second);
    if (!(frames >= 1 && frames < 1e9))
        throw Refusal(formatted("%g s is not a time of one frame, %g s, up to 1e9 of them", config.seconds,
                                1 / config.scene.simulation.stepping.frames_per_second));
    runs.frames = static_cast<std::uint64_t>(frames);
    runs.reference = find_reference(
        config.scene, runs.frames, config.substeps.back(), config.quantity, reference_budget * config.budget,
        [&](double share) { progress.tell(errors_begin * share, "the reference and its own error"); });
    runs.candidates = candidates_of(config);
    runs.attempts = attempts_of(config, runs);
    measure_errors(config, runs, progress);
    if (config.rounds > 0)
        measure_costs(config, runs, progress);
    progress.tell(1, "done");
    return accuracy_findings(config, runs);
}

} // namespace clothlab::experiments
