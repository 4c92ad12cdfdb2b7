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
};

/// From point to point, corners included.
struct LatticeBlock {
    std::size_t x0, x1, y0, y1;
};

/// Says what each of some points is.
using LatticeJudge = std::function<std::vector<int>(const std::vector<LatticePoint>&)>;

struct Refined {
    std::vector<LatticePoint> judged;   ///< in the order in which they were
    std::vector<int> kind;              ///< of all points, row by row (y * values of x + x)
    std::vector<std::size_t> judged_as; ///< of all points: a place in `judged`, for those that were not, not_judged
    std::vector<LatticeBlock> blocks;   ///< that were not divided further; of one kind each, or without inner points
};
inline constexpr std::size_t not_judged = static_cast<std::size_t>(-1);

/// Judges a coarse lattice, then divides what has judged points of different kinds in it or on its rim, again and
/// again, until those are next to each other. So a border is followed wherever it leads, into blocks whose corners are
/// alike too: regions that at least one judged point lies in are found exactly. One that lies between the points of the
/// coarse lattice altogether is not seen. A point that was not judged is what the block around it is.
Refined refine(const Lattice& lattice, const LatticeJudge& judge);

} // namespace clothlab::experiments
