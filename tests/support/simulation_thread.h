// Scenes for the simulation's thread, and ways to wait for what it shows.
#pragma once

#include <chrono>
#include <thread>

#include "app/core/simulation_thread.h"
#include "sim/simulation.h"
#include "support/effort.h"

namespace clothlab::test {

inline sim::Description small_cloth() {
    sim::Description d;
    d.cloth.num_width_points = 8;
    d.cloth.num_height_points = 7;
    d.cloth.pinned = {{0, 0}};
    d.stepping.substeps = 5;
    return d;
}

/// A cloth whose steps take long.
inline sim::Description big_cloth() {
    sim::Description d;
    d.cloth.num_width_points = d.cloth.num_height_points = sanitized ? 250 : 600;
    return d;
}

/// Whether what is shown is, to the bit, what the simulation has after as many steps.
inline bool shows(const app::Published& published, const sim::Simulation& simulation) {
    sim::Snapshot expected;
    simulation.capture(expected);
    return published.snapshot && published.snapshot->positions == expected.positions &&
           published.snapshot->steps == expected.steps && published.snapshot->frame == expected.frame &&
           published.snapshot->substep == expected.substep && published.snapshot->time == expected.time;
}

inline app::Published finished(app::SimulationThread& thread) {
    thread.finish();
    return thread.latest();
}

/// Waits until the thread shows something that is wanted; a thread that never does hangs the test.
template <class Wanted>
inline app::Published wait_for(const app::SimulationThread& thread, Wanted wanted) {
    for (;;) {
        app::Published published = thread.latest();
        if (wanted(published))
            return published;
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
}

} // namespace clothlab::test
