#include "sim/collision/active_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace clothlab::sim {
namespace {

/// The list's skin as a multiple of the distance at which points touch. A wider one lasts longer and lists more pairs.
constexpr double skin_share = 1;
/// Where the list would be longer than the cloth has points, all of them are active for so many steps.
constexpr int steps_without_list = 32;

/// The distance from which on two points of a stage's beginning cannot touch in it: a point is moved once, by the mean
/// of its missing distances over the substeps, and its position is rounded once more.
template <class Real>
double reach_of(const Model<Real>& model, double coordinate_bound) {
    const double apart = 2 * static_cast<double>(model.thickness);
    constexpr double rounding = std::numeric_limits<Real>::epsilon();
    return (apart + apart / model.substeps) * (1 + 64 * rounding) + 8 * rounding * coordinate_bound;
}

bool neighbours(std::uint32_t a, std::uint32_t b, std::uint32_t columns) {
    const auto apart = [](std::uint32_t p, std::uint32_t q) { return p > q ? p - q : q - p; };
    return apart(a % columns, b % columns) <= 1 && apart(a / columns, b / columns) <= 1;
}

/// Cells of a box around all points, not more than most_cells(), each at least `size` wide: x fastest.
template <class Real>
struct Box {
    Box(const Vec3Array<Real>& position, double size) {
        const auto axes = position.axes();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Real low = axes[axis][0], high = low, zero = 0;
            for (std::size_t i = 0; i < position.size(); ++i) {
                low = std::min(low, axes[axis][i]);
                high = std::max(high, axes[axis][i]);
                zero += axes[axis][i] * 0; // not if it is infinite or NaN
            }
            finite = finite && zero == 0;
            from[axis] = static_cast<double>(low);
            extent[axis] = static_cast<double>(high) - from[axis];
            bound = std::max({bound, std::abs(from[axis]), std::abs(static_cast<double>(high))});
        }
        for (usable = finite && bound < 1e6 * size;; size *= 1.25) {
            double total = 1;
            for (std::size_t axis = 0; axis < 3; ++axis)
                total *= std::floor(extent[axis] / size) + 1;
            if (!usable || total <= static_cast<double>(most_cells(position.size())))
                break;
        }
        per_metre = 1 / size;
        for (std::size_t axis = 0; axis < 3; ++axis)
            count[axis] = usable ? static_cast<std::uint32_t>(extent[axis] * per_metre) + 1 : 1;
    }
    std::uint32_t along(std::size_t axis, Real v) const {
        return std::min(static_cast<std::uint32_t>((static_cast<double>(v) - from[axis]) * per_metre), count[axis] - 1);
    }
    std::array<double, 3> from{}, extent{};
    double bound = 0, per_metre = 0;
    bool finite = true;
    bool usable = false; ///< finite, and small enough for whole numbers
    std::array<std::uint32_t, 3> count{};
};

/// Makes the list anew. False when the points are no longer finite, or the list would be too long.
template <class Real>
bool list_pairs(const Model<Real>& model, const Vec3Array<Real>& position, SelfCollisionWork<Real>& s) {
    const std::size_t points = position.size();
    const double apart = 2 * static_cast<double>(model.thickness);
    s.skin = skin_share * apart;
    s.pairs.clear();
    const double most = reach_of(model, s.coordinate_bound) + s.skin;
    const Box<Real> box(position, most);
    if (!box.usable)
        return false;

    // Counting sort by cell.
    const std::size_t cells = std::size_t{box.count[0]} * box.count[1] * box.count[2];
    std::fill_n(s.bucket_end.begin(), cells, 0u);
    for (std::size_t i = 0; i < points; ++i) {
        s.bucket[i] = (box.along(2, position.z[i]) * box.count[1] + box.along(1, position.y[i])) * box.count[0] +
                      box.along(0, position.x[i]);
        ++s.bucket_end[s.bucket[i]];
    }
    std::uint32_t begin = 0;
    for (std::size_t c = 0; c < cells; ++c)
        begin += std::exchange(s.bucket_end[c], begin);
    for (std::uint32_t i = 0; i < points; ++i) {
        const std::uint32_t k = s.bucket_end[s.bucket[i]]++;
        s.order[k] = i;
        s.sorted.x[k] = position.x[i];
        s.sorted.y[k] = position.y[i];
        s.sorted.z[k] = position.z[i];
    }

    // Each pair is met once: of a point's own cell and its neighbours, those that come later in the sorted order. Three
    // cells along x are one run.
    const auto columns = static_cast<std::uint32_t>(model.grid->columns);
    const Real square = static_cast<Real>(most * most);
    const auto cell_begin = [&](std::size_t c) { return c == 0 ? 0 : s.bucket_end[c - 1]; };
    for (std::uint32_t k = 0; k < points; ++k) {
        const std::uint32_t i = s.order[k];
        const std::uint32_t cx = s.bucket[i] % box.count[0], cy = s.bucket[i] / box.count[0] % box.count[1],
                            cz = s.bucket[i] / box.count[0] / box.count[1];
        const std::uint32_t first_x = cx > 0 ? cx - 1 : 0, last_x = std::min(cx + 1, box.count[0] - 1);
        const auto run = [&](std::uint32_t from, std::uint32_t to) {
            for (std::uint32_t q = from; q < to; ++q) {
                const Real dx = s.sorted.x[q] - s.sorted.x[k], dy = s.sorted.y[q] - s.sorted.y[k],
                           dz = s.sorted.z[q] - s.sorted.z[k];
                if (dx * dx + dy * dy + dz * dz <= square && !neighbours(i, s.order[q], columns)) {
                    if (s.pairs.size() == s.pairs.capacity())
                        return false;
                    s.pairs.push_back({i, s.order[q]});
                }
            }
            return true;
        };
        const auto row_begin = [&](std::uint32_t y, std::uint32_t z) {
            return (std::size_t{z} * box.count[1] + y) * box.count[0];
        };
        if (!run(k + 1, s.bucket_end[row_begin(cy, cz) + last_x]))
            return false;
        for (int next = 0; next < 4; ++next) { // the row after, and the three of the layer after
            const std::uint32_t z = next == 0 ? cz : cz + 1;
            const std::uint32_t y = next == 0 ? cy + 1 : cy + static_cast<std::uint32_t>(next) - 2;
            if (z >= box.count[2] || y >= box.count[1]) // also when y was 0 - 1
                continue;
            if (!run(cell_begin(row_begin(y, z) + first_x), s.bucket_end[row_begin(y, z) + last_x]))
                return false;
        }
    }
    s.anchor = position;
    s.anchor_bound = box.bound;
    return true;
}

