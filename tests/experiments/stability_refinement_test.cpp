// Borders are found by looking at few points of a lattice.
#include <catch2/catch_test_macros.hpp>
#include <set>

#include "experiments/stability/refinement.h"

using namespace clothlab::experiments;

namespace {

using Rule = std::function<int(std::size_t x, std::size_t y)>;

LatticeJudge judge_by(const Rule& rule) {
    return [rule](const std::vector<LatticePoint>& points) {
        std::vector<int> kinds;
        for (const LatticePoint& p : points)
            kinds.push_back(rule(p.x, p.y));
        return kinds;
    };
}

std::vector<int> full(const Lattice& lattice, const Rule& rule) {
    std::vector<int> kinds;
    for (std::size_t y = 0; y < lattice.y.values; ++y)
        for (std::size_t x = 0; x < lattice.x.values; ++x)
            kinds.push_back(rule(x, y));
    return kinds;
}

int disc(std::size_t x, std::size_t y, double cx, double cy, double r) {
    const double dx = static_cast<double>(x) - cx, dy = static_cast<double>(y) - cy;
    return dx * dx + dy * dy < r * r ? 1 : 0;
}

} // namespace

TEST_CASE("A refined lattice is the full one, point by point, for a fifth of its runs or less") {
    const Lattice lattice{{64, true}, {64, true}};
    const Rule rules[] = {
        [](std::size_t x, std::size_t y) { return 3 * y > x * x / 20 + 30 ? 1 : 0; },
        [](std::size_t x, std::size_t y) { return x + y > 70 ? 1 : 0; },
        [](std::size_t x, std::size_t) { return x > 12 ? 1 : 0; },
        [](std::size_t x, std::size_t y) { return disc(x, y, 30, 33, 12.3); },
    };
    for (const Rule& rule : rules) {
        const Refined refined = refine(lattice, judge_by(rule));
        INFO(refined.judged.size() << " runs");
        REQUIRE(refined.kind == full(lattice, rule));
        REQUIRE(5 * refined.judged.size() <= refined.kind.size());
    }
}

TEST_CASE("No point is judged twice, and others are like a run of their own kind") {
    const Rule rule = [](std::size_t x, std::size_t y) { return disc(x, y, 10, 40, 25); };
    const Lattice lattice{{50, true}, {61, true}};
    const Refined refined = refine(lattice, judge_by(rule));
    std::set<std::size_t> places;
    for (std::size_t i = 0; i < refined.judged.size(); ++i) {
        const LatticePoint p = refined.judged[i];
        REQUIRE(places.insert(p.y * 50 + p.x).second);
        REQUIRE(refined.was_judged(p, 50));
        REQUIRE(refined.like[p.y * 50 + p.x] == i);
    }
    for (std::size_t i = 0; i < refined.kind.size(); ++i) {
        const LatticePoint like = refined.judged[refined.like[i]];
        REQUIRE(rule(like.x, like.y) == refined.kind[i]);
    }
}

TEST_CASE("A border is followed into blocks whose corners are alike, however it winds") {
    // A wave that leaves the blocks of its corners' kind between two of them.
    const Rule wave = [](std::size_t x, std::size_t y) {
        const std::size_t in = x % 8, height = 30 + (in > 1 && in < 7 ? 5 : 0);
        return y > height ? 1 : 0;
    };
    const Lattice lattice{{65, true}, {65, true}};
    REQUIRE(refine(lattice, judge_by(wave)).kind == full(lattice, wave));
}

TEST_CASE("An island between the points of the coarse lattice is not seen, and a finer coarse lattice sees it") {
    const Rule island = [](std::size_t x, std::size_t y) { return disc(x, y, 20, 20, 3); };
    Lattice lattice{{65, true}, {65, true}};
    REQUIRE(refine(lattice, judge_by(island)).kind != full(lattice, island));
    lattice.blocks = 16;
    REQUIRE(refine(lattice, judge_by(island)).kind == full(lattice, island));
}

TEST_CASE("Along a side of things every value is looked at") {
    const Rule stripes = [](std::size_t x, std::size_t y) { return x % 2 == 0 && y > 20 ? 1 : 0; };
    const Lattice lattice{{6, false}, {64, true}};
    const Refined refined = refine(lattice, judge_by(stripes));
    REQUIRE(refined.kind == full(lattice, stripes));
    REQUIRE(refined.judged.size() < 6 * 64 / 3);
}

TEST_CASE("The border between groups is exact even where kinds within a group are speckled") {
    const Rule speckled = [](std::size_t x, std::size_t y) {
        return x + y < 60 ? 0 : 1 + static_cast<int>((x * 7 + y * 13) % 3 / 2);
    };
    Lattice lattice{{64, true}, {64, true}};
    lattice.group = [](int kind) { return kind == 0 ? 0 : 1; };
    const Refined refined = refine(lattice, judge_by(speckled));
    for (std::size_t y = 0; y < 64; ++y)
        for (std::size_t x = 0; x < 64; ++x)
            REQUIRE((refined.kind[y * 64 + x] == 0) == (speckled(x, y) == 0));
    lattice.group = {};
    REQUIRE(refined.judged.size() < refine(lattice, judge_by(speckled)).judged.size());
}
