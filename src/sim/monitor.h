// Watches a run for what makes its numbers worthless: values that are no longer finite, a cloth that grows without
// bound, and the bounded jitter that the stretch limit leaves where springs are too stiff for the step.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "sim/diagnostics.h"
#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

/// What went wrong first, when, where and why.
struct Trouble {
    Status status = Status::diverged; ///< jitter or diverged
    double time = 0;                  ///< s
    std::uint64_t frame = 0;          ///< whole frames since the start
    int column = 0, row = 0;          ///< of the worst point
    std::string cause;                ///< a sentence, with all of the above
    bool operator==(const Trouble&) const = default;
};

/// To be shown every frame's last step. Keeps the first trouble, unless a jitter becomes a divergence.
///
/// Jitter: smooth motion changes little from one step to the next, while a mode beyond the stability limit turns round
/// in every step or two. So it is jitter when the root mean square over all points of the change of displacement
/// between two successive steps is larger than 0.8 of that of the displacements themselves (pure alternation has 2) and
/// than a hundredth of the shortest rest length, in more than five frames on end (an impact is over sooner) without
/// growing to more than twice the size meanwhile. For methods without any stable step, which make slower oscillations
/// grow too, it is 0.2 and three thousandths.
///
/// Divergence: positions that are not finite, a bounding box of 100 times the cloth's size, or a root mean square
/// change of displacement above that size.
template <class Real>
class Monitor {
public:
    /// Begins with a state, forgetting all that was before. The frames that follow allocate no memory.
    void begin(const State<Real>& state);
    /// The state that a frame's last step begins with.
    void before_last_step(const State<Real>& state);
    /// The state that it ends with, and how many frames are complete now.
    void end_of_frame(const Model<Real>& model, const State<Real>& state, std::uint64_t frame);
    const std::optional<Trouble>& trouble() const { return trouble_; }
    std::size_t bytes() const { return before_.bytes() + sound_.bytes(); }

private:
    Vec3Array<Real> before_;         ///< m, two steps before the frame's end
    Vec3Array<Real> sound_;          ///< m, at one of the last frame ends without a sign of trouble
    int jittery_frames_ = 0;         ///< on end, so far
    std::array<double, 5> recent_{}; ///< m, root mean square change of displacement in the last of them
    std::optional<Trouble> trouble_;
};

extern template class Monitor<float>;
extern template class Monitor<double>;

} // namespace clothlab::sim
