// Whether a full model can be a yardstick at all.
#pragma once

#include "experiments/needs/needs.h"

namespace clothlab::experiments::needs {

/// Throws Refusal where the full model fails, or where it has no first contact to be compared by.
void require_sound(const Config& config, const Record& full);

/// How far the full model moves when its start is nudged, in the quantity's unit. Throws Refusal where that is more
/// than the tolerance, with what would do instead.
double noise_of(const Config& config, const Record& full, const Record& nudged, double nudge);

} // namespace clothlab::experiments::needs
