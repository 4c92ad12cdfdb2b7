// Forces are minus the gradients of their energies, and the method keeps the energy of a cloth to second order.
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/generators/catch_generators_range.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "sim/diagnostics.h"
#include "sim/forces/gravity.h"
#include "sim/forces/springs.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

Sheet<double> crumpled(sim::Description description) {
    Sheet<double> sheet(description);
    sim::SplitMix64 random(5);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 x = sheet.position(i), r = uniform_point(random, -0.08, 0.08);
        sheet.place(i, {x.x + r.x, x.y + r.y, x.z + r.z});
    }
    return sheet;
}

/// Checks work.force, which `energy(position)` should be the potential of, by central differences.
template <class Energy>
void require_gradient(Sheet<double>& sheet, Energy energy) {
    double largest = 0;
    for (const auto* axis : {&sheet.work.force.x, &sheet.work.force.y, &sheet.work.force.z})
        for (const double f : *axis)
            largest = std::max(largest, std::abs(f));
    REQUIRE(largest > 1e-3);
    const double h = 1e-6;
    sim::Vec3Array<double>& x = sheet.state.position;
    const sim::Vec3Array<double>& f = sheet.work.force;
    for (auto [place, force] : {std::pair{&x.x, &f.x}, {&x.y, &f.y}, {&x.z, &f.z}}) {
        for (std::size_t i = 0; i < place->size(); ++i) {
            const double at = (*place)[i];
            (*place)[i] = at + h;
            const double after = energy(x);
            (*place)[i] = at - h;
            const double before = energy(x);
            (*place)[i] = at;
            REQUIRE_THAT(-(after - before) / (2 * h), WithinAbs((*force)[i], 1e-6 * largest));
        }
    }
}

/// The largest deviation of the total energy over half a second of a swinging cloth. The velocity of a moment is that
/// of the two steps around it, without which kinetic and potential energy are half a step apart.
double energy_drift(int substeps) {
    sim::Description description = bare_cloth(6, 6);
    description.cloth.ks = 100;
    description.cloth.pinned = {{0, 0}, {5, 0}};
    description.stepping.gravity = {0, -9.8, 0};
    description.stepping.frames_per_second = 100;
    description.stepping.substeps = substeps;
    Sheet<double> sheet(description);
    double first = 0, drift = 0;
    sim::Vec3Array<double> before = sheet.state.previous;
    for (int n = 0; n < 50 * substeps; ++n) {
        const sim::Vec3Array<double> now = sheet.state.position;
        sheet.step();
        double kinetic = 0;
        for (std::size_t i = 0; i < sheet.points(); ++i) {
            const double speed =
                norm(minus(sheet.position(i), Sheet<double>::coordinates(before, i))) / (2 * sheet.model.dt);
            kinetic += 0.5 * sheet.model.mass * speed * speed;
        }
        const double total = kinetic + sim::spring_energy(sheet.model, now) + sim::gravity_energy(sheet.model, now);
        if (n == 1)
            first = total;
        if (n > 1)
            drift = std::max(drift, std::abs(total - first));
        before = now;
    }
    REQUIRE(sheet.position(35).y < 0.5); // it really swung
    return drift;
}

} // namespace

TEST_CASE("Spring forces are minus the gradient of the spring energy, for every set of kinds") {
    const int set = GENERATE(range(1, 8));
    sim::Description description = bare_cloth(6, 5);
    description.cloth.enable_structural = (set & 1) != 0;
    description.cloth.enable_shearing = (set & 2) != 0;
    description.cloth.enable_bending = (set & 4) != 0;
    Sheet<double> sheet = crumpled(description);
    sheet.still_forces();
    sim::add_spring_forces(sheet.model, sheet.state.position, sheet.work.force);
    require_gradient(sheet, [&](const auto& x) { return sim::spring_energy(sheet.model, x); });
}

