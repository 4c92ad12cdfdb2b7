#include "experiments/accuracy/timing.h"

#include <algorithm>
#include <chrono>

#include "sim/simulation.h"

namespace clothlab::experiments {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t most_moments = 6;

/// Wall s per simulated s.
double turn(const Timed& run, const Moments& moments, std::uint64_t frames, double slot) {
    const auto simulation =
        sim::Simulation::create(run.description, {.threads = run.threads, .fewer_if_faster = false});
    const auto in_all = static_cast<double>(frames * static_cast<std::uint64_t>(run.description.stepping.substeps));
    const auto count = static_cast<double>(moments.saved.size());
    const int steps = static_cast<int>(std::clamp(slot / run.step / count, 1.0, std::max(in_all / count, 1.0)));
    double seconds = 0;
    for (const auto& saved : moments.saved) {
        simulation->load_state(saved[static_cast<std::size_t>(run.description.stepping.precision)]);
        simulation->step();
        const Clock::time_point start = Clock::now();
        simulation->advance(steps);
        seconds += std::chrono::duration<double>(Clock::now() - start).count();
    }
    return seconds / (steps * count * sim::step_length(run.description));
}

} // namespace

Moments moments_of(const sim::Description& description, std::uint64_t frames, const Tick& tick) {
    const std::uint64_t count = std::min(frames, most_moments);
    Moments moments;
    moments.saved.resize(static_cast<std::size_t>(count));
    for (const sim::Precision precision : {sim::Precision::single_precision, sim::Precision::double_precision}) {
        sim::Description described = description;
        described.stepping.precision = precision;
        const auto simulation = sim::Simulation::create(described);
        for (std::uint64_t i = 0; i < count; ++i) {
            while (simulation->frame() < i * frames / count) {
                simulation->step_frame();
                tick(static_cast<double>(i) / static_cast<double>(count));
            }
            moments.saved[static_cast<std::size_t>(i)][static_cast<std::size_t>(precision)] = simulation->save_state();
        }
    }
    return moments;
}

std::vector<Measured> time_by_turns(const std::vector<Timed>& runs, const Moments& moments, std::uint64_t frames,
                                    int rounds, double slot, const Tick& tick) {
    std::vector<std::vector<double>> costs(runs.size());
    const double turns = static_cast<double>(runs.size()) * rounds;
    double done = 0;
    for (int round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < runs.size(); ++i) {
            tick(done++ / turns);
            costs[i].push_back(turn(runs[i], moments, frames, slot));
        }
    std::vector<Measured> measures;
    for (std::vector<double>& of_run : costs)
        measures.push_back(measured(std::move(of_run)));
    return measures;
}

} // namespace clothlab::experiments
