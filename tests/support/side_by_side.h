// Runs clothlab's simulation and the reference side by side and compares them to the last bit.
#pragma once

#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <optional>
#include <string>

#include "sim/simulation.h"
#include "support/description_of.h"

namespace clothlab::test {

/// The first point at which the two differ, in words; nothing when all bits agree and are finite.
template <class Real>
std::optional<std::string> difference(const sim::Simulation& simulation, const reference::Simulator<Real>& expected) {
    for (std::size_t i = 0; i < expected.masses.size(); ++i) {
        const sim::Vec3 got = simulation.position(i);
        const reference::Vector<Real> want = expected.masses[i].x;
        const bool same = got.x == static_cast<double>(want.x) && got.y == static_cast<double>(want.y) &&
                          got.z == static_cast<double>(want.z);
        if (same)
            continue;
        const auto text = [](double a, double b) { return std::to_string(a) + " for " + std::to_string(b) + " "; };
        return "point " + std::to_string(i) + " is at " + text(got.x, static_cast<double>(want.x)) +
               text(got.y, static_cast<double>(want.y)) + text(got.z, static_cast<double>(want.z)) + "off by " +
               std::to_string(std::abs(got.y - static_cast<double>(want.y)) * 1e12) + " pm in y";
    }
    return {};
}

/// One step of both; the sums of what the stages did must agree too.
template <class Real>
void step_both(sim::Simulation& simulation, reference::Simulator<Real>& expected, sim::StepCounts& sum) {
    const sim::StepCounts counts = simulation.step();
    expected.step();
    sum.self_contacts += counts.self_contacts;
    sum.contacts += counts.contacts;
    sum.shortened_springs += counts.shortened_springs;
}

template <class Real>
void require_equal(const sim::Simulation& simulation, const reference::Simulator<Real>& expected,
                   const sim::StepCounts& sum) {
    const std::optional<std::string> differs = difference(simulation, expected);
    INFO((sizeof(Real) == 4 ? "single" : "double")
         << " precision, step " << simulation.steps() << ": " << differs.value_or("equal"));
    REQUIRE_FALSE(differs);
    REQUIRE(sum.self_contacts == expected.acted.self_contacts);
    REQUIRE(sum.contacts == expected.acted.contacts);
    REQUIRE(sum.shortened_springs == expected.acted.shortened_springs);
}

/// Runs both in one precision and compares all points after every frame. Returns what the stages did.
template <class Real>
sim::StepCounts run_side_by_side(const reference::Parameters& parameters, int frames) {
    const auto simulation = sim::Simulation::create(description_of(parameters, precision_of<Real>));
    reference::Simulator<Real> expected(parameters);
    const sim::Vec3 start = simulation->position(simulation->points() - 1);
    sim::StepCounts sum;
    require_equal(*simulation, expected, sum);
    for (int frame = 0; frame < frames; ++frame) {
        for (int substep = 0; substep < parameters.substeps; ++substep)
            step_both(*simulation, expected, sum);
        require_equal(*simulation, expected, sum);
    }
    REQUIRE(simulation->frame() == static_cast<std::uint64_t>(frames));
    const sim::Vec3 end = simulation->position(simulation->points() - 1);
    REQUIRE_FALSE(end == start); // the last point is free in all scenes: it went somewhere
    REQUIRE(std::isfinite(end.x + end.y + end.z));
    return sum;
}

/// Both precisions; what the stages did in each must be worth comparing, which the caller checks by `acts`.
template <class Acts>
void require_same_bits(const reference::Parameters& parameters, Acts acts, int frames = 10) {
    for (const sim::StepCounts& sum :
         {run_side_by_side<double>(parameters, frames), run_side_by_side<float>(parameters, frames)}) {
        INFO(sum.self_contacts << " self-contacts, " << sum.contacts << " contacts, " << sum.shortened_springs
                               << " shortened springs");
        REQUIRE(acts(sum));
    }
}

} // namespace clothlab::test
