#include "sim/spring_operator.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clothlab::sim {
namespace {

constexpr std::size_t most_kept = std::size_t{512} * 512; // points

} // namespace

template <class Real>
template <class Visit>
void SpringOperator<Real>::for_springs(Visit visit) const {
    if (!springs_.empty()) {
        for (const Spring& spring : springs_)
            visit(spring);
        return;
    }
    constexpr std::array<double, spring_kinds> stiffness{1, 1, bending_share};
    const auto d = [](Real v) { return static_cast<double>(v); };
    const Grid<Real>& grid = *model_.grid;
    for_each_spring(grid.columns, grid.rows, [&](std::uint32_t a, std::uint32_t b, std::size_t s) {
        if (!model_.pulls(s) || (!is_free(a) && !is_free(b)))
            return;
        const auto& [x, y, z] = position_;
        const double dx = d(x[b]) - d(x[a]), dy = d(y[b]) - d(y[a]), dz = d(z[b]) - d(z[a]);
        const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
        if (!(length > 0))
            return;
        const double k = stiffness[static_cast<std::size_t>(spring_stencil[s].kind)];
        const double share = d(grid.rest_length(s, a)) / length, along = std::sqrt(k * share) / length;
        visit(Spring{a, b, along * dx, along * dy, along * dz, k * (1 - share)});
    });
}

template <class Real>
SpringOperator<Real>::SpringOperator(const Model<Real>& model, const Vec3Array<Real>& position)
    : model_(model), position_(position) {
    if (position.size() > most_kept)
        return;
    std::vector<Spring> springs;
    springs.reserve(stencil_size * position.size());
    for_springs([&](const Spring& spring) { springs.push_back(spring); });
    springs_ = std::move(springs);
}

template <class Real>
void SpringOperator<Real>::apply(std::span<const double> v, std::span<double> out) const {
    std::fill(out.begin(), out.end(), 0.0);
    for_springs([&](const Spring& s) {
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
    });
    for (std::size_t i = 0; i < position_.size(); ++i)
        if (!is_free(i))
            out[3 * i] = out[3 * i + 1] = out[3 * i + 2] = 0;
}

template <class Real>
double SpringOperator<Real>::bound() const {
    // K <= K', whose springs have their largest eigenvalue k max(1, t) = k in every direction: t is below 1. What is
    // left is the Laplacian of a graph with weights k, whose rows sum to twice the weights at a point; towards pinned
    // neighbours only the diagonal counts.
    std::vector<double> sum(position_.size(), 0.0);
    for_springs([&](const Spring& s) {
        const double k = s.across + s.nx * s.nx + s.ny * s.ny + s.nz * s.nz;
        const double weight = is_free(s.a) && is_free(s.b) ? 2 * k : k;
        sum[s.a] += weight;
        sum[s.b] += weight;
    });
    double largest = 0;
    for (std::size_t i = 0; i < position_.size(); ++i)
        if (is_free(i))
            largest = std::max(largest, sum[i]);
    return largest;
}

template class SpringOperator<float>;
template class SpringOperator<double>;

} // namespace clothlab::sim
