// The course's self-collision rule for one point: what pushes it, and where it goes.
#pragma once

#include <cmath>

#include "sim/select.h"

namespace clothlab::sim {

/// To be fed with the point's partners in index order.
template <class Real>
class PushSum {
public:
    /// A partner at x - (dx, dy, dz). Pairs out of reach and coincident ones count as nothing: they add zero to sums
    /// that are never -0.
    void add(Real dx, Real dy, Real dz, Real apart) {
        const Real length = std::sqrt(dx * dx + dy * dy + dz * dz);
        const bool touching = static_cast<int>(length < apart) & static_cast<int>(length > 0);
        const Real push = select(touching, (apart - length) / length, Real(0));
        x_ += push * dx;
        y_ += push * dy;
        z_ += push * dz;
        count_ += static_cast<int>(touching);
    }
    /// How many pushed.
    std::size_t count() const { return static_cast<std::size_t>(count_); }
    /// Moves the point by the mean of the pushes, divided by the substeps, if there are any.
    void move(Real& x, Real& y, Real& z, Real substeps) const {
        const Real share = static_cast<Real>(count_) * substeps;
        const bool pushed = count_ != 0;
        x = select(pushed, x + x_ / share, x);
        y = select(pushed, y + y_ / share, y);
        z = select(pushed, z + z_ / share, z);
    }

private:
    Real x_ = 0, y_ = 0, z_ = 0;
    int count_ = 0;
};

} // namespace clothlab::sim
