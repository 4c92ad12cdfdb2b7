#include "sim/grid.h"

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "sim/random.h"

namespace clothlab::sim {

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
    const std::size_t points = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
    const double dx = cloth.width / (grid.columns - 1), dy = cloth.height / (grid.rows - 1);
    const bool vertical = cloth.orientation == Orientation::vertical;

    std::vector<double> wrinkle(points, 0.0);
    if (vertical) {
        SplitMix64 random(static_cast<std::uint64_t>(description.stepping.seed));
        for (double& z : wrinkle)
            z = -0.001 + 0.002 * random.unit();
    }

    grid.start.resize(points);
    for (std::size_t i = 0; i < points; ++i) {
        const double across = static_cast<double>(i % static_cast<std::size_t>(grid.columns)) * dx;
        const double along = static_cast<double>(i / static_cast<std::size_t>(grid.columns)) * dy;
        grid.start.x[i] = static_cast<Real>(across + cloth.offset.x);
        grid.start.y[i] = static_cast<Real>((vertical ? along : 1.0) + cloth.offset.y);
        grid.start.z[i] = static_cast<Real>((vertical ? wrinkle[i] : along) + cloth.offset.z);
    }

    Springs<Real>& springs = grid.springs;
    const std::size_t bound = 6 * points;
    springs.a.reserve(bound);
    springs.b.reserve(bound);
    springs.rest.reserve(bound);
    springs.kind.reserve(bound);
    const auto columns = static_cast<std::uint32_t>(grid.columns);
    for_each_spring(grid.columns, grid.rows, [&](std::uint32_t a, std::uint32_t b, SpringKind kind) {
        const auto apart = [](std::uint32_t p, std::uint32_t q) { return static_cast<double>(p > q ? p - q : q - p); };
        const double gx = apart(a % columns, b % columns) * dx;
        const double gy = apart(a / columns, b / columns) * dy;
        const double gz = wrinkle[b] - wrinkle[a];
        springs.a.push_back(a);
        springs.b.push_back(b);
        springs.rest.push_back(static_cast<Real>(std::sqrt(gx * gx + gy * gy + gz * gz)));
        springs.kind.push_back(kind);
    });
    return grid;
}

template Grid<float> make_grid<float>(const Description&);
template Grid<double> make_grid<double>(const Description&);

} // namespace clothlab::sim
