// The stability margin against what is known of this grid, and against Eigen's eigenvalues of the whole matrix.
#include <catch2/catch_template_test_macros.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "sim/integrators/integrator.h"
#include "sim/simulation.h"
#include "sim/spring_operator.h"
#include "sim/stability.h"
#include "support/sheet.h"
#include "support/spring_hessian.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class Real>
sim::StabilityMargin margin_of(const Sheet<Real>& sheet) {
    return sim::stability_margin(sheet.model, sheet.state);
}

/// omega² m / ks, in which cloths of all stiffness and weight are alike.
template <class Real>
double in_springs(const Sheet<Real>& sheet, double omega) {
    return omega * omega * static_cast<double>(sheet.model.mass) / static_cast<double>(sheet.model.k[0]);
}

sim::StabilityMargin margin_of(const sim::Description& description) {
    return sim::Simulation::create(description)->stability();
}

/// Puts every free point anywhere within `size` rest lengths of its start.
template <class Real>
void tangle(Sheet<Real>& sheet, double size, std::uint64_t seed) {
    sim::SplitMix64 random(seed);
    const double rest = static_cast<double>(sheet.model.grid->shortest);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 x = sheet.position(i), r = uniform_point(random, -size * rest, size * rest);
        if (!sheet.model.pinned[i])
            sheet.place(i, {x.x + r.x, x.y + r.y, x.z + r.z});
    }
}

} // namespace

TEST_CASE("The fastest mode of flat free cloth is the known one, and no estimate is below it") {
    const auto mode = [](int n) {
        const Sheet<double> sheet(bare_cloth(n, n));
        return in_springs(sheet, margin_of(sheet).omega);
    };
    REQUIRE_THAT(mode(5), WithinAbs(7.063, 1e-3));
    REQUIRE_THAT(mode(10), WithinAbs(7.770, 1e-3));
    REQUIRE_THAT(mode(20), WithinAbs(7.944, 1e-3));
    REQUIRE_THAT(mode(50), WithinAbs(7.991, 1e-3));
    REQUIRE_THAT(mode(100), WithinAbs(7.998, 1e-3));
}

TEST_CASE("With structural springs only, flat cloth is rows of chains: omega² = 4 ks/m cos²(pi / 2n)") {
    sim::Description description = bare_cloth(2, 2);
    description.cloth.enable_shearing = description.cloth.enable_bending = false;
    for (const int n : {2, 7, 30, 80}) {
        description.cloth.num_width_points = description.cloth.num_height_points = n;
        const Sheet<double> sheet(description);
        const double c = std::cos(std::acos(-1.0) / (2 * n));
        REQUIRE_THAT(in_springs(sheet, margin_of(sheet).omega), WithinRel(4 * c * c, 1e-4));
    }
}

TEST_CASE("Bending springs add nothing to the fastest mode of large flat cloth") {
    sim::Description description = bare_cloth(50, 50);
    const double with = margin_of(Sheet<double>(description)).omega;
    description.cloth.enable_bending = false;
    REQUIRE_THAT(margin_of(Sheet<double>(description)).omega, WithinRel(with, 1e-3)); // borders
}

TEMPLATE_TEST_CASE("Margin: Eigen's largest eigenvalue of the whole matrix, in any pose, with any springs and pins", "",
                   float, double) {
    const int seed = GENERATE(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11);
    sim::Description description = bare_cloth(3 + seed % 4, 5);
    description.cloth.enable_structural = seed % 3 != 1;
    description.cloth.enable_shearing = seed % 4 != 2;
    description.cloth.enable_bending = seed % 2 == 0;
    description.cloth.damping = 0.2;
    if (seed % 2 == 1)
        description.cloth.pinned = {{0, 0}, {2, 3}};
    Sheet<TestType> sheet(description);
    tangle(sheet, seed < 6 ? 0.1 : 2.0, static_cast<std::uint64_t>(seed));
    const double truth = std::sqrt(largest_eigenvalue(sheet) / static_cast<double>(sheet.model.mass));
    const sim::StabilityMargin margin = margin_of(sheet);
    INFO("omega " << margin.omega << ", truth " << truth << ", bound " << margin.omega_bound);
    REQUIRE(margin.omega >= truth * (1 - 1e-12));
    REQUIRE(margin.omega <= truth * (1 + 1e-4));
    REQUIRE(margin.omega <= margin.omega_bound);
    REQUIRE(in_springs(sheet, margin.omega_bound) <= 12 * (1 + 1e-12));
}

