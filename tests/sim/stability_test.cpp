// Course Verlet on both sides of its stability limit omega dt = 2 sqrt(1 - d/2), d the damping per step.
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include "sim/diagnostics.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;

namespace {

/// The largest eigenvalue of the flat sheet's stiffness over ks, by power iteration on its springs: omega^2 = this
/// ks/m.
double stiffest_mode(const Sheet<double>& sheet, double ks) {
    const std::size_t n = sheet.points();
    std::vector<sim::Vec3> v(n), kv(n);
    sim::SplitMix64 random(1);
    for (sim::Vec3& x : v)
        x = uniform_point(random, -1, 1);
    double eigenvalue = 0;
    for (int i = 0; i < 3000; ++i) {
        std::fill(kv.begin(), kv.end(), sim::Vec3{});
        sheet.for_each_pulling_spring([&](std::uint32_t a, std::uint32_t b, std::size_t s) {
            const sim::Vec3 d = minus(sheet.position(b), sheet.position(a));
            const double pull = sheet.model.spring_constant(s) / ks * dot(d, minus(v[b], v[a])) / dot(d, d);
            kv[a] = {kv[a].x - pull * d.x, kv[a].y - pull * d.y, kv[a].z - pull * d.z};
            kv[b] = {kv[b].x + pull * d.x, kv[b].y + pull * d.y, kv[b].z + pull * d.z};
        });
        double square = 0;
        for (const sim::Vec3& x : kv)
            square += dot(x, x);
        eigenvalue = std::sqrt(square);
        for (std::size_t k = 0; k < n; ++k)
            v[k] = {kv[k].x / eigenvalue, kv[k].y / eigenvalue, kv[k].z / eigenvalue};
    }
    return eigenvalue;
}

/// A flat 20 x 20 sheet, its stiffness such that omega dt of its stiffest mode is `share` of the limit, a little
/// perturbed in its plane.
Sheet<double> sheet_near_limit(double share, double damping_percent, bool pinned) {
    sim::Description description = bare_cloth(20, 20);
    description.cloth.damping = damping_percent;
    if (pinned)
        description.cloth.pinned = {{0, 0}, {19, 0}};
    const double y = share * 2 * std::sqrt(1 - damping_percent / 100 / 2);
    const double dt = sim::step_length(description);
    description.cloth.ks = sim::point_mass(description.cloth) * y * y / (7.944 * dt * dt);
    Sheet<double> sheet(description);
    sim::SplitMix64 random(2);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        if (sheet.model.pinned[i])
            continue;
        const sim::Vec3 x = sheet.position(i);
        const double rx = uniform(random, -1e-6, 1e-6), rz = uniform(random, -1e-6, 1e-6);
        sheet.place(i, {x.x + rx, x.y, x.z + rz});
    }
    return sheet;
}

double largest_displacement(const Sheet<double>& sheet) {
    double largest = 0;
    for (std::size_t i = 0; i < sheet.points(); ++i)
        largest = std::max(largest, norm(minus(sheet.position(i), Sheet<double>::coordinates(sheet.start, i))));
    return largest;
}

} // namespace

TEST_CASE("The stiffest mode of a free sheet with all springs approaches omega^2 = 8 ks/m") {
    const auto mode = [](int n) { return stiffest_mode(Sheet<double>(bare_cloth(n, n)), 5000); };
    REQUIRE_THAT(mode(5), WithinAbs(7.063, 1e-3));
    REQUIRE_THAT(mode(10), WithinAbs(7.770, 1e-3));
    REQUIRE_THAT(mode(20), WithinAbs(7.944, 1e-3));
}

TEST_CASE("Two percent below the stability limit a flat sheet stays where it is") {
    Sheet<double> sheet = sheet_near_limit(0.98, GENERATE(0.0, 0.2, 50.0), GENERATE(false, true));
    for (int i = 0; i < 3000; ++i)
        sheet.step();
    REQUIRE(largest_displacement(sheet) < 1e-4);
    const sim::Diagnostics result = sim::diagnose(sheet.model, sheet.state);
    REQUIRE(result.status == sim::Status::ok);
    REQUIRE(result.cause.empty());
}

TEST_CASE("Two percent above the stability limit a flat sheet blows up, and the stiffness is named as the cause") {
    Sheet<double> sheet = sheet_near_limit(1.02, GENERATE(0.0, 0.2), GENERATE(false, true));
    sim::Diagnostics result;
    int steps = 0;
    while (steps < 3000 && result.status == sim::Status::ok) {
        sheet.step();
        ++steps;
        result = sim::diagnose(sheet.model, sheet.state);
    }
    INFO(steps << " steps: " << result.cause);
    REQUIRE(steps > 10); // the perturbation has to grow first
    REQUIRE(result.status == sim::Status::diverged);
    REQUIRE_THAT(result.cause, ContainsSubstring("ks is too stiff"));
    REQUIRE_THAT(result.cause, ContainsSubstring("omega dt"));
}

TEST_CASE(
    "Strong damping lowers the limit to 2 sqrt(1 - d/2): above it the flat sheet is unstable, if only to a jitter") {
    // With d = 0.5 what grows is lost again once springs are stretched as much as compressed: it does not reach
    // infinity.
    Sheet<double> sheet = sheet_near_limit(1.02, 50, GENERATE(false, true));
    for (int i = 0; i < 300; ++i)
        sheet.step();
    REQUIRE(largest_displacement(sheet) > 1e-3); // from 1e-6; a limit of 2 would have let it die out
}

TEST_CASE("A cloth a hundred times its own size has diverged, one that is large or far away has not") {
    Sheet<double> sheet(bare_cloth(5, 5));
    const auto status = [&](double scale, double fallen) {
        for (std::size_t i = 0; i < sheet.points(); ++i) {
            const sim::Vec3 x = Sheet<double>::coordinates(sheet.start, i);
            sheet.place(i, {scale * x.x, x.y - fallen, scale * x.z});
        }
        return sim::diagnose(sheet.model, sheet.state).status;
    };
    REQUIRE(status(1, 0) == sim::Status::ok);
    REQUIRE(status(1, 1e6) == sim::Status::ok);
    REQUIRE(status(50, 0) == sim::Status::ok);
    REQUIRE(status(110, 0) == sim::Status::diverged);
    REQUIRE(status(1e20, 0) == sim::Status::diverged);
}

TEST_CASE("The number of substeps that the diagnosis asks for is enough") {
    sim::Description description = bare_cloth(20, 20);
    description.cloth.ks = 3e6;
    Sheet<double> sheet(description);
    sheet.place(210, {0.5264, 1, 0.5263});
    for (int i = 0; i < 300; ++i)
        sheet.step();
    const std::string cause = sim::diagnose(sheet.model, sheet.state).cause;
    INFO(cause);
    const std::size_t at = cause.find("; ");
    REQUIRE(at != std::string::npos);
    const int enough = std::stoi(cause.substr(at + 2));
    REQUIRE(enough > 30);
    for (const int substeps : {enough, enough * 9 / 10}) {
        description.stepping.substeps = substeps;
        Sheet<double> other(description);
        other.place(210, {0.5264, 1, 0.5263});
        for (int i = 0; i < 3000; ++i)
            other.step();
        const bool ok = sim::diagnose(other.model, other.state).status == sim::Status::ok;
        REQUIRE(ok == (substeps == enough));
    }
}
