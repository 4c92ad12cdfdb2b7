#include "sim/grid.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "sim/random.h"

namespace clothlab::sim {
namespace {

/// The vertical cloth's random offsets; empty for the horizontal one.
std::vector<double> wrinkles(const Description& description) {
    const Cloth& cloth = description.cloth;
    std::vector<double> z;
    if (cloth.orientation != Orientation::vertical)
        return z;
    z.resize(static_cast<std::size_t>(cloth.num_width_points) * static_cast<std::size_t>(cloth.num_height_points));
    SplitMix64 random(static_cast<std::uint64_t>(description.stepping.seed));
    for (double& value : z)
        value = -0.001 + 0.002 * random.unit();
    return z;
}

struct Spacing {
    explicit Spacing(const Cloth& cloth)
        : x(cloth.width / (cloth.num_width_points - 1)), y(cloth.height / (cloth.num_height_points - 1)) {}
    double x, y; ///< m
};

} // namespace

template <class Real>
Grid<Real> make_grid(const Description& description) {
    const Cloth& cloth = description.cloth;
    if (cloth.num_width_points < 2 || cloth.num_height_points < 2)
        throw std::invalid_argument("a cloth needs at least two points along its width and its height");
    if (!(cloth.width > 0) || !(cloth.height > 0))
        throw std::invalid_argument("a cloth needs a width and a height above zero");

    Grid<Real> grid;
    grid.columns = cloth.num_width_points;
    grid.rows = cloth.num_height_points;
    const Spacing spacing(cloth);
    const std::vector<double> wrinkle = wrinkles(description);
    const auto length = [&](std::size_t s, double gz) {
        const double gx = std::abs(spring_stencil[s].columns) * spacing.x;
        const double gy = std::abs(spring_stencil[s].rows) * spacing.y;
        return static_cast<Real>(std::sqrt(gx * gx + gy * gy + gz * gz));
    };
    if (wrinkle.empty()) {
        constexpr std::size_t most_lanes = CacheLineAllocator<Real>::spare / sizeof(Real);
        for (std::size_t s = 0; s < stencil_size; ++s)
            grid.rest[s].assign(most_lanes, length(s, 0));
    } else {
        grid.rest_mask = ~std::size_t{0};
        for (AlignedVector<Real>& rest : grid.rest)
            rest.assign(grid.points(), Real(0));
        for_each_spring(grid.columns, grid.rows, [&](std::uint32_t a, std::uint32_t b, std::size_t s) {
            grid.rest[s][a] = length(s, wrinkle[b] - wrinkle[a]);
        });
    }
    grid.shortest = std::numeric_limits<Real>::infinity();
    for_each_spring(grid.columns, grid.rows, [&](std::uint32_t a, std::uint32_t, std::size_t s) {
        grid.shortest = std::min(grid.shortest, grid.rest_length(s, a));
        grid.longest = std::max(grid.longest, grid.rest_length(s, a));
    });
    const double depth = wrinkle.empty() ? 0 : wrinkle.back() - wrinkle.front();
    grid.diagonal = std::hypot(spacing.x * (grid.columns - 1), spacing.y * (grid.rows - 1), depth);
    return grid;
}

template <class Real>
Vec3Array<Real> start_positions(const Description& description) {
    const Cloth& cloth = description.cloth;
    const Spacing spacing(cloth);
    const std::vector<double> wrinkle = wrinkles(description);
    const auto columns = static_cast<std::size_t>(cloth.num_width_points);
    Vec3Array<Real> start;
    start.resize(columns * static_cast<std::size_t>(cloth.num_height_points));
    for (std::size_t i = 0; i < start.size(); ++i) {
        const double across = static_cast<double>(i % columns) * spacing.x;
        const double along = static_cast<double>(i / columns) * spacing.y;
        start.x[i] = static_cast<Real>(across + cloth.offset.x);
        start.y[i] = static_cast<Real>((wrinkle.empty() ? 1.0 : along) + cloth.offset.y);
        start.z[i] = static_cast<Real>((wrinkle.empty() ? along : wrinkle[i]) + cloth.offset.z);
    }
    return start;
}

template Grid<float> make_grid<float>(const Description&);
template Grid<double> make_grid<double>(const Description&);
template Vec3Array<float> start_positions<float>(const Description&);
template Vec3Array<double> start_positions<double>(const Description&);

} // namespace clothlab::sim
