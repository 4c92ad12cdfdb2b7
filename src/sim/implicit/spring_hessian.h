// The second derivative of the springs' energy, as a matrix that is never built: each spring's 3 x 3 block, and its
// product with a vector.
//
// Of a spring with rest length L0, of length L along the unit vector n, the block is
//     k ( n nT + (1 - L0 / L) (I - n nT) )
// (D. Baraff, A. Witkin, "Large steps in cloth simulation", SIGGRAPH 1998, section 4; here for linear springs). Where
// the spring is compressed its second part is negative, and the matrix of the system could be indefinite. That part is
// left out there (K.-J. Choi, H.-S. Ko, "Stable but responsive cloth", SIGGRAPH 2002, section 3.1): conjugate gradients
// then always find a direction in which the energy falls, and Newton's method, which stops only where the exact forces
// are in balance, is slower under compression but no less accurate.
#pragma once

#include <array>

#include "sim/model.h"
#include "sim/state.h"
#include "sim/workspace.h"

namespace clothlab::sim {

/// Blocks t I + w wT of all springs, zero where there is none or its kind is off.
template <class Real>
struct SpringHessian {
    struct Blocks {
        AlignedVector<Real> t, wx, wy, wz;
    };
    std::array<Blocks, stencil_size> springs; ///< by stencil entry, then by the point that owns the spring; N/m

    /// Upper triangles of the inverse of the points' own 3 x 3 blocks with a I added: xx, xy, xz, yy, yz, zz.
    std::array<AlignedVector<Real>, 6> inverse_diagonal;

    void resize(std::size_t points);
    std::size_t bytes() const;
};

/// Computes the blocks at a position, and the inverse of those on the diagonal of a I + Hessian, a in N/m.
template <class Real>
void linearise(const Model<Real>& model, const Vec3Array<Real>& position, Real a, Workspace<Real>& work,
               SpringHessian<Real>& hessian);

/// out = (a I + Hessian) p for the points [begin, end), zero for pinned ones. The same bits whatever ranges the points
/// are divided into.
template <class Real>
void multiply(const Model<Real>& model, const SpringHessian<Real>& hessian, Real a, const Vec3Array<Real>& p,
              std::size_t begin, std::size_t end, Vec3Array<Real>& out);

#define CLOTHLAB_DECLARE(Real)                                                                                         \
    extern template struct SpringHessian<Real>;                                                                        \
    extern template void linearise<Real>(const Model<Real>&, const Vec3Array<Real>&, Real, Workspace<Real>&,           \
                                         SpringHessian<Real>&);                                                        \
    extern template void multiply<Real>(const Model<Real>&, const SpringHessian<Real>&, Real, const Vec3Array<Real>&,  \
                                        std::size_t, std::size_t, Vec3Array<Real>&);
CLOTHLAB_DECLARE(float)
CLOTHLAB_DECLARE(double)
#undef CLOTHLAB_DECLARE

} // namespace clothlab::sim