TEST_CASE("Springs of a cloth too large to keep them act as their Hessians") {
    sim::Description description = bare_cloth(520, 510);
    description.cloth.pinned = {{0, 0}, {7, 9}};
    Sheet<float> sheet(description);
    tangle(sheet, 0.3, 1);
    sim::SplitMix64 random(2);
    std::vector<double> v(3 * sheet.points()), product(v.size()), expected(v.size(), 0.0);
    for (std::size_t i = 0; i < v.size(); ++i)
        v[i] = sheet.model.pinned[i / 3] ? 0 : random.unit();
    sim::SpringOperator<float>(sheet.model, sheet.state.position).apply(v, product);
    sim::for_each_spring(520, 510, [&](std::size_t a, std::size_t b, std::size_t s) {
        const sim::Vec3 from = sheet.position(a), to = sheet.position(b);
        const std::array<double, 3> d{to.x - from.x, to.y - from.y, to.z - from.z};
        const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), k = s < 4 ? 1 : 0.2;
        const double t = 1 - static_cast<double>(sheet.model.grid->rest_length(s, a)) / length;
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t column = 0; column < 3; ++column) {
                const double n = d[row] * d[column] / (length * length);
                const double f = k * (n + t * ((row == column) - n)) * (v[3 * b + column] - v[3 * a + column]);
                expected[3 * a + row] -= sheet.model.pinned[a] ? 0 : f;
                expected[3 * b + row] += sheet.model.pinned[b] ? 0 : f;
            }
    });
    double error = 0, largest = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        error = std::max(error, std::abs(product[i] - expected[i]));
        largest = std::max(largest, std::abs(expected[i]));
    }
    REQUIRE(largest > 1);
    REQUIRE(error < 1e-12 * largest);
}

TEST_CASE("A pose stretched at random comes close to 12 ks/m, and none goes beyond") {
    Sheet<double> sheet(bare_cloth(20, 20));
    tangle(sheet, 100, 1);
    const sim::StabilityMargin margin = margin_of(sheet);
    REQUIRE(in_springs(sheet, margin.omega) > 9);
    REQUIRE(margin.omega <= margin.omega_bound);
    REQUIRE_THAT(in_springs(sheet, margin.omega_bound), WithinRel(12.0, 1e-12));
}

TEST_CASE("A cloth at its largest dt, largest ks or smallest density is exactly at the limit") {
    const auto damping = GENERATE(sim::DampingRule::cs184, sim::DampingRule::physical);
    const auto integrator = GENERATE(sim::IntegratorId::course_verlet, sim::IntegratorId::rk4);
    sim::Description description = bare_cloth(9, 7);
    description.cloth.damping = 0.2;
    description.cloth.damping_rate = 5000; // so strong that it counts within a step
    description.rules.damping = damping;
    description.stepping.integrator = integrator;
    const sim::StabilityMargin margin = margin_of(description);
    REQUIRE(margin.stable());
    const auto at_limit = [](const sim::Description& d) {
        const sim::StabilityMargin m = margin_of(d);
        return m.omega_dt / m.limit;
    };
    sim::Description other = description;
    other.cloth.ks = margin.ks_max;
    REQUIRE_THAT(at_limit(other), WithinRel(1.0, 1e-12));
    other = description;
    other.cloth.density = margin.density_min;
    REQUIRE_THAT(at_limit(other), WithinRel(1.0, 1e-12));
    other = description;
    other.stepping.frames_per_second = 1 / (margin.dt_max * other.stepping.substeps);
    REQUIRE_THAT(at_limit(other), WithinRel(1.0, 1e-12));
    other = description;
    other.stepping.frames_per_second = 1 / (margin.dt_max * 22.5);
    REQUIRE(margin_of(other).substeps_min == 23);
    other.stepping.substeps = 23;
    REQUIRE(margin_of(other).stable());
    other.stepping.substeps -= 1;
    REQUIRE_FALSE(margin_of(other).stable());
}

