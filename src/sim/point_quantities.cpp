#include "sim/point_quantities.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/collision/gaps.h"
#include "sim/curvature.h"
#include "sim/velocity_of.h"

namespace clothlab::sim {
namespace {

template <class Real>
void point_strains(const Model<Real>& model, const State<Real>& state, std::vector<float>& strains) {
    const Grid<Real>& grid = *model.grid;
    const Vec3Array<Real>& x = state.position;
    const auto d = [](Real v) { return static_cast<double>(v); };
    strains.assign(x.size(), 0.f);
    for_each_spring(grid.columns, grid.rows, [&](std::uint32_t a, std::uint32_t b, std::size_t s) {
        if (spring_stencil[s].kind == SpringKind::bending || !model.pulls(s))
            return;
        const double length = std::hypot(d(x.x[b]) - d(x.x[a]), d(x.y[b]) - d(x.y[a]), d(x.z[b]) - d(x.z[a]));
        const auto strain = static_cast<float>(length / d(grid.rest_length(s, a)) - 1);
        for (const std::uint32_t end : {a, b})
            if (std::abs(strain) > std::abs(strains[end])) // never with what is not a number
                strains[end] = strain;
    });
}

template <class Real>
void point_speeds(const Model<Real>& model, const State<Real>& state, std::vector<float>& speeds) {
    const VelocityOf velocity(model, state);
    speeds.resize(state.position.size());
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        const Vec3 v = velocity(i);
        speeds[i] = static_cast<float>(std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z));
    }
}

} // namespace

std::optional<PointQuantity> find_point_quantity(std::string_view name) {
    const auto found = std::find(point_quantity_names.begin(), point_quantity_names.end(), name);
    if (found == point_quantity_names.end())
        return {};
    return static_cast<PointQuantity>(found - point_quantity_names.begin());
}

template <class Real>
void point_quantity(PointQuantity which, const Model<Real>& model, const State<Real>& state,
                    std::span<const float> positions, std::vector<float>& values) {
    const int columns = model.grid->columns, rows = model.grid->rows;
    switch (which) {
    case PointQuantity::none:
        values.clear();
        break;
    case PointQuantity::strain:
        point_strains(model, state, values);
        break;
    case PointQuantity::speed:
        point_speeds(model, state, values);
        break;
    case PointQuantity::gap:
        point_gaps({columns, rows, static_cast<float>(model.spacing_x), static_cast<float>(model.spacing_y)}, positions,
                   static_cast<float>(model.thickness), values);
        break;
    case PointQuantity::curvature:
        point_curvatures(columns, rows, positions, values);
        break;
    case PointQuantity::distance:
        values.assign(model.grid->points(), 0.f);
        break;
    }
    for (float& value : values)
        value = std::isfinite(value) ? value : 0.f;
}

template void point_quantity<float>(PointQuantity, const Model<float>&, const State<float>&, std::span<const float>,
                                    std::vector<float>&);
template void point_quantity<double>(PointQuantity, const Model<double>&, const State<double>&, std::span<const float>,
                                     std::vector<float>&);

} // namespace clothlab::sim
