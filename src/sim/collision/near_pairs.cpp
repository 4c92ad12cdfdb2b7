#include "sim/collision/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clothlab::sim {
namespace {

/// The list's skin as a multiple of the distance at which points touch: a wider one lasts longer and lists more pairs.
constexpr double skin_share = 1;
/// A list that does not last so many steps costs more than it saves.
constexpr int least_age = 6;
/// Of the farthest that a point could be pushed: less is not worth telling apart.
constexpr double least_push = 1.0 / 64;

/// Cells of a box around all points, not more than most_cells(), each at least `size` wide and a little more, for the
/// rounding in Real: x fastest.
template <class Real>
struct Box {
    /// Along one axis: so that single precision tells a hundredth of a cell.
    static constexpr double most_along = 1e4;

    Box(const Vec3Array<Real>& position, double size) {
        const auto axes = position.axes();
        std::array<double, 3> extent;
        double bound_so_far = 0;
        bool finite = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Real low = axes[axis][0], high = low;
            bool inside = true;
            for (std::size_t i = 0; i < position.size(); ++i) {
                const Real v = axes[axis][i];
                low = v < low ? v : low;
                high = v > high ? v : high;
                inside &= std::abs(v) <= std::numeric_limits<Real>::max(); // neither infinite nor NaN
            }
            finite = finite && inside;
            from[axis] = low;
            extent[axis] = static_cast<double>(high) - static_cast<double>(low);
            bound_so_far =
                std::max({bound_so_far, std::abs(static_cast<double>(low)), std::abs(static_cast<double>(high))});
        }
        bound = bound_so_far;
        const double longest = *std::max_element(extent.begin(), extent.end());
        usable = finite && std::isfinite(longest);
        size *= 1.01;
        const auto cells = [&](double cell) {
            double total = 1;
            for (const double e : extent)
                total *= std::floor(e / cell) + 2;
            return total;
        };
        while (usable &&
               (cells(size) > static_cast<double>(most_cells(position.size())) || longest > most_along * size))
            size *= 1.1;
        per_metre = static_cast<Real>(1 / size);
        for (std::size_t axis = 0; axis < 3; ++axis)
            count[axis] = usable ? static_cast<std::uint32_t>(extent[axis] / size) + 2 : 1;
    }
    std::uint32_t cell(Real x, Real y, Real z) const {
        const auto along = [&](std::size_t axis, Real v) {
            return static_cast<std::uint32_t>(static_cast<std::int32_t>((v - from[axis]) * per_metre));
        };
        return (along(2, z) * count[1] + along(1, y)) * count[0] + along(0, x);
    }
    std::array<Real, 3> from{};
    Real per_metre = 0;
    double bound = 0;    ///< m, largest coordinate
    bool usable = false; ///< finite
    std::array<std::uint32_t, 3> count{};
};

