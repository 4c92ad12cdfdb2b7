// Blocks of cloth that need not be looked at for self-collision, and the way through cells where most points touch.
#include "sim/collision/regular_blocks.h"

#include <algorithm>
#include <array>
#include <catch2/catch_template_test_macros.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "sim/collision/self_collision.h"
#include "support/effort.h"
#include "support/every_execution.h"
#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// Cloth with points one apart.
struct Surface {
    const char* what;
    sim::Vec3 (*at)(double column, double row);
    double most; ///< share of the points that are looked at, of 100 x 90
};

/// Rolled up as a paper is, its layers so far apart.
sim::Vec3 roll(double column, double row, double between) {
    const double angle = std::sqrt(4 * std::numbers::pi * column / between + 400);
    const double radius = between * angle / (2 * std::numbers::pi);
    return {radius * std::cos(angle), row, radius * std::sin(angle)};
}

const std::array surfaces{
    Surface{"flat",
            [](double c, double r) {
                return sim::Vec3{c, 0, r};
            },
            0},
    Surface{"flat, sheared and tilted",
            [](double c, double r) {
                return sim::Vec3{c + 0.5 * r, 0.4 * c, r};
            },
            0},
    Surface{"gently bent",
            [](double c, double r) {
                return sim::Vec3{c, 20 * std::sin(c / 25), r - c / 9};
            },
            0},
    Surface{"rough, out of its plane",
            [](double c, double r) {
                return sim::Vec3{c, std::sin(571 * c + 333 * r), r};
            },
            0},
    Surface{"rolled up loosely", [](double c, double r) { return roll(c, r, 9); }, 0.9},
    Surface{"rolled up tightly", [](double c, double r) { return roll(c, r, 0.9); }, 1},
    Surface{"folded once",
            [](double c, double r) {
                return sim::Vec3{c < 70 ? c : 140 - c, c < 70 ? 0 : 0.8, r};
            },
            0.9},
    Surface{"a crumpled corner",
            [](double c, double r) {
                const bool crumpled = c < 7 && r < 20;
                return sim::Vec3{c, crumpled ? 3 * std::sin(3 * c * r) : 0, crumpled ? r + std::sin(c * c) : r};
            },
            0.15},
    Surface{"two ends that meet",
            [](double c, double r) {
                const double angle = 2 * std::numbers::pi * c / 100;
                return sim::Vec3{15.4 * std::cos(angle), r, 15.4 * std::sin(angle)};
            },
            1},
    // Nearer than the reach are then two columns or rows of different blocks, ...
    Surface{"pushed together at a column",
            [](double c, double r) {
                return sim::Vec3{c < 32 ? c : c - 0.2, 0, r};
            },
            0.4},
    Surface{"pushed together at a row",
            [](double c, double r) {
                return sim::Vec3{c, 0, r < 32 ? r : r - 0.2};
            },
            0.4},
    // ... or diagonal neighbours alone: everywhere, and every other row.
    Surface{"sheared so far",
            [](double c, double r) {
                return sim::Vec3{c - 0.75 * r, 0, 0.66 * r};
            },
            1},
    Surface{"in zigzag",
            [](double c, double r) {
                return sim::Vec3{c + (std::fmod(r, 2) < 0.5 ? 0 : 0.7), 0, 0.75 * r};
            },
            1},
};

template <class Real>
sim::Vec3Array<Real> place(const Surface& surface, int columns, int rows) {
    sim::Vec3Array<Real> x;
    x.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            Sheet<Real>::put(x, static_cast<std::size_t>(row * columns + column), surface.at(column, row));
    return x;
}

/// Whether the kernels of a set prove something, and of which points they do not.
template <class Real>
bool look(const sim::Vec3Array<Real>& x, int columns, int rows, double reach, sim::InstructionSet set,
          std::vector<bool>& looked_at) {
    sim::RegularBlocks<Real> blocks;
    blocks.resize(static_cast<std::size_t>(columns), static_cast<std::size_t>(rows));
    REQUIRE(blocks.usable());
    // By two threads.
    const std::size_t half = blocks.block_rows() / 2;
    for (const auto& [begin, end] : {std::pair{half, blocks.block_rows()}, {std::size_t{0}, half}})
        blocks.fit(*sim::kernels<Real>(set), x.axes(), static_cast<Real>(reach * reach), begin, end);
    if (!blocks.finish())
        return false;
    const bool pays = blocks.find(reach);
    looked_at.assign(x.size(), false);
    for (const sim::PointSpan span : blocks.points())
        std::fill(looked_at.begin() + span.begin, looked_at.begin() + span.end, true);
    REQUIRE(static_cast<std::size_t>(std::count(looked_at.begin(), looked_at.end(), true)) == blocks.points().points);
    return pays;
}

std::vector<sim::InstructionSet> vector_sets() {
    std::vector<sim::InstructionSet> sets = supported_sets();
    std::erase(sets, sim::InstructionSet::scalar);
    return sets;
}

} // namespace

