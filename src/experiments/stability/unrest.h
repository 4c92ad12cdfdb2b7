// An oscillation at the stability limit that stays small under a large smooth motion.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/simulation.h"

namespace clothlab::experiments {

/// sim::Monitor asks that the last step's change of displacement be about as large as the displacements themselves, as
/// much motion as a falling cloth has. Runge-Kutta 4 can be 2 % beyond its limit without that: as soon as the
/// oscillation bends the cloth it is slower, and grows no more. So here the changes of displacement, which smooth
/// motion hardly has, are compared with their own change: an oscillation about the limit turns them round in every step
/// or two. It is unrest when, at more than half of the last ten frames' ends, the root mean square of the change is
/// above the hundredth of the shortest rest length that sim::Monitor asks for too (and above what points hop by on a
/// collider), and its own change above 0.8 of it. Sound is: cloth at ks 200 000, just below Verlet's limit, that folds
/// onto itself, up to 0.0045 of the rest length; default cloth that swings at 0.9996 of the limit, 0.0005.
class Unrest {
public:
    explicit Unrest(const sim::Description& description);
    /// To be told after every step.
    void after_step(const sim::Simulation& simulation);
    bool found() const { return found_; }

private:
    void end_of_frame();

    int substeps_;
    double least_;                               ///< m, root mean square over all points
    std::array<std::vector<sim::Vec3>, 4> last_; ///< m, positions after the last steps, the newest first
    std::uint32_t frames_ = 0;                   ///< of the last ten, those with unrest, as bits
    bool found_ = false;
};

} // namespace clothlab::experiments
