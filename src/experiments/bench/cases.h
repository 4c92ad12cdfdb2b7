// The scenes that the bench times, at any size.
#pragma once

#include <string>
#include <vector>

#include "experiments/bench/bench.h"
#include "sim/description.h"

namespace clothlab::experiments {

struct BenchCase {
    std::string name;
    sim::Description description; ///< of as many points as it has
    int frames = 0;               ///< how far it is advanced before it is timed
};

/// All cases, size by size. `pinned` comes first of each size: others are compared with it.
///
/// A cloth of n x n points gets the shipped scene's mass per point, so that the springs need no shorter steps, and a
/// thickness that shrinks with the distance of the points, so that there is as much to find near each of them. What the
/// same motion crumples in so many steps still grows with n; so a larger cloth is timed earlier: when about 15 points
/// share a cell in `falling`, as after 45 frames at 50 x 50 (measured from 25 to 512).
std::vector<BenchCase> bench_cases(const BenchConfig& config);

} // namespace clothlab::experiments
