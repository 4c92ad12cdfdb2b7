// The grid as the stretch limit's wavefront goes through it. Of two points of the Gauss-Seidel sweep in spring order
// that have no mass in common, either may come first. A point's springs reach one column to the right in the row above,
// and that row's two columns to the left: so row r may be at column c as soon as row r - 1 is done with column c + 3,
// and rows that follow each other at a distance of four columns can be done at once (the hyperplane method: L. Lamport,
// "The parallel execution of DO loops", CACM 17 (1974)). A band of rows is copied so that what is done at once lies
// side by side: column c of the band's row l at slot c + 4 l.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/aligned.h"
#include "sim/model.h"

namespace clothlab::sim {

inline constexpr std::ptrdiff_t band_lag = 4;                        ///< columns that a row is behind the one above
inline constexpr std::ptrdiff_t band_rows = 32;                      ///< a multiple of every vector's lanes
inline constexpr std::ptrdiff_t band_halo = 2;                       ///< rows of the band before, that springs reach
inline constexpr std::ptrdiff_t band_stride = band_rows + band_halo; ///< values per slot
inline constexpr std::ptrdiff_t slots_before = band_lag * band_halo; ///< of the rows before

template <class Real>
struct LimitBands {
    std::shared_ptr<const Grid<Real>> grid; ///< that they were made for; null without bands
    std::vector<std::uint32_t> pins;        ///< the same

    /// Per band at [(slot * stencil_size + spring) * band_rows + row] the rest length, infinite where there is no
    /// spring; or, where all of an entry of the stencil are alike, at [slot * stencil_size + spring] a bit for each row
    /// that has that spring. Of those the bands share what is the same.
    std::vector<AlignedVector<Real>> rest;
    std::vector<std::vector<std::uint32_t>> exists;
    std::vector<std::size_t> exists_of; ///< per band: which of them
    /// Per band, where it has pins: 1 for points that may be moved and 0 for pinned ones, as the positions lie.
    std::vector<AlignedVector<Real>> free;
    Vec3Array<Real> position; ///< m, of one band, with slots and rows before

    std::size_t count() const { return free.size(); }
    std::size_t bytes() const;
    /// Where a row of the band, from -band_halo on, has its column 0.
    static std::ptrdiff_t place(std::ptrdiff_t row) {
        return (slots_before + band_lag * row) * band_stride + band_halo + row;
    }
};

/// Makes the bands of a model's grid and pins, unless they are those that there are. None for cloths so large and of so
/// many different rest lengths that these would take more than 64 MiB once more.
template <class Real>
void make_bands(const Model<Real>& model, LimitBands<Real>& bands);

extern template struct LimitBands<float>;
extern template struct LimitBands<double>;
extern template void make_bands<float>(const Model<float>&, LimitBands<float>&);
extern template void make_bands<double>(const Model<double>&, LimitBands<double>&);

} // namespace clothlab::sim
