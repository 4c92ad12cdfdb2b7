// A stability map as a chart.
#pragma once

#include <vector>

#include "experiments/chart.h"
#include "experiments/stability/boundary.h"

namespace clothlab::experiments {

struct StabilityPicture {
    const VariedAxis& x;
    const VariedAxis& y;
    const Refined& refined; ///< kinds are verdicts; `judged` are the rows of the table
    const std::vector<BoundaryPoint>& border;
    const std::vector<std::vector<double>>& predicted; ///< of each line
};

/// The verdict of each cell under the observed border and, dashed, the predicted one. A cell that was not run has the
/// row of the run that it is taken to be like.
Chart stability_chart(const StabilityPicture& picture);

} // namespace clothlab::experiments
