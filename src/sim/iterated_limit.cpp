// Sweeps that go forth and back carry a correction from the pins through the whole cloth in one of the two directions,
// wherever the pins are; sweeps in one direction alone carry it against that direction by one point each.
#include "sim/iterated_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clothlab::sim {
namespace {

template <class Real>
Real largest(Real x, Real y, Real z) {
    return std::max({std::abs(x), std::abs(y), std::abs(z)});
}

/// Shortens point a's own spring of stencil entry s, to b. Returns whether it was too long and could be shortened.
template <class Real>
bool shorten(const Model<Real>& model, Vec3Array<Real>& x, std::size_t a, std::size_t b, std::size_t s) {
    // A length is known to a few roundings of its ends' coordinates, and no better.
    constexpr Real roundings = Real(4) * std::numeric_limits<Real>::epsilon();
    const Real dx = x.x[b] - x.x[a], dy = x.y[b] - x.y[a], dz = x.z[b] - x.z[a];
    const Real length = std::sqrt(dx * dx + dy * dy + dz * dz);
    const Real rest = model.grid->rest_length(s, a);
    const Real longest = static_cast<Real>(stretch_limit) * rest;
    if (!(length > longest))
        return false;
    const Real rounding = roundings * std::max(largest(x.x[a], x.y[a], x.z[a]), largest(x.x[b], x.y[b], x.z[b]));
    if (!(length > longest + (static_cast<Real>(model.tolerance) * rest + rounding)))
        return false;
    const bool a_pinned = model.pinned[a] != 0, b_pinned = model.pinned[b] != 0;
    if (a_pinned && b_pinned)
        return false;
    const Real whole = (length - longest) / length;
    const Real share = a_pinned || b_pinned ? whole : Real(0.5) * whole;
    if (!a_pinned) {
        x.x[a] += share * dx;
        x.y[a] += share * dy;
        x.z[a] += share * dz;
    }
    if (!b_pinned) {
        x.x[b] -= share * dx;
        x.y[b] -= share * dy;
        x.z[b] -= share * dz;
    }
    return true;
}

} // namespace

template <class Real>
std::size_t limit_stretch_iterated(const Model<Real>& model, State<Real>& state) {
    const int columns = model.grid->columns, rows = model.grid->rows;
    std::size_t all = 0;
    for (int sweep = 0; sweep < most_limit_sweeps; ++sweep) {
        std::size_t shortened = 0;
        for (int n = 0; n < columns * rows; ++n) {
            const int i = sweep % 2 == 0 ? n : columns * rows - 1 - n;
            const int column = i % columns, row = i / columns;
            for (std::size_t s = 0; s < stencil_size; ++s) {
                const int to_column = column + spring_stencil[s].columns, to_row = row + spring_stencil[s].rows;
                if (to_column < 0 || to_column >= columns || to_row < 0)
                    continue;
                const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(to_row * columns + to_column);
                shortened += shorten(model, state.position, a, b, s) ? 1u : 0u;
            }
        }
        all += shortened;
        if (shortened == 0)
            break;
    }
    return all;
}

template std::size_t limit_stretch_iterated<float>(const Model<float>&, State<float>&);
template std::size_t limit_stretch_iterated<double>(const Model<double>&, State<double>&);

} // namespace clothlab::sim
