// Simulated time in frames.
#pragma once

#include <cstdint>

#include "sim/description.h"

namespace clothlab::scene {

/// As many whole frames as a time takes, rounded up: 0.1 s at 90 frames/s are 9, whatever the product rounds to. Throws
/// SceneError, which names the option of all commands, for a negative time, none, or more than 1e15 frames.
std::uint64_t frames_of(double seconds, const sim::Description& description);

} // namespace clothlab::scene
