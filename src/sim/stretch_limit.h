// The course's stretch limit: X. Provot, "Deformation constraints in a mass-spring model to describe rigid cloth
// behavior", Graphics Interface 1995, section 4, as one Gauss-Seidel sweep.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "sim/kernels/kernels.h"
#include "sim/model.h"
#include "sim/state.h"
#include "sim/workspace.h"

namespace clothlab::sim {

/// Shortens every spring that is longer than 1.1 times its rest length, in spring order, by moving its free ends.
/// Returns the number of springs shortened.
template <class Real>
std::size_t limit_stretch(const Model<Real>& model, State<Real>& state, Workspace<Real>& work);

/// A spring with |d|² up to this times rest² is surely within the limit, whatever the rounding of either side; if
/// rest² neither overflows nor loses digits (may_filter_limit).
template <class Real>
inline constexpr Real limit_filter = static_cast<Real>(stretch_limit* stretch_limit) *
                                     (Real(1) - Real(16) * std::numeric_limits<Real>::epsilon());
template <class Real>
constexpr bool may_filter_limit(Real rest) {
    constexpr Real low = sizeof(Real) == 4 ? Real(1e-15) : Real(1e-140),
                   high = sizeof(Real) == 4 ? Real(1e15) : Real(1e140);
    return rest > low && rest < high;
}

/// Sets of a point's own springs: a bit for each entry of the stencil.
using SpringSet = std::uint32_t;
inline constexpr SpringSet all_springs = (1u << stencil_size) - 1;

/// The sweep at one point, for the springs of `todo` and those that come after one it shortened. Returns those it
/// shortened.
template <class Real>
inline SpringSet limit_point(const LimitArguments<Real>& arguments, std::size_t i, SpringSet todo = all_springs) {
    const auto& [x, y, z] = arguments.x;
    const auto columns = static_cast<std::ptrdiff_t>(arguments.columns);
    const auto column = static_cast<std::ptrdiff_t>(static_cast<std::uint32_t>(i) % arguments.columns);
    SpringSet shortened = 0;
    while (todo != 0) {
        const auto s = static_cast<std::size_t>(std::countr_zero(todo));
        todo &= todo - 1;
        const SpringStencil& spring = spring_stencil[s];
        const std::ptrdiff_t other = static_cast<std::ptrdiff_t>(i) + spring.rows * columns + spring.columns;
        if (column + spring.columns < 0 || column + spring.columns >= columns || other < 0)
            continue;
        const auto b = static_cast<std::size_t>(other);
        const Real dx = x[b] - x[i], dy = y[b] - y[i], dz = z[b] - z[i];
        const Real square = dx * dx + dy * dy + dz * dz;
        const Real rest = arguments.rest.of[s][i & arguments.rest.mask];
        if (arguments.filter && square <= rest * rest * limit_filter<Real>)
            continue;
        const Real length = std::sqrt(square);
        const Real longest = static_cast<Real>(stretch_limit) * rest;
        if (!(length > longest))
            continue;
        const bool a_pinned = arguments.pinned[i] != 0, b_pinned = arguments.pinned[b] != 0;
        if (a_pinned && b_pinned)
            continue;
        const Real whole = (length - longest) / length;
        const Real share = a_pinned || b_pinned ? whole : Real(0.5) * whole;
        if (!a_pinned) {
            x[i] += share * dx;
            y[i] += share * dy;
            z[i] += share * dz;
        }
        if (!b_pinned) {
            x[b] -= share * dx;
            y[b] -= share * dy;
            z[b] -= share * dz;
        }
        shortened |= 1u << s;
        todo |= all_springs & (~1u << s);
    }
    return shortened;
}

extern template std::size_t limit_stretch<float>(const Model<float>&, State<float>&, Workspace<float>&);
extern template std::size_t limit_stretch<double>(const Model<double>&, State<double>&, Workspace<double>&);

} // namespace clothlab::sim
