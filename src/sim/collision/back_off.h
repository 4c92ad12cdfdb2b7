// What did not pay is left alone for some steps, and for twice as many every next time.
#pragma once

#include <algorithm>

namespace clothlab::sim {

class BackOff {
public:
    /// Whether this step is one of those to be done without. Counts it.
    bool waits() {
        if (steps_ == 0)
            return false;
        --steps_;
        return true;
    }
    /// It did not pay: the next steps are done without.
    void leave() { steps_ = next_ = std::clamp(2 * next_, least, most); }
    /// It did pay: should it not the next time, that is the first time again.
    void pays() { next_ = 0; }

private:
    static constexpr int least = 32, most = 512; ///< steps
    int steps_ = 0, next_ = 0;
};

} // namespace clothlab::sim
