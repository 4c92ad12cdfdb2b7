#include "sim/stretch_limit.h"

#include <algorithm>

namespace clothlab::sim {
namespace {

/// Where the sweep has to begin: the first vector of points with a spring that may be over the limit. Looked for by all
/// threads, since nothing is moved before it is found.
template <class Real>
std::size_t first_over_limit(const Model<Real>& model, Workspace<Real>& work, const LimitArguments<Real>& arguments) {
    const int ranges = for_ranges(model, work, [&](int index, std::size_t begin, std::size_t end) {
        work.counts[static_cast<std::size_t>(index)] = work.kernels->first_over_limit(arguments, begin, end);
    });
    return *std::min_element(work.counts.begin(), work.counts.begin() + ranges);
}

/// Whether the wavefront is the faster way for a sweep that shortens so many springs. What it costs goes by slots, of
/// which short rows have more for each point, and by the size of Real, and hardly depends on what it shortens; measured
/// from 50 x 50 to 512 x 512.
template <class Real>
bool bands_pay(const Grid<Real>& grid, std::size_t shortened) {
    const auto slots = static_cast<std::size_t>(grid.columns + band_lag * (band_rows - 1));
    return 64 * shortened > static_cast<std::size_t>(grid.rows) * slots * sizeof(Real);
}

/// The sweep as a wavefront, band by band.
template <class Real>
std::size_t limit_by_bands(const LimitArguments<Real>& a, Workspace<Real>& work) {
    LimitBands<Real>& bands = work.bands;
    const Grid<Real>& grid = *bands.grid;
    BandArguments<Real> band{};
    for (std::size_t s = 0; s < stencil_size; ++s)
        band.rest_of_all[s] = grid.rest[s][0];
    band.columns = grid.columns;
    std::size_t shortened = 0;
    for (std::size_t b = 0; b < bands.count(); ++b) {
        const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(b) * band_rows, place = LimitBands<Real>::place(0);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            band.points[axis] = a.x[axis] + row * grid.columns;
            band.x[axis] = bands.position.axes()[axis] + place;
        }
        band.free = bands.free[b].empty() ? nullptr : bands.free[b].data() + place;
        if (bands.rest.empty())
            band.exists = bands.exists[bands.exists_of[b]].data();
        else
            band.rest = bands.rest[b].data();
        band.above = std::min(row, band_halo);
        band.rows = std::min<std::ptrdiff_t>(band_rows, grid.rows - row);
        shortened += work.kernels->limit_band(band);
    }
    return shortened;
}

} // namespace

template <class Real>
std::size_t limit_stretch(const Model<Real>& model, State<Real>& state, Workspace<Real>& work) {
    const Grid<Real>& grid = *model.grid;
    const LimitArguments<Real> arguments{
        state.position.axes(), grid.points(),       static_cast<std::size_t>(grid.columns),
        rest_lengths(grid),    model.pinned.data(), may_filter_limit(grid.shortest) && may_filter_limit(grid.longest)};
    std::size_t& shortened = work.last_shortened;
    if (work.kernels && arguments.filter && work.bands.grid && bands_pay(grid, shortened)) {
        shortened = limit_by_bands(arguments, work);
    } else if (work.kernels && arguments.filter) {
        const bool look_first = shortened == 0 && work.pool && work.choice.threads() > 1;
        const std::size_t from = look_first ? first_over_limit(model, work, arguments) : 0;
        shortened = work.kernels->limit(arguments, from);
    } else {
        shortened = 0;
        for (std::size_t i = 0; i < arguments.points; ++i)
            shortened += static_cast<std::size_t>(std::popcount(limit_point(arguments, i)));
    }
    return shortened;
}

template std::size_t limit_stretch<float>(const Model<float>&, State<float>&, Workspace<float>&);
template std::size_t limit_stretch<double>(const Model<double>&, State<double>&, Workspace<double>&);

} // namespace clothlab::sim
