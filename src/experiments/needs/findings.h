// What the search found, as a table, a chart and sentences.
#pragma once

#include "experiments/needs/search.h"

namespace clothlab::experiments::needs {

Findings findings_of(const Config& config, const Found& found);

/// The recommended model, named and described as what it is.
scene::Scene recommended_scene(const Config& config, const Found& found);

} // namespace clothlab::experiments::needs
