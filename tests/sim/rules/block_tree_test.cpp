// The hierarchy of boxes against all pairs of cells.
#include "sim/collision/block_tree.h"

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <vector>

#include "support/sheet.h"

using namespace clothlab;
using namespace clothlab::test;

TEST_CASE("The block tree finds every pair of cells with near boxes once, and no others") {
    for (const auto& size : {std::pair{2, 2}, {2, 9}, {5, 5}, {6, 9}, {17, 12}})
        for (const double reach : {0.0, 0.05, 0.4, 100.0}) {
            const int columns = size.first, rows = size.second;
            sim::SplitMix64 random(static_cast<std::uint64_t>(columns));
            sim::Vec3Array<double> x;
            x.resize(static_cast<std::size_t>(columns * rows));
            for (auto* axis : {&x.x, &x.y, &x.z})
                for (double& v : *axis)
                    v = uniform(random, -2, 2);
            sim::BlockTree<double> tree;
            tree.resize(columns, rows);
            tree.fit(x);
            const int cells = (columns - 1) * (rows - 1);
            const auto number = [&](sim::GridBlock b) { return b.row * (columns - 1) + b.column; };
            std::vector<std::pair<int, int>> found, expected;
            tree.for_near_cells(reach, [&](sim::GridBlock a, sim::GridBlock b) {
                found.emplace_back(std::minmax(number(a), number(b)));
            });
            const auto near_along = [&](const auto& axis, int a, int b) {
                const auto range = [&](int cell) {
                    const auto i = static_cast<std::size_t>(cell / (columns - 1) * columns + cell % (columns - 1));
                    const auto below = i + static_cast<std::size_t>(columns);
                    return std::minmax({axis[i], axis[i + 1], axis[below], axis[below + 1]});
                };
                const auto [low_a, high_a] = range(a);
                const auto [low_b, high_b] = range(b);
                return low_a - reach <= high_b && low_b - reach <= high_a;
            };
            for (int a = 0; a < cells; ++a)
                for (int b = a + 1; b < cells; ++b)
                    if (near_along(x.x, a, b) && near_along(x.y, a, b) && near_along(x.z, a, b))
                        expected.emplace_back(a, b);
            std::sort(found.begin(), found.end());
            std::sort(expected.begin(), expected.end());
            REQUIRE(found == expected);
        }
}
