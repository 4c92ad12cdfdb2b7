// What a time is that was measured in several rounds.
#pragma once

#include <vector>

namespace clothlab::experiments {

/// Of the rounds, in s (or s per whatever was measured).
struct Measured {
    double median = 0, min = 0, max = 0;
    double spread() const { return median > 0 ? (max - min) / median : 0; }
};

/// Of at least one value; of an even number of them, the upper of the two in the middle counts as the median.
Measured measured(std::vector<double> values);

} // namespace clothlab::experiments
