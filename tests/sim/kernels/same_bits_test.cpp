// The kernels give the bits of the plain loops: every instruction set, one thread or several.
#include <bit>
#include <catch2/catch_template_test_macros.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/generators/catch_generators_range.hpp>
#include <cmath>
#include <limits>

#include "sim/collision/colliders.h"
#include "sim/collision/self_collision.h"
#include "sim/forces/forces.h"
#include "sim/integrators/integrator.h"
#include "sim/simulation.h"
#include "sim/stretch_limit.h"
#include "support/effort.h"
#include "support/every_execution.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// Of -0 and 0 as well; but any NaN is as good as any other.
template <class Real>
bool same_bits(const sim::Vec3Array<Real>& a, const sim::Vec3Array<Real>& b) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < a.size(); ++i) {
            const Real x = a.axes()[axis][i], y = b.axes()[axis][i];
            if (!(x == y && std::signbit(x) == std::signbit(y)) && !(x != x && y != y))
                return false;
        }
    return a.size() == b.size();
}

/// Grids from the smallest to several vectors wide, narrow ones, and some so wide that the sweep's ring is not the
/// narrow one.
sim::Description random_cloth(sim::SplitMix64& random) {
    const auto below = [&](std::uint64_t end) { return static_cast<int>(random.next() % end); };
    sim::Description d;
    d.cloth.num_width_points = below(3) == 0 ? 2 + below(18) : below(8) == 0 ? 90 + below(60) : 2 + below(60);
    d.cloth.num_height_points = 2 + below(40);
    vary_springs(d.cloth, random);
    d.cloth.ks = uniform(random, 20, 2000);
    d.cloth.thickness = uniform(random, 0.3, 1.2) / d.cloth.num_width_points;
    for (int pins = below(4); pins > 0; --pins)
        d.cloth.pinned.push_back({below(static_cast<std::uint64_t>(d.cloth.num_width_points)),
                                  below(static_cast<std::uint64_t>(d.cloth.num_height_points))});
    d.colliders = {sim::Sphere{{0.5, 0.8, 0.4}, 0.25, 0.3}, sim::Plane{{0, 0.7, 0}, {0.1, 1, 0.05}, 0.4}};
    d.stepping.substeps = 1 + below(30);
    d.stepping.seed = below(1000);
    return d;
}

/// Points as they are, or scattered, with some at extreme places.
template <class Real>
void crumple(Sheet<Real>& sheet, sim::SplitMix64& random, bool extremes) {
    const double amount = uniform(random, 0, 2) * static_cast<double>(sheet.model.grid->shortest);
    for (std::size_t i = 0; i < sheet.points(); ++i) {
        const sim::Vec3 x = sheet.position(i), r = uniform_point(random, -amount, amount);
        const sim::Vec3 p = uniform_point(random, -amount / 20, amount / 20);
        Sheet<Real>::put(sheet.state.position, i, {x.x + r.x, x.y + r.y, x.z + r.z});
        Sheet<Real>::put(sheet.state.previous, i, {x.x + r.x + p.x, x.y + r.y + p.y, x.z + r.z + p.z});
    }
    if (!extremes)
        return;
    constexpr double inf = std::numeric_limits<double>::infinity();
    for (const double value : {1e30, -1e30, inf, -inf, std::numeric_limits<double>::quiet_NaN(), 0.0, -0.0, 1e-40})
        Sheet<Real>::put(sheet.state.position, random.next() % sheet.points(), {value, 0.3, value});
}

/// One stage by the plain loops and by every instruction set, from the same random states. On several threads the first
/// has more points than the others, or fewer.
template <class Real, class Stage>
void require_same_stage(std::uint64_t seed, bool extremes, Stage stage) {
    sim::SplitMix64 random(seed);
    const sim::Description description = random_cloth(random);
    Sheet<Real> start(description, exactly(sim::InstructionSet::scalar, 1));
    crumple(start, random, extremes);
    const sim::State<Real> before = start.state;
    const auto expected = stage(start);
    for (const sim::InstructionSet set : supported_sets())
        for (const int threads : {1, 3}) {
            Sheet<Real> sheet(description, exactly(set, threads));
            sheet.state = before;
            for (std::uint64_t i = 0; i < seed % 50; ++i)
                sheet.work.pace.learn(seed % 2 == 0);
            INFO("seed " << seed << ", " << name_of(set) << ", " << threads << " threads, "
                         << description.cloth.num_width_points << " x " << description.cloth.num_height_points);
            REQUIRE(stage(sheet) == expected);
            REQUIRE(same_bits(sheet.state.position, start.state.position));
            REQUIRE(same_bits(sheet.state.previous, start.state.previous));
        }
}

