// What a change of parameters changed, in words.
#pragma once

#include <string>

#include "sim/description.h"

namespace clothlab::ui {

/// "Stiffness ks 5000 -> 8000 N/m; Shear springs on -> off", in the units that the panels show; at most `most` of the
/// differences are written out, the others are counted. "nothing" for equal descriptions.
std::string describe_change(const sim::Description& before, const sim::Description& after, std::size_t most = 3);

} // namespace clothlab::ui
