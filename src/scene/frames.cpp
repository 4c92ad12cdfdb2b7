#include "scene/frames.h"

#include <cmath>

#include "scene/error.h"
#include "scene/number_text.h"

namespace clothlab::scene {

std::uint64_t frames_of(double seconds, const sim::Description& description) {
    const double frames = seconds * description.stepping.frames_per_second;
    if (!(frames >= 0))
        throw SceneError("--seconds " + shortest_text(seconds) + ": no time to simulate");
    if (!(frames < 1e15))
        throw SceneError("--seconds " + shortest_text(seconds) + ": too long a run");
    return static_cast<std::uint64_t>(std::ceil(frames * (1 - 1e-12)));
}

} // namespace clothlab::scene