/// Makes the list anew. False when the points are no longer finite, or the list would be too long.
template <class Real>
bool list_far_pairs(const Model<Real>& model, const Vec3Array<Real>& position, Workspace<Real>& work) {
    SelfCollisionWork<Real>& s = work.self_collision;
    const std::size_t points = position.size();
    const double apart = 2 * static_cast<double>(model.thickness);
    s.skin = skin_share * apart;
    s.far_pairs.clear();
    const double most = reach_of(model, farthest_push(model), s.coordinate_bound) + s.skin;
    const Box<Real> box(position, most);
    if (!box.usable)
        return false;

    // Counting sort by cell.
    const std::size_t cells = std::size_t{box.count[0]} * box.count[1] * box.count[2];
    std::fill_n(s.cell_end.begin(), cells, 0u);
    for (std::size_t i = 0; i < points; ++i)
        s.key[i] = box.cell(position.x[i], position.y[i], position.z[i]);
    for (std::size_t i = 0; i < points; ++i)
        ++s.cell_end[s.key[i]];
    std::uint32_t begin = 0;
    for (std::size_t c = 0; c < cells; ++c)
        begin += std::exchange(s.cell_end[c], begin);
    const std::array<Real*, 4> sorted = s.sorted_axes();
    Real* index = sorted[3];
    for (std::uint32_t i = 0; i < points; ++i) {
        const std::uint32_t k = s.cell_end[s.key[i]]++;
        s.order[k] = i;
        sorted[0][k] = position.x[i];
        sorted[1][k] = position.y[i];
        sorted[2][k] = position.z[i];
        index[k] = static_cast<Real>(i);
    }

    s.far_pairs.resize(most_far_pairs(points));
    const std::size_t found = work.kernels->far_pairs({{sorted[0], sorted[1], sorted[2]},
                                                       s.order.data(),
                                                       index,
                                                       s.cell_end.data(),
                                                       box.count,
                                                       static_cast<std::uint32_t>(model.grid->columns),
                                                       static_cast<Real>(most * most),
                                                       s.far_pairs.data(),
                                                       s.far_pairs.size()});
    const bool all_found = found <= s.far_pairs.size();
    s.far_pairs.resize(all_found ? found : 0);
    if (!all_found)
        return false;
    s.anchor = position;
    s.anchor_bound = box.bound;
    s.age = 0;
    return true;
}

/// How far points have moved against each other, and whether too many neighbours in the grid are near each other to be
/// listed.
struct Proximity {
    bool too_many = false;
    double spread = 0;  ///< m, no two displacements since the list was made differ by more
    double largest = 0; ///< m, displacement
};

template <class Real>
Proximity look_at_neighbours(const Model<Real>& model, const Vec3Array<Real>& position, Workspace<Real>& work,
                             Real reach_squared) {
    SelfCollisionWork<Real>& s = work.self_collision;
    const ConstAxes<Real> anchor = s.anchored ? std::as_const(s.anchor).axes() : ConstAxes<Real>{};
    const int ranges = for_ranges(model, work, [&](int index, std::size_t begin, std::size_t end) {
        // Each thread has a part of the list that is in proportion to its points.
        ProximityArguments<Real>& part = work.proximity[static_cast<std::size_t>(index)];
        part = {position.axes(),
                anchor,
                position.size(),
                static_cast<std::size_t>(model.grid->columns),
                begin,
                end,
                reach_squared,
                s.pairs.data() + begin,
                end - begin,
                {},
                {},
                0};
        work.kernels->proximity(part);
    });
    Proximity result;
    std::size_t count = 0;
    std::array<double, 3> low, high;
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (int r = 0; r < ranges; ++r) {
        const ProximityArguments<Real>& part = work.proximity[static_cast<std::size_t>(r)];
        result.too_many = result.too_many || part.count > part.most_pairs;
        if (!result.too_many)
            count = static_cast<std::size_t>(std::copy(part.pairs, part.pairs + part.count, s.pairs.data() + count) -
                                             s.pairs.data());
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], static_cast<double>(part.low[axis]));
            high[axis] = std::max(high[axis], static_cast<double>(part.high[axis]));
            if (s.anchored)
                result.largest = std::max({result.largest, std::abs(low[axis]), std::abs(high[axis])});
        }
    }
    s.pair_count = result.too_many ? 0 : count;
    result.spread = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    return result;
}

template <class Real>
Real reach_squared(const Model<Real>& model, const SelfCollisionWork<Real>& s) {
    const double reach = reach_of(model, s.push, s.coordinate_bound);
    return static_cast<Real>(reach * reach * (1 + 8 * static_cast<double>(std::numeric_limits<Real>::epsilon())));
}

