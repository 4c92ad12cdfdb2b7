// What the grid of springs is as a continuous sheet: its elastic constants, from the energy per area under a small
// homogeneous strain (M. Born, K. Huang, "Dynamical Theory of Crystal Lattices", section 11), and the speed of its
// longitudinal waves.
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <numbers>

#include "sim/forces/springs.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

struct Strain {
    double xx = 0, zz = 0, xz = 0; ///< of the cloth's plane; xz is half the shear angle
};

constexpr double spacing = 0.1;
constexpr double ks = 5000;

double energy(int columns, int rows, Strain strain) {
    sim::Description description = bare_cloth(columns, rows);
    description.cloth.width = spacing * (columns - 1);
    description.cloth.height = spacing * (rows - 1);
    description.cloth.ks = ks;
    Sheet<double> sheet(description);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 x = sheet.position(i);
        sheet.place(i, {x.x + strain.xx * x.x + strain.xz * x.z, x.y, x.z + strain.xz * x.x + strain.zz * x.z});
    }
    return sim::spring_energy(sheet.model, sheet.state.position);
}

/// J/m² of the inner cloth. The energy of a grid is a + b columns + c rows + d columns rows, so that edges and corners
/// cancel in the mixed difference.
double density(Strain strain) {
    const double cell = energy(9, 8, strain) - energy(8, 8, strain) - energy(9, 7, strain) + energy(8, 7, strain);
    return cell / (spacing * spacing);
}

/// The second derivative of the energy density along a strain, in N/m, in units of ks.
double stiffness(Strain s) {
    const double e = 1e-4;
    const Strain plus{e * s.xx, e * s.zz, e * s.xz}, less{-e * s.xx, -e * s.zz, -e * s.xz};
    return (density(plus) + density(less)) / (e * e) / ks; // without strain there is no energy
}

} // namespace

TEST_CASE("A sheet resists stretching with C11 = 2.8 ks, and stretching across and shear with C12 = C66 = ks") {
    const double c11 = stiffness({.xx = 1}), c22 = stiffness({.zz = 1});
    REQUIRE_THAT(c11, WithinRel(2.8, 1e-6));
    REQUIRE_THAT(c22, WithinRel(2.8, 1e-6));
    REQUIRE_THAT((stiffness({.xx = 1, .zz = 1}) - c11 - c22) / 2, WithinAbs(1, 1e-6)); // C12
    REQUIRE_THAT(stiffness({.xz = 0.5}), WithinAbs(1, 1e-6));                          // C66, of the shear angle 2 xz
    REQUIRE_THAT((stiffness({.xx = 1, .xz = 0.5}) - c11 - 1) / 2, WithinAbs(0, 1e-6)); // C16
}

TEST_CASE("Longitudinal waves in the default material run at sqrt(C11/density) = 9.66 m/s") {
    // A standing wave along z in a free sheet. In the middle it is a plane wave until something could have come from
    // the sides, which are further away than a wave gets in a quarter of the period.
    constexpr int columns = 51, rows = 40;
    sim::Description description = bare_cloth(columns, rows);
    description.cloth.width = columns - 1.0;
    description.cloth.height = rows - 1.0;
    description.cloth.density *= double(columns * rows) / ((columns - 1) * (rows - 1)); // of the inner cloth: 150 kg/m²
    description.stepping.integrator = sim::IntegratorId::velocity_verlet;
    description.stepping.frames_per_second = 40;
    description.stepping.substeps = 1;
    Sheet<double> sheet(description);
    const auto wave = [](int row) { return std::cos(std::numbers::pi * (row + 0.5) / rows); };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const std::size_t i = sheet.at(column, row);
            const sim::Vec3 x = sheet.position(i);
            sheet.place(i, {x.x, x.y, x.z + 1e-3 * wave(row)});
        }
    double before = 0, now = 1;
    int steps = 0;
    for (; now > 0 && steps < 1000; ++steps) {
        sheet.step();
        before = now;
        now = 0;
        for (int row = 0; row < rows; ++row) {
            const std::size_t i = sheet.at(columns / 2, row);
            now += wave(row) * (sheet.position(i).z - sheet.start.z[i]);
        }
    }
    const double quarter = (steps - now / (now - before)) * sheet.model.dt;
    REQUIRE_THAT(rows / (2 * quarter), WithinAbs(9.66, 0.02));
}
