#include "sim/stretch_limit.h"

#include <cmath>

namespace clothlab::sim {

template <class Real>
std::size_t limit_stretch(const Model<Real>& model, State<Real>& state) {
    const Springs<Real>& springs = model.grid->springs;
    Real *x = state.position.x.data(), *y = state.position.y.data(), *z = state.position.z.data();
    std::size_t shortened = 0;
    for (std::size_t i = 0; i < springs.size(); ++i) {
        const std::uint32_t a = springs.a[i], b = springs.b[i];
        const Real dx = x[b] - x[a], dy = y[b] - y[a], dz = z[b] - z[a];
        const Real length = std::sqrt(dx * dx + dy * dy + dz * dz);
        const Real longest = static_cast<Real>(stretch_limit) * springs.rest[i];
        if (!(length > longest))
            continue;
        const bool a_pinned = model.pinned[a] != 0, b_pinned = model.pinned[b] != 0;
        if (a_pinned && b_pinned)
            continue;
        const Real s = (length - longest) / length;
        const Real share = a_pinned || b_pinned ? s : Real(0.5) * s;
        if (!a_pinned) {
            x[a] += share * dx;
            y[a] += share * dy;
            z[a] += share * dz;
        }
        if (!b_pinned) {
            x[b] -= share * dx;
            y[b] -= share * dy;
            z[b] -= share * dz;
        }
        ++shortened;
    }
    return shortened;
}

template std::size_t limit_stretch<float>(const Model<float>&, State<float>&);
template std::size_t limit_stretch<double>(const Model<double>&, State<double>&);

} // namespace clothlab::sim
