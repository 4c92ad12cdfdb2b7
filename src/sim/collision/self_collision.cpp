#include "sim/collision/self_collision.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "sim/collision/contact_cells.h"
#include "sim/collision/contact_pairs.h"
#include "sim/collision/near_pairs.h"
#include "sim/collision/neighbours.h"
#include "sim/collision/point_cells.h"
#include "sim/collision/triangles.h"

namespace clothlab::sim {
namespace {

/// The rule as it is written, all points in order.
template <class Real>
std::size_t resolve_plainly(const Model<Real>& model, State<Real>& state, SelfCollisionWork<Real>& work) {
    Vec3Array<Real>& x = state.position;
    fill_cells(x, {model.cell_x, model.cell_y, model.cell_z}, work);
    const Real apart = Real(2) * model.thickness;
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (model.pinned[i])
            continue;
        Real sum_x = 0, sum_y = 0, sum_z = 0;
        int count = 0;
        for_points_of_cell(work, at(work.cell, i), [&](std::size_t q) {
            if (q == i)
                return;
            const Real dx = x.x[i] - x.x[q], dy = x.y[i] - x.y[q], dz = x.z[i] - x.z[q];
            const Real length = std::sqrt(dx * dx + dy * dy + dz * dz);
            if (!(length < apart) || length == 0)
                return;
            const Real push = (apart - length) / length;
            sum_x += push * dx;
            sum_y += push * dy;
            sum_z += push * dz;
            ++count;
        });
        if (count == 0)
            continue;
        const Real share = static_cast<Real>(count) * static_cast<Real>(model.substeps);
        x.x[i] += sum_x / share;
        x.y[i] += sum_y / share;
        x.z[i] += sum_z / share;
        pairs += static_cast<std::size_t>(count);
    }
    return pairs;
}

} // namespace

template <class Real>
std::size_t resolve_self_collision(const Model<Real>& model, State<Real>& state, Workspace<Real>& work) {
    if (!(model.thickness > 0))
        return 0; // no two points are nearer than that
    switch (model.rules.self_collision) {
    case SelfCollisionRule::none:
        return 0;
    case SelfCollisionRule::neighbours:
        return resolve_neighbours(model, state, work.self_collision);
    case SelfCollisionRule::triangles:
        return resolve_triangles(model, state, work.self_collision.tree);
    case SelfCollisionRule::cs184:
        break;
    }
    if (!work.kernels)
        return resolve_plainly(model, state, work.self_collision);
    if (find_pairs(model, state.position, work))
        return resolve_pairs(model, state, work.self_collision);
    return resolve_in_cells(model, state, work);
}

template <class Real>
void prepare_self_collision(const Model<Real>& model, Workspace<Real>& work) {
    const std::size_t points = model.grid->points();
    SelfCollisionWork<Real>& s = work.self_collision;
    s.anchored = false;
    s.list_rests = {};
    if (model.rules.self_collision == SelfCollisionRule::triangles)
        return s.tree.resize(model.grid->columns, model.grid->rows);
    if (!work.kernels || model.rules.self_collision == SelfCollisionRule::neighbours) {
        s.cell.resize(points);
        s.lists.first.resize(std::bit_ceil(points));
        s.lists.next.resize(points);
        return;
    }
    s.anchor.resize(points);
    s.far_pairs.reserve(most_far_pairs(points));
    s.pairs.resize(most_pairs(points) + most_far_pairs(points));
    s.pair_count = 0;
    s.cursor.assign(points, 0);
    s.active.assign(points / 64 + 1, 0);
    s.partners.resize(2 * s.pairs.size());
    s.order.resize(points);
    s.key.resize(points);
    s.cell_end.resize(most_cells(points) + 1);
    prepare_cells(*model.grid, s);
}

template std::size_t resolve_self_collision<float>(const Model<float>&, State<float>&, Workspace<float>&);
template std::size_t resolve_self_collision<double>(const Model<double>&, State<double>&, Workspace<double>&);
template void prepare_self_collision<float>(const Model<float>&, Workspace<float>&);
template void prepare_self_collision<double>(const Model<double>&, Workspace<double>&);

} // namespace clothlab::sim
