// The Hessian of the springs' energy at a pose, for a stiffness ks of 1 N/m, as an operator in double precision.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/model.h"
#include "sim/state.h"

namespace clothlab::sim {

/// A spring of length L along n has the Hessian k (n nT + t (I - n nT)), t = 1 - rest/L, between its ends, where
/// k = 1 (0.2 for bending springs). Across itself a compressed spring pushes: t < 0. A spring of length zero has no
/// direction and does nothing, as in add_spring_forces. Pinned points do not move. Vectors hold x, y, z per point.
template <class Real>
class SpringOperator {
public:
    /// Model and positions must outlive it. Springs of up to 512 x 512 points are kept, 240 bytes per point; those of
    /// more are computed anew each time.
    SpringOperator(const Model<Real>& model, const Vec3Array<Real>& position);

    std::size_t size() const { return 3 * position_.size(); }
    bool is_free(std::size_t point) const { return model_.pinned[point] == 0; }
    /// out = K v; v must be zero at pinned points, and out is.
    void apply(std::span<const double> v, std::span<double> out) const;
    /// Not below any eigenvalue, by Gershgorin's circles of the matrix of norms.
    double bound() const;

private:
    struct Spring {
        std::uint32_t a, b;
        double nx, ny, nz; ///< n sqrt(k rest/L)
        double across;     ///< k t
    };
    /// Calls visit(spring) for all springs that do something.
    template <class Visit>
    void for_springs(Visit visit) const;

    const Model<Real>& model_;
    const Vec3Array<Real>& position_;
    std::vector<Spring> springs_; ///< empty where they are not kept
};

extern template class SpringOperator<float>;
extern template class SpringOperator<double>;

} // namespace clothlab::sim
