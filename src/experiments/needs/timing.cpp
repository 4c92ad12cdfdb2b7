#include "experiments/needs/timing.h"

#include <algorithm>
#include <chrono>

namespace clothlab::experiments::needs {
namespace {

using Clock = std::chrono::steady_clock;

/// Of the steps of a whole run.
double seconds_of_run(const sim::Description& model, const Course& course, const Progress& progress) {
    const auto simulation = sim::Simulation::create(model, {.threads = course.threads});
    double seconds = 0;
    for (std::uint64_t frame = 0; frame < course.frames; ++frame) {
        progress.tell(0, "");
        const auto begin = Clock::now();
        simulation->step_frame();
        seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    }
    return seconds;
}

} // namespace

std::vector<Measured> time_by_turns(const std::vector<sim::Description>& models, const Course& course,
                                    const Turns& turns, const Cost& known, const Progress& progress) {
    std::vector<Measured> costs;
    if (known) {
        for (const sim::Description& model : models) {
            const double cost = known(model);
            costs.push_back({cost, cost, cost});
        }
        return costs;
    }
    std::vector<std::vector<double>> taken(models.size());
    for (int round = 0; round < turns.rounds; ++round)
        for (std::size_t i = 0; i < models.size(); ++i) {
            double seconds = 0;
            int runs = 0;
            const auto begin = Clock::now();
            do {
                seconds += seconds_of_run(models[i], course, progress);
                ++runs;
            } while (Clock::now() - begin < std::chrono::duration<double>(turns.least_s));
            taken[i].push_back(seconds / runs / course.seconds);
        }
    for (std::vector<double>& one : taken)
        costs.push_back(measured(std::move(one)));
    return costs;
}

} // namespace clothlab::experiments::needs
