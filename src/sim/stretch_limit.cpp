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

} // namespace

template <class Real>
std::size_t limit_stretch(const Model<Real>& model, State<Real>& state, Workspace<Real>& work) {
    const Grid<Real>& grid = *model.grid;
    const LimitArguments<Real> arguments{
        state.position.axes(), grid.points(),       static_cast<std::size_t>(grid.columns),
        rest_lengths(grid),    model.pinned.data(), may_filter_limit(grid.shortest) && may_filter_limit(grid.longest)};
    std::size_t shortened = 0;
    if (work.kernels && arguments.filter) {
        const bool look_first = work.limit_was_idle && work.pool && work.choice.threads() > 1;
        const std::size_t from = look_first ? first_over_limit(model, work, arguments) : 0;
        shortened = work.kernels->limit(arguments, from);
    } else {
        for (std::size_t i = 0; i < arguments.points; ++i)
            shortened += static_cast<std::size_t>(std::popcount(limit_point(arguments, i)));
    }
    work.limit_was_idle = shortened == 0;
    return shortened;
}

template std::size_t limit_stretch<float>(const Model<float>&, State<float>&, Workspace<float>&);
template std::size_t limit_stretch<double>(const Model<double>&, State<double>&, Workspace<double>&);

} // namespace clothlab::sim
