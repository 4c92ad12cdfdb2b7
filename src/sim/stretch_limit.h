// The course's stretch limit: X. Provot, "Deformation constraints in a mass-spring model to describe rigid cloth
// behavior", Graphics Interface 1995, section 4, as one Gauss-Seidel sweep.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

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

/// The sweep at one spring, point i's own of stencil entry s. Returns whether it was shortened.
template <std::size_t s, class Real>
[[gnu::always_inline]] inline bool limit_spring(const LimitArguments<Real>& arguments, std::size_t i,
                                                std::size_t column) {
    constexpr SpringStencil spring = spring_stencil[s];
    const auto& [x, y, z] = arguments.x;
    if constexpr (spring.columns < 0)
        if (column < static_cast<std::size_t>(-spring.columns))
            return false;
    if constexpr (spring.columns > 0)
        if (column + 1 == arguments.columns)
            return false;
    constexpr auto rows = static_cast<std::size_t>(-spring.rows);
    if (i < rows * arguments.columns)
        return false;
    const std::size_t b = i - rows * arguments.columns + static_cast<std::size_t>(spring.columns);
    const Real dx = x[b] - x[i], dy = y[b] - y[i], dz = z[b] - z[i];
    const Real square = dx * dx + dy * dy + dz * dz;
    const Real rest = arguments.rest.of[s][i & arguments.rest.mask];
    if (arguments.filter && square <= rest * rest * limit_filter<Real>)
        return false;
    const Real length = std::sqrt(square);
    const Real longest = static_cast<Real>(stretch_limit) * rest;
    if (!(length > longest))
        return false;
    const bool a_pinned = arguments.pinned[i] != 0, b_pinned = arguments.pinned[b] != 0;
    if (a_pinned && b_pinned)
        return false;
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
    return true;
}

/// The sweep at one point, for the springs of `todo` and those that come after one it shortened. Returns those it
/// shortened. Each spring has code of its own, so that the processor learns how likely each is to be shortened; a call
/// for each point would cost a tenth of the sweep.
template <class Real>
[[gnu::always_inline]] inline SpringSet limit_point(const LimitArguments<Real>& arguments, std::size_t i,
                                                    SpringSet todo = all_springs) {
    const std::size_t column = static_cast<std::uint32_t>(i) % static_cast<std::uint32_t>(arguments.columns);
    SpringSet shortened = 0;
    const auto look = [&](auto entry) __attribute__((always_inline)) {
        constexpr std::size_t s = decltype(entry)::value;
        if ((todo & (1u << s)) != 0 && limit_spring<s>(arguments, i, column)) {
            shortened |= 1u << s;
            todo = all_springs;
        }
    };
    static_assert(stencil_size == 6);
    look(std::integral_constant<std::size_t, 0>());
    look(std::integral_constant<std::size_t, 1>());
    look(std::integral_constant<std::size_t, 2>());
    look(std::integral_constant<std::size_t, 3>());
    look(std::integral_constant<std::size_t, 4>());
    look(std::integral_constant<std::size_t, 5>());
    return shortened;
}

extern template std::size_t limit_stretch<float>(const Model<float>&, State<float>&, Workspace<float>&);
extern template std::size_t limit_stretch<double>(const Model<double>&, State<double>&, Workspace<double>&);

} // namespace clothlab::sim
