// Every method converges with its order on a cloth: 20 x 20, default material, upright and hung by its two upper
// corners, half a second, no limiter. The error is that of the worst point, against Dormand-Prince with 12 600 steps a
// second.
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/generators/catch_generators_range.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "sim/simulation.h"
#include "support/effort.h"
#include "support/methods.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr int frames = 45; ///< of 1/90 s
constexpr int half_time = 20;

sim::Description hung_cloth(int substeps, const sim::IntegratorInfo& method) {
    sim::Description description = bare_cloth(20, 20);
    description.cloth.orientation = sim::Orientation::vertical;
    description.cloth.pinned = {{0, 19}, {19, 19}};
    description.rules.start = sim::StartRule::physical;
    description.stepping.gravity = {0, -9.8, 0};
    description.stepping.seed = 1;
    description.stepping.substeps = substeps;
    solve_exactly(description, method);
    if (method.family != sim::Family::explicit_method)
        description.stepping.tolerance = 1e-10;
    description.stepping.iterations = 5; // at steps as small as those here an iteration brings two digits
    return description;
}

/// Positions at the end; changed to `then` at half time.
std::vector<sim::Vec3> end_of(const sim::Description& first, const sim::Description& then) {
    const auto simulation = sim::Simulation::create(first);
    for (int frame = 0; frame < frames; ++frame) {
        if (frame == half_time && !(first == then))
            simulation->change(then);
        simulation->step_frame();
    }
    std::vector<sim::Vec3> positions;
    for (std::size_t i = 0; i < simulation->points(); ++i)
        positions.push_back(simulation->position(i));
    return positions;
}

double error(const sim::Description& first, const sim::Description& then) {
    static const std::vector<sim::Vec3> exact = [] {
        const sim::Description description = hung_cloth(140, method_of(sim::IntegratorId::dormand_prince));
        return end_of(description, description);
    }();
    const std::vector<sim::Vec3> positions = end_of(first, then);
    double largest = 0;
    for (std::size_t i = 0; i < positions.size(); ++i)
        largest = std::max(largest, norm(minus(positions[i], exact[i])));
    return largest;
}
double error(const sim::Description& description) {
    return error(description, description);
}

} // namespace

TEST_CASE("Halving the step divides the error by two to the method's order") {
    const sim::IntegratorInfo info = GENERATE(from_range(sim::integrators().begin(), sim::integrators().end()));
    if (info.order == 0) // it does not converge to the springs' motion
        return;
    if (sanitized) // many steps of what other tests run as well; slopes are the other builds' affair
        return;
    // Where the error's leading term is most of it, and rounding is nothing. Explicit Euler's growth needs the finer
    // step.
    const int substeps = info.order == 1 ? 80 : info.order < 4 ? 20 : 10;
    const double coarse = error(hung_cloth(substeps, info)), fine = error(hung_cloth(2 * substeps, info));
    INFO(info.name << ": " << coarse << " m, then " << fine << " m");
    REQUIRE_THAT(std::log2(coarse / fine), WithinAbs(info.order, 0.1));
}

TEST_CASE(
    "The course's start makes Verlet first order: from 2.7e-4 m the error falls to 2.1e-6 m with the physical one") {
    sim::Description description = hung_cloth(30, method_of(sim::IntegratorId::course_verlet));
    REQUIRE_THAT(error(description), WithinAbs(2.1e-6, 0.15e-6));
    description.rules.start = sim::StartRule::cs184;
    const double coarse = error(description);
    REQUIRE_THAT(coarse, WithinAbs(2.7e-4, 0.05e-4));
    description.stepping.substeps = 60;
    REQUIRE_THAT(std::log2(coarse / error(description)), WithinAbs(1, 0.1));
}

TEST_CASE("A change of the method at half time keeps second order, to Verlet's way of keeping velocities and from it") {
    const sim::IntegratorInfo info = GENERATE(from_range(sim::integrators().begin(), sim::integrators().end()));
    if (info.order < 2 || sanitized)
        return;
    const bool from_verlet = GENERATE(false, true);
    const auto changed = [&](int substeps) {
        const sim::Description verlet = hung_cloth(substeps, method_of(sim::IntegratorId::course_verlet));
        const sim::Description other = hung_cloth(substeps, info);
        return from_verlet ? error(verlet, other) : error(other, verlet);
    };
    const double coarse = changed(20), fine = changed(40);
    INFO(info.name << (from_verlet ? " after" : " before") << " Verlet: " << coarse << " m, then " << fine << " m");
    REQUIRE_THAT(std::log2(coarse / fine), WithinAbs(2, 0.1));
    REQUIRE(coarse < 1e-4);
}