template <class Real>
void all_active(SelfCollisionWork<Real>& s, std::size_t points) {
    s.active.resize(points);
    std::iota(s.active.begin(), s.active.end(), 0u);
}

/// What the neighbours in the grid have to say, and how far points have moved against each other.
struct Proximity {
    std::size_t pairs = 0;
    double spread = 0;  ///< m, no two displacements since the list was made differ by more
    double largest = 0; ///< m, displacement
};

template <class Real>
Proximity look_at_neighbours(const Model<Real>& model, const Vec3Array<Real>& position, Workspace<Real>& work,
                             Real reach_squared) {
    SelfCollisionWork<Real>& s = work.self_collision;
    std::fill(s.near.begin(), s.near.end(), std::uint8_t{0});
    const ConstAxes<Real> anchor = s.anchored ? std::as_const(s.anchor).axes() : ConstAxes<Real>{};
    const int ranges = for_ranges(model, work, [&](int index, std::size_t begin, std::size_t end) {
        ProximityArguments<Real>& part = work.proximity[static_cast<std::size_t>(index)];
        part = {position.axes(),
                anchor,
                position.size(),
                static_cast<std::size_t>(model.grid->columns),
                begin,
                end,
                reach_squared,
                s.near.data(),
                {},
                {},
                0};
        work.kernels->proximity(part);
    });
    Proximity result;
    std::array<double, 3> low, high;
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (int r = 0; r < ranges; ++r) {
        const ProximityArguments<Real>& part = work.proximity[static_cast<std::size_t>(r)];
        result.pairs += part.pairs;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], static_cast<double>(part.low[axis]));
            high[axis] = std::max(high[axis], static_cast<double>(part.high[axis]));
            if (s.anchored)
                result.largest = std::max({result.largest, std::abs(low[axis]), std::abs(high[axis])});
        }
    }
    result.spread = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    return result;
}

} // namespace

template <class Real>
void find_active_points(const Model<Real>& model, const Vec3Array<Real>& position, Workspace<Real>& work) {
    SelfCollisionWork<Real>& s = work.self_collision;
    const std::size_t points = position.size();
    const double reach = reach_of(model, s.coordinate_bound);
    const Real reach_squared = static_cast<Real>(reach * reach * (1 + 8 * std::numeric_limits<Real>::epsilon()));
    Proximity neighbours = look_at_neighbours(model, position, work, reach_squared);
    // Most of the cloth touches itself already, as a fine grid of thick points does.
    if (neighbours.pairs > points / 2)
        return all_active(s, points);

    constexpr double rounding = std::numeric_limits<Real>::epsilon();
    if (!s.anchored || !(neighbours.spread <= s.skin * (1 - 1e-3) - 8 * rounding * s.coordinate_bound)) {
        s.anchored = false;
        if (s.give_up > 0) {
            --s.give_up;
            return all_active(s, points);
        }
        s.anchored = list_pairs(model, position, s);
        if (!s.anchored) {
            s.give_up = steps_without_list;
            return all_active(s, points);
        }
        neighbours.largest = 0;
    }
    const double bound = s.anchor_bound + neighbours.largest;
    if (!(bound <= s.coordinate_bound)) { // the reach was too small for points so far out
        s.coordinate_bound = std::isfinite(bound) ? 2 * bound + 1 : s.coordinate_bound;
        s.anchored = false;
        return all_active(s, points);
    }

    for (const auto& [a, b] : s.pairs) {
        const Real dx = position.x[b] - position.x[a], dy = position.y[b] - position.y[a],
                   dz = position.z[b] - position.z[a];
        if (dx * dx + dy * dy + dz * dz < reach_squared)
            s.near[a] = s.near[b] = 1;
    }
    s.active.clear();
    if (neighbours.pairs == 0 && s.pairs.empty())
        return;
    for (std::uint32_t i = 0; i < points; ++i)
        if (s.near[i])
            s.active.push_back(i);
}

template void find_active_points<float>(const Model<float>&, const Vec3Array<float>&, Workspace<float>&);
template void find_active_points<double>(const Model<double>&, const Vec3Array<double>&, Workspace<double>&);

} // namespace clothlab::sim
