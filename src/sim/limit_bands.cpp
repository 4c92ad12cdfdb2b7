#include "sim/limit_bands.h"

#include <algorithm>
#include <limits>

namespace clothlab::sim {
namespace {

constexpr std::size_t most_bytes = std::size_t{64} << 20;

std::ptrdiff_t slots_of(std::ptrdiff_t columns) {
    return columns + band_lag * (band_rows - 1);
}

/// Calls visit(slot, row of the band, point) for all points of the band that begins at a row, and of `above` rows more.
template <class Real, class Visit>
void for_points_of_band(const Grid<Real>& grid, std::ptrdiff_t first, std::ptrdiff_t above, Visit visit) {
    const std::ptrdiff_t rows = std::min<std::ptrdiff_t>(band_rows, grid.rows - first);
    for (std::ptrdiff_t row = -std::min(first, above); row < rows; ++row)
        for (std::ptrdiff_t column = 0; column < grid.columns; ++column)
            visit(column + band_lag * row, row, static_cast<std::size_t>((first + row) * grid.columns + column));
}

/// Calls visit(entry, row of the band, spring, point) for all springs of a band's points; entry = slot, then spring.
template <class Real, class Visit>
void for_springs_of_band(const Grid<Real>& grid, std::ptrdiff_t first, Visit visit) {
    for_points_of_band(grid, first, 0, [&](std::ptrdiff_t slot, std::ptrdiff_t row, std::size_t point) {
        const std::ptrdiff_t column = slot - band_lag * row;
        for (std::size_t s = 0; s < stencil_size; ++s) {
            const SpringStencil& spring = spring_stencil[s];
            const std::ptrdiff_t to = column + spring.columns;
            if (to >= 0 && to < grid.columns && first + row + spring.rows >= 0)
                visit(static_cast<std::size_t>(slot) * stencil_size + s, static_cast<std::size_t>(row), s, point);
        }
    });
}

} // namespace

template <class Real>
std::size_t LimitBands<Real>::bytes() const {
    std::size_t sum = position.bytes() + pins.capacity() * sizeof(pins[0]);
    for (const AlignedVector<Real>& values : rest)
        sum += values.capacity() * sizeof(Real);
    for (const std::vector<std::uint32_t>& bits : exists)
        sum += bits.capacity() * sizeof(bits[0]);
    for (const AlignedVector<Real>& values : free)
        sum += values.capacity() * sizeof(Real);
    return sum;
}

template <class Real>
void make_bands(const Model<Real>& model, LimitBands<Real>& bands) {
    if (bands.grid == model.grid && bands.pins == model.pins)
        return;
    bands = {};
    const Grid<Real>& grid = *model.grid;
    const bool alike = grid.rest_mask == 0;
    const auto entries = static_cast<std::size_t>(slots_of(grid.columns)) * stencil_size;
    const auto count = static_cast<std::size_t>((grid.rows + band_rows - 1) / band_rows);
    if (!alike && count * entries * band_rows * sizeof(Real) > most_bytes)
        return;
    bands.grid = model.grid;
    bands.pins = model.pins;
    const auto values = static_cast<std::size_t>((slots_before + slots_of(grid.columns)) * band_stride);
    bands.position.resize(values);
    bands.free.resize(count);
    for (std::size_t b = 0; b < count; ++b) {
        const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(b) * band_rows;
        for_points_of_band(grid, first, band_halo, [&](std::ptrdiff_t slot, std::ptrdiff_t row, std::size_t point) {
            if (model.pinned[point] == 0)
                return;
            if (bands.free[b].empty())
                bands.free[b].assign(values, Real(1));
            bands.free[b][static_cast<std::size_t>(LimitBands<Real>::place(0) + slot * band_stride + row)] = 0;
        });
        if (!alike) {
            bands.rest.emplace_back(entries * band_rows, std::numeric_limits<Real>::infinity());
            for_springs_of_band(grid, first, [&](std::size_t entry, std::size_t row, std::size_t s, std::size_t point) {
                bands.rest.back()[entry * band_rows + row] = grid.rest_length(s, point);
            });
            continue;
        }
        // All bands but the first and the last are the same.
        if (b < 2 || first + band_rows > grid.rows) {
            bands.exists.emplace_back(entries, 0u);
            for_springs_of_band(grid, first, [&](std::size_t entry, std::size_t row, std::size_t, std::size_t) {
                bands.exists.back()[entry] |= 1u << row;
            });
        }
        bands.exists_of.push_back(bands.exists.size() - 1);
    }
}

template struct LimitBands<float>;
template struct LimitBands<double>;
template void make_bands<float>(const Model<float>&, LimitBands<float>&);
template void make_bands<double>(const Model<double>&, LimitBands<double>&);

} // namespace clothlab::sim