/// Self-collision by the plain loops and by every instruction set, from one state. Returns the number of pushes.
template <class Real>
std::size_t require_same_pushes(const sim::Description& description, Sheet<Real>& plain, int threads) {
    const sim::State<Real> before = plain.state;
    const std::size_t expected = sim::resolve_self_collision(plain.model, plain.state, plain.work);
    for (const sim::InstructionSet set : supported_sets()) {
        Sheet<Real> sheet(description, exactly(set, threads));
        sheet.state = before;
        INFO(name_of(set));
        REQUIRE(sim::resolve_self_collision(sheet.model, sheet.state, sheet.work) == expected);
        REQUIRE(same_bits(sheet.state.position, plain.state.position));
    }
    return expected;
}

constexpr std::uint64_t trials = attempts(120);

template <class Stage>
void require_same_stages(Stage stage) {
    for (std::uint64_t seed = 0; seed < trials; ++seed) {
        require_same_stage<float>(seed, seed % 4 == 3, stage);
        require_same_stage<double>(seed, seed % 4 == 3, stage);
    }
}

} // namespace

TEST_CASE("Forces by kernels have the bits of the plain loops, whatever the grid, the springs and the positions",
          "[threads]") {
    require_same_stages([](auto& sheet) {
        sim::evaluate_forces(sheet.model, sheet.state, sheet.work);
        sheet.state.position = sheet.work.force; // which is compared
        return 0u;
    });
}

TEST_CASE("Verlet steps by kernels have the bits of the plain loops, and move no pinned point", "[threads]") {
    require_same_stages([](auto& sheet) {
        sim::StepCounts counts;
        sim::integrate(sheet.model, sheet.state, sheet.work, counts);
        return 0u;
    });
}

TEST_CASE("Contacts by kernels have the bits of the plain loops", "[threads]") {
    require_same_stages([](auto& sheet) { return sim::resolve_colliders(sheet.model, sheet.state, sheet.work); });
}

TEST_CASE("The stretch limit by kernels has the bits of the plain sweep, when few springs are long and when most are",
          "[threads]") {
    require_same_stages([](auto& sheet) {
        std::size_t shortened = 0;
        for (int i = 0; i < 3; ++i) // what the first sweep finds decides how the next ones go about it
            shortened += sim::limit_stretch(sheet.model, sheet.state, sheet.work);
        return shortened;
    });
}

TEST_CASE("Self-collision by kernels has the bits of the plain loops", "[threads]") {
    require_same_stages([](auto& sheet) {
        std::size_t pushes = 0;
        for (int i = 0; i < 3; ++i) // again, from where the points are then
            pushes += sim::resolve_self_collision(sheet.model, sheet.state, sheet.work);
        return pushes;
    });
}

TEST_CASE("Self-collision in cells, side by side or one by one, has the bits of the plain loops", "[threads]") {
    require_same_stages([](auto& sheet) {
        std::size_t pushes = 0;
        for (int i = 0; i < 3; ++i) {
            sheet.work.self_collision.list_rests.leave();
            sheet.work.self_collision.dense = i != 1;
            pushes += sim::resolve_self_collision(sheet.model, sheet.state, sheet.work);
        }
        return pushes;
    });
}

TEST_CASE("A force of minus zero stays one: such scenes are left to the plain loops") {
    sim::Description description = bare_cloth(20, 4);
    description.cloth.density = -150;
    description.stepping.gravity = {0.0, -9.8, 0.0};
    for (const sim::InstructionSet set : supported_sets()) {
        Sheet<double> sheet(description, exactly(set, 1));
        sheet.model.enabled = {false, false, false};
        sim::evaluate_forces(sheet.model, sheet.state, sheet.work);
        REQUIRE(std::signbit(sheet.work.force.x[7]));
    }
}

TEST_CASE("Thousands of points in one cell, in few or at one place push each other as the plain loops have it",
          "[threads]") {
    sim::Description description;
    description.cloth.num_width_points = description.cloth.num_height_points = 40;
    description.cloth.thickness = 0.004;
    // At one place, in one cell, in some cells with hundreds each, and in many.
    const double reach = GENERATE(0.0, 0.001, 0.02, 0.15, 0.3);
    const bool with_nan = GENERATE(false, true); // which is in no cell
    Sheet<float> plain(description, exactly(sim::InstructionSet::scalar, 1));
    sim::SplitMix64 random(5);
    for (std::size_t i = 0; i < plain.points(); ++i)
        plain.place(i, uniform_point(random, 0.01, 0.01 + reach));
    if (with_nan)
        plain.place(700, {std::numeric_limits<double>::quiet_NaN(), 0.01, 0.01});
    REQUIRE((reach > 0) == (require_same_pushes(description, plain, 2) > 0));
}

