// Who gets the processor where it also draws, as without a graphics card: pictures of a simulation that is late wait.
#pragma once

#include <algorithm>

namespace clothlab::app {

/// How long to rest between pictures, so that the simulation keeps the speed that was asked for. At most as long as a
/// picture takes, so that drawing has half of the time, and no longer than a fortieth of a second.
class PictureRest {
public:
    /// Seconds to rest after a picture that took so many, with a simulation that is `late` or is not. It is asked for
    /// little by little when late, and given back more slowly, so that the two do not take turns.
    double after(double picture, bool late) {
        constexpr double until_all = 0.5, until_none = 5, longest = 0.025; // s
        const double passed = picture + rest_;
        share_ = std::clamp(share_ + (late ? passed / until_all : -passed / until_none), 0.0, 1.0);
        return rest_ = std::min(share_ * picture, longest);
    }

private:
    double share_ = 0; ///< of the longest rest
    double rest_ = 0;  ///< s, the last one
};

} // namespace clothlab::app
