// Conjugate gradients on the stencil against the same system written out and solved by Eigen.
#include <Eigen/Dense>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>

#include "sim/forces/forces.h"
#include "support/sheet.h"
#include "support/spring_hessian.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

Eigen::Vector3d vector(const sim::Vec3& v) {
    return {v.x, v.y, v.z};
}

/// A crumpled, moving cloth with a pin, some of its springs stretched and some compressed.
Sheet<double> crumpled(int substeps, sim::DampingRule damping) {
    sim::Description d = bare_cloth(6, 5);
    d.cloth.pinned = {{0, 0}};
    d.stepping.integrator = sim::IntegratorId::linearised_euler;
    d.stepping.substeps = substeps;
    d.stepping.tolerance = 1e-13;
    d.stepping.gravity = {0, -9.8, 0};
    d.rules.damping = damping;
    Sheet<double> sheet(d);
    sim::SplitMix64 random(3);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        if (sheet.model.pinned[i])
            continue;
        const sim::Vec3 x = sheet.position(i), by = uniform_point(random, -0.05, 0.05);
        sheet.place(i, {x.x + by.x, x.y + by.y, x.z + by.z});
        Sheet<double>::put(sheet.state.velocity, i, uniform_point(random, -1, 1));
    }
    return sheet;
}

/// What a step of the linearised method adds to the positions: (a I + K) delta = F + m v / dt.
Eigen::VectorXd assembled(Sheet<double>& sheet) {
    const double dt = sheet.model.dt, m = sheet.model.mass, a = m * (1 + sheet.model.damping_rate * dt) / (dt * dt);
    Eigen::MatrixXd matrix = spring_hessian(sheet, Compressed::only_along);
    matrix.diagonal().array() += a;
    sim::Vec3Array<double> force;
    sim::evaluate_conservative_forces(sheet.model, sheet.state.position, sheet.work, force);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(matrix.rows());
    for (std::size_t i = 0; i < sheet.points(); ++i)
        if (!sheet.model.pinned[i])
            right.segment<3>(3 * static_cast<Eigen::Index>(i)) =
                vector(Sheet<double>::coordinates(force, i)) +
                m / dt * vector(Sheet<double>::coordinates(sheet.state.velocity, i));
    return matrix.ldlt().solve(right);
}

} // namespace

TEST_CASE("A linear step of the implicit methods is Eigen's solution of the assembled system") {
    const int substeps = GENERATE(1, 30);
    const auto damping = GENERATE(sim::DampingRule::cs184, sim::DampingRule::physical);
    Sheet<double> sheet = crumpled(substeps, damping);
    const sim::Vec3Array<double> before = sheet.state.position;
    const Eigen::VectorXd expected = assembled(sheet);
    const sim::StepCounts counts = sheet.step();
    CHECK(counts.force_evaluations == 1);
    CHECK(counts.solver_iterations > 3);
    CHECK(counts.solver_iterations <= 3 * sheet.points());
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const Eigen::Vector3d moved = vector(minus(sheet.position(i), Sheet<double>::coordinates(before, i)));
        const Eigen::Vector3d wanted = expected.segment<3>(3 * static_cast<Eigen::Index>(i));
        REQUIRE((moved - wanted).norm() < 1e-11 * expected.norm());
    }
}
