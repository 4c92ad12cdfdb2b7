// Finding the borders between regions of a lattice without looking at every point of it.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace clothlab::experiments {

struct LatticePoint {
    std::size_t x, y;
    bool operator==(const LatticePoint&) const = default;
};

struct LatticeSide {
    std::size_t values = 0; ///< at least one
    /// Whether what lies between two values may be taken to be like them; if not, every value is looked at.
    bool continuous = true;
};

struct Lattice {
    LatticeSide x, y;
    std::size_t blocks = 8; ///< of the coarse lattice, along a continuous side
    /// Kinds of one group are less unlike each other: between them, only blocks of more than `fine` steps are divided.
    /// Without it, every kind is a group of its own.
    std::function<int(int kind)> group = {};
    std::size_t fine = 4;
};

/// From point to point, corners included.
struct LatticeBlock {
    std::size_t x0, x1, y0, y1;
};

/// Says what each of some points is.
using LatticeJudge = std::function<std::vector<int>(const std::vector<LatticePoint>&)>;

struct Refined {
    std::vector<LatticePoint> judged; ///< in the order in which they were
    /// Of all points, row by row (y * values of x + x): the place in `judged` of the point that this one is taken to be
    /// like, the nearest corner of the block around it; itself, where it was judged.
    std::vector<std::size_t> like;
    std::vector<int> kind; ///< of all points

    bool was_judged(LatticePoint point, std::size_t columns) const {
        return judged[like[point.y * columns + point.x]] == point;
    }
};

/// Judges a coarse lattice, then divides what has judged points of different kinds in it or on its rim, again and
/// again, until those are next to each other. So a border is followed wherever it leads, into blocks whose corners are
/// alike too: regions (of groups) that at least one judged point lies in are found exactly. One that lies between the
/// points of the coarse lattice altogether is not seen.
Refined refine(const Lattice& lattice, const LatticeJudge& judge);

} // namespace clothlab::experiments
