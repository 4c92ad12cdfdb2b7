#include "experiments/accuracy_run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "sim/integrators/integrator.h"

namespace clothlab::experiments {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double tick_every = 0.1; // s
/// What share of the budget has to be used up before the time of the rest is judged by it.
constexpr double judged_after = 0.1;

/// J; velocities from the shapes a step before and a step after.
double kinetic_energy(const Shape& before, const Shape& after, const sim::Description& description) {
    const double two_dt = 2 * sim::step_length(description);
    double sum = 0; // m²
    for (std::size_t i = 0; i < before.points.size(); ++i) {
        const sim::Vec3 &p = before.points[i], &q = after.points[i];
        sum += (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y) + (q.z - p.z) * (q.z - p.z);
    }
    return 0.5 * sim::point_mass(description.cloth) * sum / (two_dt * two_dt);
}

} // namespace

Ending run_to_end(const sim::Description& description, std::uint64_t frames, double budget, const Tick& tick) {
    const auto simulation = sim::Simulation::create(description);
    simulation->watch(true);
    const std::uint64_t steps = frames * static_cast<std::uint64_t>(description.stepping.substeps);
    const bool keeps_velocity = sim::traits(description.stepping.integrator).velocity;
    Ending ending;
    Shape before_last;
    double told = 0;
    const Clock::time_point start = Clock::now();
    while (ending.steps < steps) {
        if (ending.steps + 1 == steps && !keeps_velocity)
            before_last = shape_of(*simulation);
        ending.self_contacts += simulation->step().self_contacts;
        ++ending.steps;
        ending.wall = std::chrono::duration<double>(Clock::now() - start).count();
        if (simulation->trouble() && simulation->trouble()->status == sim::Status::diverged)
            break;
        if (ending.wall - told > tick_every) {
            told = ending.wall;
            tick(static_cast<double>(ending.steps) / static_cast<double>(steps));
        }
        const double expected = ending.wall * static_cast<double>(steps) / static_cast<double>(ending.steps);
        if (ending.wall > judged_after * budget && expected > budget && ending.steps < steps)
            return ending;
    }
    if (simulation->trouble())
        ending.status = simulation->trouble()->status;
    ending.finished = ending.status != sim::Status::diverged;
    if (!ending.finished)
        return ending;
    ending.shape = shape_of(*simulation);
    const sim::Energy energy = simulation->diagnose().energy;
    ending.energy = energy.total();
    if (!keeps_velocity) {
        simulation->step();
        ending.energy += kinetic_energy(before_last, shape_of(*simulation), description) - energy.kinetic;
    }
    return ending;
}

Errors errors_between(const Ending& ending, const Ending& reference) {
    const Distance apart = distance(ending.shape, reference.shape);
    const double mm = 1000; // per m, and mJ per J
    return {mm * apart.rms, mm * apart.largest, mm * std::abs(mean_height(ending.shape) - mean_height(reference.shape)),
            mm * std::abs(drape_height(ending.shape) - drape_height(reference.shape)),
            mm * std::abs(ending.energy - reference.energy)};
}

void run_tasks(std::size_t n, int jobs, const std::function<void(std::size_t, const Tick&)>& task,
               const std::function<void(std::size_t)>& tell) {
    if (jobs == 1) {
        for (std::size_t i = 0; i < n; ++i) {
            tell(i);
            task(i, [&](double) { tell(i); });
        }
        return;
    }
    std::mutex mutex;
    std::condition_variable changed;
    std::size_t done = 0, working = std::min(static_cast<std::size_t>(jobs), n);
    std::exception_ptr failure;
    std::atomic<std::size_t> next = 0;
    std::atomic<bool> stopped = false;
    const auto work = [&] {
        try {
            for (std::size_t i; (i = next++) < n && !stopped;) {
                task(i, [&](double) {
                    if (stopped)
                        throw Cancelled();
                });
                const std::lock_guard lock(mutex);
                ++done;
            }
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (!failure)
                failure = std::current_exception();
            stopped = true;
        }
        const std::lock_guard lock(mutex);
        --working;
        changed.notify_one();
    };
    std::vector<std::thread> threads;
    const auto end = [&] {
        stopped = true;
        for (std::thread& thread : threads)
            thread.join();
    };
    try {
        for (std::size_t i = 0, count = working; i < count; ++i)
            threads.emplace_back(work);
        std::unique_lock lock(mutex);
        while (working > 0) {
            changed.wait_for(lock, std::chrono::duration<double>(tick_every));
            const std::size_t now = done;
            lock.unlock();
            tell(now);
            lock.lock();
        }
    } catch (...) {
        end();
        throw;
    }
    end();
    if (failure)
        std::rethrow_exception(failure);
}

} // namespace clothlab::experiments
