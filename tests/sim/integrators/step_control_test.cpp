// Dormand-Prince's step control: as accurate as it is asked to be, and never without end.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>

#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

Sheet<double> swinging(double tolerance, int substeps) {
    sim::Description d = bare_cloth(8, 8);
    d.cloth.pinned = {{0, 0}, {7, 0}};
    d.cloth.ks = 1e5;
    d.stepping.integrator = sim::IntegratorId::dormand_prince;
    d.stepping.gravity = {0, -9.8, 0};
    d.stepping.tolerance = tolerance;
    d.stepping.substeps = substeps;
    return Sheet<double>(d);
}

/// The largest distance to a much more accurate run after 0.2 s.
double error(double tolerance) {
    Sheet<double> run = swinging(tolerance, 1), reference = swinging(0, 200);
    for (int frame = 0; frame < 18; ++frame) {
        run.step();
        for (int i = 0; i < 200; ++i)
            reference.step();
    }
    double largest = 0;
    for (std::size_t i = 0; i < run.points(); ++i)
        largest = std::max(largest, norm(minus(run.position(i), reference.position(i))));
    return largest;
}

} // namespace

TEST_CASE("The step control makes a hundred times smaller errors of a hundred times smaller tolerances") {
    const double coarse = error(1e-4), fine = error(1e-6);
    INFO(coarse << " " << fine);
    CHECK(coarse < 1e-3); // m; the spacing is 0.14 m
    CHECK(fine < coarse / 30);
    CHECK(fine > coarse / 3000);
}

TEST_CASE("With a tolerance of 0 a step is one step, of seven force evaluations") {
    Sheet<double> sheet = swinging(0, 30);
    for (int i = 0; i < 10; ++i)
        CHECK(sheet.step().force_evaluations == 7);
}

TEST_CASE("A tolerance that the step control cannot meet costs a thousand of its steps in one and no more") {
    sim::Description d = bare_cloth(5, 5);
    d.cloth.density = -150; // springs push: motion grows without bound
    d.stepping.integrator = sim::IntegratorId::dormand_prince;
    d.stepping.tolerance = 1e-6;
    d.stepping.substeps = 1;
    Sheet<double> sheet(d);
    sheet.place(12, {0.51, 1.01, 0.52});
    std::size_t most = 0;
    for (int i = 0; i < 60; ++i)
        most = std::max(most, sheet.step().force_evaluations);
    CHECK(most > 100);
    CHECK(most < 20000);
}