TEST_CASE("Gravity and further accelerations are minus the gradient of their energy") {
    sim::Description description = bare_cloth(4, 3);
    description.stepping.gravity = {0.3, -9.8, 0};
    description.stepping.accelerations = {{1, 0, -2}, {0, 0.5, 0.1}};
    Sheet<double> sheet = crumpled(description);
    sim::set_gravity_forces(sheet.model, sheet.work.force);
    REQUIRE_THAT(sheet.work.force.y[0], WithinRel(-9.3 * 150.0 / 12, 1e-12));
    require_gradient(sheet, [&](const auto& x) { return sim::gravity_energy(sheet.model, x); });
}

TEST_CASE("Springs pull with no net force or torque") {
    Sheet<double> sheet = crumpled(bare_cloth(7, 5));
    sheet.still_forces();
    sim::add_spring_forces(sheet.model, sheet.state.position, sheet.work.force);
    sim::Vec3 force, torque;
    double largest = 0;
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 x = sheet.position(i), f = Sheet<double>::coordinates(sheet.work.force, i);
        force = {force.x + f.x, force.y + f.y, force.z + f.z};
        torque = {torque.x + x.y * f.z - x.z * f.y, torque.y + x.z * f.x - x.x * f.z, torque.z + x.x * f.y - x.y * f.x};
        largest = std::max(largest, norm(f));
    }
    REQUIRE(largest > 1);
    REQUIRE(norm(force) < 1e-12 * largest);
    REQUIRE(norm(torque) < 1e-12 * largest);
}

TEST_CASE("A spring of length zero pulls nowhere") {
    Sheet<double> sheet(bare_cloth(2, 2));
    for (std::size_t i = 0; i < 4; ++i)
        sheet.place(i, {0.2, 0.3, 0.4});
    sheet.still_forces();
    sim::add_spring_forces(sheet.model, sheet.state.position, sheet.work.force);
    for (std::size_t i = 0; i < 4; ++i)
        REQUIRE(Sheet<double>::coordinates(sheet.work.force, i) == sim::Vec3{});
    REQUIRE(sim::spring_energy(sheet.model, sheet.state.position) > 0);
}

TEST_CASE("The energy of an undamped swinging cloth is kept to second order in the step") {
    const double coarse = energy_drift(20), fine = energy_drift(40);
    REQUIRE(fine > 0);
    REQUIRE(coarse / fine > 3.5);
    REQUIRE(coarse / fine < 4.5);
}

TEST_CASE("Diagnostics report the energies, strain and speed of a state that is known by hand") {
    sim::Description description = bare_cloth(2, 2);
    description.cloth.ks = 100;
    description.cloth.density = 40; // four points of 10 kg
    description.cloth.enable_shearing = description.cloth.enable_bending = false;
    description.stepping.gravity = {0, -10, 0};
    Sheet<double> sheet(description);
    for (std::size_t i = 0; i < 4; ++i) { // stretched by a quarter along x, and rising at 3 m/s
        const sim::Vec3 x = sheet.position(i);
        sheet.put(sheet.state.position, i, {1.25 * x.x, 2, x.z});
        sheet.put(sheet.state.previous, i, {1.25 * x.x, 2 - 3 * sheet.model.dt, x.z});
    }
    const sim::Diagnostics result = sim::diagnose(sheet.model, sheet.state);
    REQUIRE_THAT(result.energy.kinetic, WithinRel(0.5 * 40 * 9, 1e-9));
    REQUIRE_THAT(result.energy.spring, WithinRel(2 * 0.5 * 100 * 0.25 * 0.25, 1e-12));
    REQUIRE_THAT(result.energy.gravity, WithinRel(40.0 * 10 * 2, 1e-12));
    REQUIRE_THAT(result.energy.total(), WithinRel(180 + 6.25 + 800, 1e-9));
    REQUIRE_THAT(result.max_strain, WithinRel(0.25, 1e-12));
    REQUIRE_THAT(result.rms_speed, WithinRel(3, 1e-9));
    REQUIRE(result.status == sim::Status::ok);
}