TEST_CASE("With damping exact in each step, Verlet's longest step solves omega² dt tanh(c dt / 2) = 2 c") {
    sim::Description description = bare_cloth(6, 6);
    description.rules.damping = sim::DampingRule::physical;
    description.cloth.damping_rate = 3000;
    const sim::StabilityMargin margin = margin_of(description);
    const double c = 3000;
    REQUIRE_THAT(margin.omega * margin.omega * margin.dt_max * std::tanh(c * margin.dt_max / 2),
                 WithinRel(2 * c, 1e-10));
    REQUIRE(margin.dt_max > 2 / margin.omega);
}

TEST_CASE("Methods without a limit have no longest step, and those that always grow have none that is short enough") {
    sim::Description description = bare_cloth(5, 5);
    for (const sim::IntegratorInfo& method : sim::integrators()) {
        INFO(method.name);
        description.stepping.integrator = method.id;
        description.stepping.tolerance = 1e-6;
        if (method.divides_steps)
            REQUIRE(margin_of(description).limit == infinity);
        description.stepping.tolerance = 0; // every step is taken as it is
        const sim::StabilityMargin margin = margin_of(description);
        REQUIRE(margin.limit == method.limit(0));
        if (margin.limit == infinity) {
            REQUIRE(margin.stable());
            REQUIRE((margin.dt_max == infinity && margin.ks_max == infinity));
            REQUIRE((margin.density_min == 0 && margin.substeps_min == 1));
        } else if (margin.limit == 0) {
            REQUIRE_FALSE(margin.stable());
            REQUIRE((margin.dt_max == 0 && margin.ks_max == 0));
            REQUIRE((margin.density_min == infinity && margin.substeps_min == infinity));
        } else {
            REQUIRE_THAT(margin.dt_max, WithinRel(margin.limit / margin.omega, 1e-12));
        }
    }
}

TEST_CASE("Springs that push are unstable whatever the step, and where there are none, nothing is") {
    sim::Description description = bare_cloth(5, 5);
    description.cloth.density = -150;
    sim::StabilityMargin margin = margin_of(description);
    REQUIRE_FALSE(margin.stable());
    REQUIRE(margin.dt_max == 0);
    REQUIRE(margin.substeps_min == infinity);
    REQUIRE(margin.ks_max == 0);
    REQUIRE(margin.density_min > 0); // a weight at which it would do

    description = bare_cloth(5, 5);
    const double ks_max = margin_of(description).ks_max;
    description.cloth.ks = 0;
    margin = margin_of(description);
    REQUIRE(margin.stable());
    REQUIRE(margin.omega == 0);
    REQUIRE(margin.dt_max == infinity);
    REQUIRE_THAT(margin.ks_max, WithinRel(ks_max, 1e-12));

    description = bare_cloth(5, 5);
    description.cloth.enable_structural = description.cloth.enable_shearing = description.cloth.enable_bending = false;
    margin = margin_of(description);
    REQUIRE((margin.stable() && margin.omega == 0 && margin.omega_bound == 0));
    REQUIRE((margin.dt_max == infinity && margin.ks_max == infinity && margin.density_min == 0));
    REQUIRE(margin.substeps_min == 1);

    description = bare_cloth(2, 2);
    description.cloth.pinned = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    REQUIRE(margin_of(description).omega == 0);
}

TEST_CASE("A state that is not finite has no margin") {
    Sheet<float> sheet(bare_cloth(4, 4));
    sheet.place(5, {0, std::numeric_limits<double>::quiet_NaN(), 0});
    const sim::StabilityMargin margin = margin_of(sheet);
    REQUIRE_FALSE(margin.stable());
    REQUIRE(margin.omega == infinity);
    REQUIRE(margin.dt_max == 0);
}

TEST_CASE("A snapshot has the margin when it was asked for, and only then") {
    const auto simulation = sim::Simulation::create(bare_cloth(5, 5));
    simulation->step();
    sim::Snapshot snapshot;
    simulation->capture(snapshot, {.stability = true});
    REQUIRE(snapshot.stability == simulation->stability());
    simulation->capture(snapshot);
    REQUIRE_FALSE(snapshot.stability);
}
