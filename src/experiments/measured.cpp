#include "experiments/measured.h"

#include <algorithm>

namespace clothlab::experiments {

Measured measured(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return {values[values.size() / 2], values.front(), values.back()};
}

} // namespace clothlab::experiments
