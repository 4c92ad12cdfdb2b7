// Numbers for each point of a cloth, for the eye to find where something happens: heat maps are drawn from them.
#pragma once

#include <cstdint>

namespace clothlab::sim {

enum class PointQuantity : std::uint8_t { none, strain, speed, gap, curvature };

} // namespace clothlab::sim
