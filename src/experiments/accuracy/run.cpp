#include "experiments/accuracy/run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <ctime>
#include <exception>
#include <mutex>
#include <thread>

#include "sim/integrators/integrator.h"

namespace clothlab::experiments {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto tick_every = std::chrono::milliseconds(100), look_every = std::chrono::milliseconds(1);
/// What share of the budget has to be used up before the time of the rest is judged by it.
constexpr double judged_after = 0.1;

/// s of processor time that the calling thread has used: unlike the wall clock it stands still while others compute.
double processor_time() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

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
    const double start = processor_time();
    Clock::time_point looked = Clock::now(), told = looked;
    while (ending.steps < steps) {
        if (ending.steps + 1 == steps && !keeps_velocity)
            before_last = shape_of(*simulation);
        ending.self_contacts += simulation->step().self_contacts;
        ++ending.steps;
        if (simulation->trouble() && simulation->trouble()->status == sim::Status::diverged)
            break;
        const Clock::time_point now = Clock::now();
        if (now - looked < look_every)
            continue;
        looked = now;
        if (now - told > tick_every) {
            told = now;
            tick(static_cast<double>(ending.steps) / static_cast<double>(steps));
        }
        const double used = processor_time() - start;
        const double expected = used * static_cast<double>(steps) / static_cast<double>(ending.steps);
        if (used > judged_after * budget && expected > budget && ending.steps < steps)
            return ending;
    }
    ending.seconds = processor_time() - start;
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
            changed.wait_for(lock, tick_every);
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
