// A stability map as a chart.
#pragma once

#include <vector>

#include "experiments/chart.h"
#include "experiments/stability_boundary.h"

namespace clothlab::experiments {

struct StabilityPicture {
    const VariedAxis& x;
    const VariedAxis& y;
    const Refined& refined; ///< kinds are verdicts; rows of the table are in the order of `judged`
    const std::vector<BoundaryPoint>& border;
    const std::vector<std::vector<double>>& predicted; ///< of each line
};

/// The verdict of each cell under the observed border and, dashed, the predicted one. Cells that were not run are drawn
/// in blocks, each with the row of the run at its corner.
Chart stability_chart(const StabilityPicture& picture);

} // namespace clothlab::experiments