TEMPLATE_TEST_CASE(
    "Who may touch is found in long cells and far out, for cloth that is thin and thicker than its cells", "", float,
    double) {
    sim::Description description;
    description.cloth.num_width_points = 30; // cells of 0.1 m by 0.25 m
    description.cloth.num_height_points = 12;
    description.cloth.thickness = GENERATE(0.0004, 0.01, 0.05, 0.4);
    description.stepping.substeps = GENERATE(1, 2, 30);
    const double far_out = GENERATE(0.0, 300.0);
    // Of one point: among the others, or so far that places hardly tell cells apart, or that they do not: where 2048 by
    // 2048 cells make a layer, those of one layer would look like those of the next.
    const sim::Vec3 stray =
        GENERATE(sim::Vec3{0, 0, 0}, sim::Vec3{20, 20, 20}, sim::Vec3{204.55, 511.6, 0}, sim::Vec3{1e4, 1e4, 1e4});
    Sheet<TestType> plain(description, exactly(sim::InstructionSet::scalar, 1));
    const auto out_there = [&](sim::Vec3 v) { return sim::Vec3{v.x + far_out, v.y + far_out, v.z + far_out}; };
    sim::SplitMix64 random(7);
    for (std::size_t i = 0; i < plain.points(); ++i)
        plain.place(i, out_there(uniform_point(random, -0.2, 0.2)));
    plain.place(99, out_there(stray));
    const std::size_t pushes = require_same_pushes(description, plain, 1);
    REQUIRE((pushes > 0) == (description.cloth.thickness > 0.001));
}

TEST_CASE("A push that is suddenly farther than any before touches whom it reaches", "[threads]") {
    sim::Description description;
    description.cloth.num_width_points = 24;
    description.cloth.num_height_points = 20;
    description.cloth.thickness = 0.4 / 24;
    description.stepping.substeps = 4;
    const double apart = 2 * description.cloth.thickness;
    Sheet<float> plain(description, exactly(sim::InstructionSet::scalar, 1));
    std::vector<Sheet<float>> others;
    for (const sim::InstructionSet set : supported_sets())
        if (set != sim::InstructionSet::scalar)
            others.emplace_back(description, exactly(set, 2));
    constexpr std::size_t pushed = 130, pusher = 131, reached = 154;
    const sim::Vec3 middle{2.5 * plain.model.cell_x, 1.5 * plain.model.cell_y, 2.5 * plain.model.cell_z};
    const auto beside = [&](double x) { return sim::Vec3{middle.x + x * apart, middle.y, middle.z}; };
    for (int step = 0; step < 120; ++step) {
        for (std::size_t i = 0; i < plain.points(); ++i) // out of each other's reach
            plain.place(i, {static_cast<double>(i % 24) / 15, 1, static_cast<double>(i / 24) / 15});
        // Two that hardly touch, for long; then they nearly coincide, and push one against a third.
        const bool sudden = step == 119;
        plain.place(pushed, middle);
        plain.place(pusher, beside(sudden ? 0.02 : 0.999));
        plain.place(reached, beside(sudden ? -1.2 : -5));
        const sim::State<float> before = plain.state;
        const std::size_t expected = sim::resolve_self_collision(plain.model, plain.state, plain.work);
        REQUIRE(expected == (sudden ? 3 : 2)); // the third is touched when its turn comes, the first was before it
        for (Sheet<float>& sheet : others) {
            sheet.state = before;
            INFO("step " << step);
            REQUIRE(sim::resolve_self_collision(sheet.model, sheet.state, sheet.work) == expected);
            REQUIRE(same_bits(sheet.state.position, plain.state.position));
        }
    }
}

TEST_CASE("The list with a skin misses no contact while two sheets slide past each other, far out as well",
          "[threads]") {
    sim::Description description;
    description.cloth.num_width_points = 24;
    description.cloth.num_height_points = 20;
    description.cloth.thickness = 0.4 / 24;
    const double far_out = GENERATE(0.0, 40.0);
    const double speed = GENERATE(1e-4, 2e-3, 2e-2); // m per step: lists that last, that do not, and that are given up
    Sheet<float> plain(description, exactly(sim::InstructionSet::scalar, 1));
    std::vector<Sheet<float>> others;
    for (const sim::InstructionSet set : supported_sets())
        if (set != sim::InstructionSet::scalar)
            others.emplace_back(description, exactly(set, 2));
    sim::SplitMix64 random(11);
    std::size_t pushes = 0;
    for (int step = 0; step < 200; ++step) {
        for (std::size_t i = 0; i < plain.points(); ++i) {
            // The upper half of the rows lies over the lower one and comes down on it while it moves across.
            const bool upper = i >= plain.points() / 2;
            const double row = static_cast<double>((i / 24) % 10), column = static_cast<double>(i % 24);
            const sim::Vec3 r = uniform_point(random, -1e-4, 1e-4);
            plain.place(i, {far_out + column / 23 + (upper ? speed * (step % 20) : 0) + r.x,
                            far_out + (upper ? 0.06 - 0.0004 * step : 0) + r.y, row / 19 + r.z});
        }
        const sim::State<float> before = plain.state;
        const std::size_t expected = sim::resolve_self_collision(plain.model, plain.state, plain.work);
        pushes += expected;
        for (Sheet<float>& sheet : others) {
            sheet.state = before;
            INFO("step " << step);
            REQUIRE(sim::resolve_self_collision(sheet.model, sheet.state, sheet.work) == expected);
            REQUIRE(same_bits(sheet.state.position, plain.state.position));
        }
    }
    REQUIRE(pushes > 1000);
}
