// Non-penetration between particles as a distance constraint, projected pair by pair, Gauss-Seidel: M. Mueller,
// B. Heidelberger, M. Hennix, J. Ratcliff, "Position based dynamics", Journal of Visual Communication and Image
// Representation 18 (2007), section 3.3 and equations 10 and 11, as an inequality. That neighbours in the flat cloth
// are let be is M. Mueller's, "Ten minute physics 15: self-collision" (2022). In one thread, since the order is part of
// the result.
#include "sim/collision/neighbours.h"

#include <cmath>

#include "sim/collision/point_cells.h"

namespace clothlab::sim {
namespace {

/// Whether two points are at most so far apart in the flat cloth.
template <class Real>
bool near_at_rest(const Model<Real>& model, std::size_t i, std::size_t q, Real reach) {
    const auto columns = static_cast<std::size_t>(model.grid->columns);
    const auto across = static_cast<Real>(static_cast<long>(i % columns) - static_cast<long>(q % columns));
    const auto along_rows = static_cast<Real>(static_cast<long>(i / columns) - static_cast<long>(q / columns));
    const Real dx = across * model.spacing_x, dy = along_rows * model.spacing_y;
    return dx * dx + dy * dy <= reach * reach;
}

/// Puts a pair apart by as much as is missing, each point by half of it, or one by all when the other is pinned.
template <class Real>
bool separate(const Model<Real>& model, Vec3Array<Real>& x, std::size_t i, std::size_t q, Real reach) {
    const Triple<Real> d = at(x, i) - at(x, q);
    const Real length = norm(d);
    if (!(length < reach) || length == 0)
        return false;
    const bool i_pinned = model.pinned[i] != 0, q_pinned = model.pinned[q] != 0;
    if ((i_pinned && q_pinned) || near_at_rest(model, i, q, reach))
        return false;
    const Real whole = (reach - length) / length;
    const Real share = i_pinned || q_pinned ? whole : Real(0.5) * whole;
    if (!i_pinned)
        put(x, i, along(at(x, i), share, d));
    if (!q_pinned)
        put(x, q, along(at(x, q), -share, d));
    return true;
}

} // namespace

template <class Real>
std::size_t resolve_neighbours(const Model<Real>& model, State<Real>& state, SelfCollisionWork<Real>& work) {
    Vec3Array<Real>& x = state.position;
    const Real reach = Real(2) * model.thickness;
    // More than twice the reach, so that what is within reach of a point lies in two cells along each axis at the most.
    const Real w = Real(2.5) * reach;
    const Triple<Real> width{w, w, w};
    fill_cells(x, width, work);
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Triple<Real> p = at(x, i);
        const Triple<Real> low = cell_of<Real>({p.x - reach, p.y - reach, p.z - reach}, width);
        const Triple<Real> high = cell_of<Real>({p.x + reach, p.y + reach, p.z + reach}, width);
        for (int corner = 0; corner < 8; ++corner) {
            const bool up_x = (corner & 1) != 0, up_y = (corner & 2) != 0, up_z = (corner & 4) != 0;
            if ((up_x && high.x == low.x) || (up_y && high.y == low.y) || (up_z && high.z == low.z))
                continue;
            const Triple<Real> cell{up_x ? high.x : low.x, up_y ? high.y : low.y, up_z ? high.z : low.z};
            for_points_of_cell(work, cell, [&](std::size_t q) {
                if (q > i && separate(model, x, i, q, reach))
                    ++pairs;
            });
        }
    }
    return 2 * pairs;
}

#define CLOTHLAB_DEFINE(Real)                                                                                          \
    template std::size_t resolve_neighbours<Real>(const Model<Real>&, State<Real>&, SelfCollisionWork<Real>&);
CLOTHLAB_DEFINE(float)
CLOTHLAB_DEFINE(double)
#undef CLOTHLAB_DEFINE

} // namespace clothlab::sim