TEMPLATE_TEST_CASE("Every two points that are near each other are in blocks that are looked at", "", float, double) {
    const double reach = GENERATE(0.93, 1.3);
    for (const auto& [columns, rows] : {std::pair{sanitized ? 34 : 100, sanitized ? 40 : 90}, {17, 2}, {48, 33}})
        for (const Surface& surface : surfaces) {
            const auto x = place<TestType>(surface, columns, rows);
            std::vector<std::pair<std::size_t, std::size_t>> near;
            for (std::size_t i = 0; i < x.size(); ++i)
                for (std::size_t k = i + 1; k < x.size(); ++k) {
                    const auto dx = x.x[i] - x.x[k], dy = x.y[i] - x.y[k], dz = x.z[i] - x.z[k];
                    if (static_cast<double>(dx * dx + dy * dy + dz * dz) < reach * reach)
                        near.emplace_back(i, k);
                }
            for (const sim::InstructionSet set : vector_sets()) {
                std::vector<bool> looked_at;
                INFO(surface.what << ", " << columns << " x " << rows << ", " << name_of(set) << ", reach " << reach);
                if (look(x, columns, rows, reach, set, looked_at)) // otherwise all are
                    for (const auto& [i, k] : near)
                        REQUIRE((looked_at[i] && looked_at[k]));
            }
        }
}

TEST_CASE("Flat, sheared, gently bent and rough cloth need no look, a fold or a corner little more than itself") {
    for (const Surface& surface : surfaces) {
        const auto x = place<float>(surface, 100, 90);
        for (const sim::InstructionSet set : vector_sets()) {
            std::vector<bool> looked_at;
            look(x, 100, 90, 0.93, set, looked_at);
            const auto count = static_cast<double>(std::count(looked_at.begin(), looked_at.end(), true));
            INFO(surface.what << ", " << name_of(set) << ": " << count / 9000);
            CHECK(count <= surface.most * 9000);
        }
    }
}

TEST_CASE("Of cloth with a point that is not finite, and of narrow cloth, blocks say nothing") {
    for (const double value :
         {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::quiet_NaN(), 1e30})
        for (const std::size_t at : {0u, 16u, 31u, 32u, 33u * 16, 33u * 40 + 32, 33u * 41 - 1})
            for (const sim::InstructionSet set : vector_sets()) {
                auto x = place<float>(surfaces[0], 33, 41);
                x.y[at] = static_cast<float>(value);
                std::vector<bool> looked_at;
                REQUIRE(!look(x, 33, 41, 0.93, set, looked_at));
            }
    sim::RegularBlocks<float> blocks;
    blocks.resize(16, 100);
    REQUIRE(!blocks.usable());
    blocks.resize(100, 1);
    REQUIRE(!blocks.usable());
}

TEMPLATE_TEST_CASE("Self-collision of folds in cloth that is otherwise smooth has the bits of the plain loops",
                   "[threads]", float, double) {
    sim::Description description;
    description.cloth.num_width_points = 90;
    description.cloth.num_height_points = 75;
    description.cloth.thickness = 0.8 / 2 / 90;
    const double far_out = GENERATE(0.0, 30.0);
    Sheet<TestType> plain(description, exactly(sim::InstructionSet::scalar, 1));
    std::vector<Sheet<TestType>> others;
    for (const sim::InstructionSet set : vector_sets())
        for (const int threads : {1, 3})
            others.emplace_back(description, exactly(set, threads));
    std::size_t pushes = 0, left_out = 0;
    sim::SplitMix64 random(3);
    for (int step = 0; step < 40; step += sanitized ? 8 : 1) {
        for (std::size_t i = 0; i < plain.points(); ++i) {
            // The last columns come over the ones before; the whole falls and trembles.
            const double column = static_cast<double>(i % 90), row = static_cast<double>(i / 90);
            const bool over = column > 75;
            const sim::Vec3 r = uniform_point(random, -0.05, 0.05);
            plain.place(i, {far_out + ((over ? 150 - column : column) + r.x) / 90,
                            far_out - 0.001 * step + ((over ? 1.2 - 0.02 * step : 0) + r.y) / 90, (row + r.z) / 75});
        }
        const sim::State<TestType> before = plain.state;
        const std::size_t expected = sim::resolve_self_collision(plain.model, plain.state, plain.work);
        pushes += expected;
        for (Sheet<TestType>& sheet : others) {
            sheet.state = before;
            sheet.work.self_collision.list_rests.leave();
            REQUIRE(sim::resolve_self_collision(sheet.model, sheet.state, sheet.work) == expected);
            REQUIRE(sheet.state.position.x == plain.state.position.x);
            REQUIRE(sheet.state.position.y == plain.state.position.y);
            REQUIRE(sheet.state.position.z == plain.state.position.z);
            left_out += sheet.points() - sheet.work.self_collision.blocks.points().points;
        }
    }
    REQUIRE(pushes > 100);
    REQUIRE(left_out > others.size() * plain.points()); // at least in some steps; all of a step's at the start
}
