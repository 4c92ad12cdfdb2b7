#include "sim/spring_operator.h"

#include <algorithm>
#include <cmath>

namespace clothlab::sim {

template <class Real>
SpringOperator::SpringOperator(const Model<Real>& model, const Vec3Array<Real>& position) : free_(position.size()) {
    constexpr std::array<double, spring_kinds> stiffness{1, 1, bending_share};
    const auto d = [](Real v) { return static_cast<double>(v); };
    const Grid<Real>& grid = *model.grid;
    for (std::size_t i = 0; i < free_.size(); ++i)
        free_[i] = model.pinned[i] ? 0 : 1;
    springs_.reserve(stencil_size * free_.size());
    for_each_spring(grid.columns, grid.rows, [&](std::uint32_t a, std::uint32_t b, std::size_t s) {
        if (!model.pulls(s) || (!free_[a] && !free_[b]))
            return;
        const double dx = d(position.x[b]) - d(position.x[a]), dy = d(position.y[b]) - d(position.y[a]),
                     dz = d(position.z[b]) - d(position.z[a]);
        const double length = std::hypot(dx, dy, dz);
        if (!(length > 0))
            return;
        const double k = stiffness[static_cast<std::size_t>(spring_stencil[s].kind)];
        const double share = d(grid.rest_length(s, a)) / length, along = std::sqrt(k * share) / length;
        springs_.push_back({a, b, along * dx, along * dy, along * dz, k * (1 - share)});
    });
}

void SpringOperator::apply(std::span<const double> v, std::span<double> out) const {
    std::fill(out.begin(), out.end(), 0.0);
    for (const Spring& s : springs_) {
        const double *from = &v[3 * s.a], *to = &v[3 * s.b];
        const double x = to[0] - from[0], y = to[1] - from[1], z = to[2] - from[2];
        const double along = s.nx * x + s.ny * y + s.nz * z;
        const double fx = s.across * x + along * s.nx, fy = s.across * y + along * s.ny,
                     fz = s.across * z + along * s.nz;
        double *a = &out[3 * s.a], *b = &out[3 * s.b];
        a[0] -= fx;
        a[1] -= fy;
        a[2] -= fz;
        b[0] += fx;
        b[1] += fy;
        b[2] += fz;
    }
    for (std::size_t i = 0; i < free_.size(); ++i)
        if (!free_[i])
            out[3 * i] = out[3 * i + 1] = out[3 * i + 2] = 0;
}

double SpringOperator::bound() const {
    // K <= K', whose springs have their largest eigenvalue k max(1, t) = k in every direction: t is below 1. What is
    // left is the Laplacian of a graph with weights k, whose rows sum to twice the weights at a point; towards pinned
    // neighbours only the diagonal counts.
    std::vector<double> sum(free_.size(), 0.0);
    for (const Spring& s : springs_) {
        const double k = s.across + s.nx * s.nx + s.ny * s.ny + s.nz * s.nz;
        const double weight = free_[s.a] && free_[s.b] ? 2 * k : k;
        sum[s.a] += weight;
        sum[s.b] += weight;
    }
    double largest = 0;
    for (std::size_t i = 0; i < free_.size(); ++i)
        if (free_[i])
            largest = std::max(largest, sum[i]);
    return largest;
}

template SpringOperator::SpringOperator(const Model<float>&, const Vec3Array<float>&);
template SpringOperator::SpringOperator(const Model<double>&, const Vec3Array<double>&);

} // namespace clothlab::sim