/// All pairs that the rule could concern, of those listed and of neighbours, as long as no point is pushed farther than
/// s.push. Returns how far one is in fact pushed at most: when its turn comes, none of its partners has come nearer by
/// more than that.
template <class Real>
double keep_near_pairs(const Model<Real>& model, const Vec3Array<Real>& position, SelfCollisionWork<Real>& s,
                       const Kernels<Real>& kernels) {
    const CellArguments<Real> cells{position.axes(), position.size(), {model.cell_x, model.cell_y, model.cell_z}};
    std::copy(s.far_pairs.begin(), s.far_pairs.end(), s.pairs.begin() + static_cast<std::ptrdiff_t>(s.pair_count));
    s.pair_count += s.far_pairs.size();
    const KeptPairs<Real> kept = kernels.keep_pairs(cells, reach_squared(model, s), s.pairs.data(), s.pair_count);
    s.pair_count = kept.count;
    constexpr double rounding = std::numeric_limits<Real>::epsilon();
    const double apart = 2 * static_cast<double>(model.thickness), farthest = farthest_push(model);
    const double missing = apart - std::sqrt(static_cast<double>(kept.least_squared)) * (1 - 64 * rounding) +
                           8 * rounding * s.coordinate_bound;
    return model.substeps > 1 ? std::clamp(missing / (model.substeps - 1), 0.0, farthest) : farthest;
}

/// Leaves the list for some time. Returns false.
template <class Real>
bool leave(SelfCollisionWork<Real>& s) {
    s.anchored = false;
    s.list_rests.leave();
    return false;
}

} // namespace

template <class Real>
double farthest_push(const Model<Real>& model) {
    return 2 * static_cast<double>(model.thickness) / model.substeps;
}

template <class Real>
double reach_of(const Model<Real>& model, double push, double coordinate_bound) {
    const double apart = 2 * static_cast<double>(model.thickness);
    constexpr double rounding = std::numeric_limits<Real>::epsilon();
    return (apart + push) * (1 + 64 * rounding) + 8 * rounding * coordinate_bound;
}

template <class Real>
bool find_pairs(const Model<Real>& model, const Vec3Array<Real>& position, Workspace<Real>& work) {
    SelfCollisionWork<Real>& s = work.self_collision;
    if (s.list_rests.waits())
        return false;
    // Most steps push no point nearly as far as one could be pushed, and so a smaller reach will do.
    const double farthest = farthest_push(model);
    s.push = std::min(s.push, farthest);
    Proximity proximity = look_at_neighbours(model, position, work, reach_squared(model, s));
    if (proximity.too_many)
        return leave(s);
    s.age = std::min(s.age + 1, 1 << 20);
    constexpr double rounding = std::numeric_limits<Real>::epsilon();
    if (!s.anchored || !(proximity.spread <= s.skin * (1 - 1e-3) - 8 * rounding * s.coordinate_bound)) {
        if (s.anchored && s.age < least_age)
            return leave(s);
        s.anchored = list_far_pairs(model, position, work);
        if (!s.anchored)
            return leave(s);
        proximity.largest = 0;
    } else if (s.age == 4 * least_age) {
        s.list_rests.pays();
    }
    const double bound = s.anchor_bound + proximity.largest;
    if (!(bound <= s.coordinate_bound)) { // the reach was too small for points so far out
        s.coordinate_bound = std::isfinite(bound) ? 2 * bound + 1 : s.coordinate_bound;
        s.anchored = false;
        return false;
    }
    const double push = keep_near_pairs(model, position, s, *work.kernels);
    if (push > s.push) {
        s.push = farthest;
        if (look_at_neighbours(model, position, work, reach_squared(model, s)).too_many)
            return leave(s);
        keep_near_pairs(model, position, s, *work.kernels);
    }
    s.push = std::max({2 * push, 0.9 * s.push, least_push * farthest});
    return true;
}

#define CLOTHLAB_DEFINE(Real)                                                                                          \
    template bool find_pairs<Real>(const Model<Real>&, const Vec3Array<Real>&, Workspace<Real>&);                      \
    template double farthest_push<Real>(const Model<Real>&);                                                           \
    template double reach_of<Real>(const Model<Real>&, double, double);
CLOTHLAB_DEFINE(float)
CLOTHLAB_DEFINE(double)
#undef CLOTHLAB_DEFINE

} // namespace clothlab::sim
