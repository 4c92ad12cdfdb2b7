// Which points are near each other: neighbours in the grid, all others by a box of cells, and which of such pairs lie
// in one of the course's cells.
#if defined(CLOTHLAB_SIM_KERNELS_NEAR_PAIRS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLOTHLAB_SIM_KERNELS_NEAR_PAIRS_INL_H
#undef CLOTHLAB_SIM_KERNELS_NEAR_PAIRS_INL_H
#else
#define CLOTHLAB_SIM_KERNELS_NEAR_PAIRS_INL_H
#endif

#include <bit>
#include <limits>

#include "sim/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clothlab::sim::HWY_NAMESPACE {

template <class Real>
void proximity(ProximityArguments<Real>& a) {
    const Tag<Real> d;
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    Lane3<Real> low = set3(infinity, infinity, infinity), high = set3(-infinity, -infinity, -infinity);
    const auto columns = static_cast<std::ptrdiff_t>(a.columns);
    const auto end = static_cast<std::ptrdiff_t>(a.end);
    const auto reach = hn::Set(d, a.reach_squared);
    Columns<Real> column(a.columns, a.begin);
    std::size_t pairs = 0;
    const auto pair = [&](std::ptrdiff_t i, std::ptrdiff_t other) {
        if (pairs < a.most_pairs)
            a.pairs[pairs] = {static_cast<std::uint32_t>(other), static_cast<std::uint32_t>(i)};
        ++pairs;
    };
    const auto near_one = [&](std::ptrdiff_t i, std::ptrdiff_t other) {
        const Real dx = a.x[0][other] - a.x[0][i], dy = a.x[1][other] - a.x[1][i], dz = a.x[2][other] - a.x[2][i];
        if (!(dx * dx + dy * dy + dz * dz >= a.reach_squared))
            pair(i, other);
    };

    for (auto i = static_cast<std::ptrdiff_t>(a.begin); i < end; i += lanes<Real>, column.advance()) {
        const Lane3<Real> x = load3(a.x, i);
        const LaneMask<Real> inside = lanes_before<Real>(end - i);
        if (a.anchor[0]) {
            const Lane3<Real> u = subtract3(x, load3(a.anchor, i));
            const Lane3<Real> u_low = choose3(inside, u, low), u_high = choose3(inside, u, high);
            low = {hn::Min(low.x, u_low.x), hn::Min(low.y, u_low.y), hn::Min(low.z, u_low.z)};
            high = {hn::Max(high.x, u_high.x), hn::Max(high.y, u_high.y), hn::Max(high.z, u_high.z)};
        }
        if (i < columns + 1) { // no whole row before it: one by one
            for (std::ptrdiff_t j = i; j < HWY_MIN(i + lanes<Real>, end); ++j) {
                const std::ptrdiff_t c = j % columns;
                if (c > 0)
                    near_one(j, j - 1);
                if (j >= columns)
                    near_one(j, j - columns);
                if (j >= columns && c > 0)
                    near_one(j, j - columns - 1);
                if (j >= columns && c + 1 < columns)
                    near_one(j, j - columns + 1);
            }
            continue;
        }
        // Not "nearer than", so that NaN counts as near: such a point is to be looked at.
        const auto near = [&](std::ptrdiff_t other) HWY_ATTR {
            const Lane3<Real> v = subtract3(load3(a.x, i + other), x);
            return hn::And(hn::Not(hn::Ge(dot3(v, v), reach)), inside);
        };
        const auto left = hn::And(near(-1), column.has_left());
        const auto up = near(-columns);
        const auto upper_left = hn::And(near(-columns - 1), column.has_left());
        const auto upper_right = hn::And(near(-columns + 1), column.has_right());
        if (HWY_LIKELY(hn::AllFalse(d, hn::Or(hn::Or(left, up), hn::Or(upper_left, upper_right)))))
            continue;
        const auto mark = [&](LaneMask<Real> mask, std::ptrdiff_t other) HWY_ATTR {
            for (std::uint32_t bits = bits_of<Real>(mask); bits != 0; bits &= bits - 1) {
                const std::ptrdiff_t j = i + std::countr_zero(bits);
                pair(j, j + other);
            }
        };
        mark(left, -1);
        mark(up, -columns);
        mark(upper_left, -columns - 1);
        mark(upper_right, -columns + 1);
    }
    a.count = pairs;
    HWY_ALIGN Real lane_values[HWY_LANES(Real)];
    const auto reduce = [&](Lane<Real> v, bool smallest) HWY_ATTR {
        hn::Store(v, d, lane_values);
        Real result = lane_values[0];
        for (const Real value : lane_values)
            result = smallest ? HWY_MIN(result, value) : HWY_MAX(result, value);
        return result;
    };
    a.low = {reduce(low.x, true), reduce(low.y, true), reduce(low.z, true)};
    a.high = {reduce(high.x, false), reduce(high.y, false), reduce(high.z, false)};
}

template <class Real>
std::size_t far_pairs(const FarPairArguments<Real>& a) {
    const Tag<Real> d;
    const auto reach = hn::Set(d, a.reach_squared), one = hn::Set(d, Real(1));
    const auto row_before = hn::Set(d, static_cast<Real>(a.columns - 1)),
               row_after = hn::Set(d, static_cast<Real>(a.columns + 1));
    const auto [nx, ny, nz] = a.cells;
    std::size_t count = 0;
    const auto cell_begin = [&](std::size_t cell) { return cell == 0 ? 0 : a.cell_end[cell - 1]; };
    std::uint32_t k = 0;
    for (std::uint32_t z = 0; z < nz; ++z)
        for (std::uint32_t y = 0; y < ny; ++y) {
            const std::size_t row = (std::size_t{z} * ny + y) * nx;
            if (a.cell_end[row + nx - 1] == k)
                continue; // an empty row of cells
            for (std::uint32_t x = 0; x < nx; ++x) {
                const std::uint32_t cell_end = a.cell_end[row + x];
                if (k == cell_end)
                    continue;
                // Each pair is met once, at the point that comes first in the order: in what is left of its own cell
                // and the one after, in the row after, and in the three of the layer after. Three cells along x are one
                // run.
                const std::uint32_t first = x > 0 ? x - 1 : 0, last = HWY_MIN(x + 1, nx - 1);
                std::uint32_t from[5], to[5];
                int runs = 1;
                to[0] = a.cell_end[row + last];
                for (int next = 0; next < 4; ++next) {
                    const std::uint32_t next_z = next == 0 ? z : z + 1;
                    const std::uint32_t next_y = next == 0 ? y + 1 : y + static_cast<std::uint32_t>(next) - 2;
                    if (next_z >= nz || next_y >= ny) // the latter also when y was 0 - 1
                        continue;
                    const std::size_t next_row = (std::size_t{next_z} * ny + next_y) * nx;
                    from[runs] = cell_begin(next_row + first);
                    to[runs] = a.cell_end[next_row + last];
                    runs += from[runs] < to[runs] ? 1 : 0;
                }
                for (; k < cell_end; ++k) {
                    const std::uint32_t i = a.order[k], column = i % a.columns;
                    const bool at_border = column == 0 || column + 1 == a.columns;
                    const auto index = hn::Set(d, a.index[k]);
                    const Lane3<Real> point = set3(a.sorted[0][k], a.sorted[1][k], a.sorted[2][k]);
                    from[0] = k + 1;
                    for (int r = 0; r < runs; ++r)
                        for (std::uint32_t q = from[r]; q < to[r]; q += HWY_LANES(Real)) {
                            const Lane3<Real> v = subtract3(load3(a.sorted, q), point);
                            // The eight around it in the grid, or across the border from the end of one row to the
                            // beginning of the next.
                            const auto apart = hn::Abs(hn::Sub(hn::LoadU(d, a.index + q), index));
                            const auto around = hn::Or(hn::Eq(apart, one),
                                                       hn::And(hn::Ge(apart, row_before), hn::Le(apart, row_after)));
                            auto near = hn::And(hn::Le(dot3(v, v), reach),
                                                lanes_before<Real>(static_cast<std::ptrdiff_t>(to[r] - q)));
                            if (HWY_LIKELY(!at_border))
                                near = hn::AndNot(around, near);
                            if (HWY_LIKELY(hn::AllFalse(d, near)))
                                continue;
                            for (std::uint32_t bits = bits_of<Real>(near); bits != 0; bits &= bits - 1) {
                                const std::uint32_t j = a.order[q + static_cast<std::uint32_t>(std::countr_zero(bits))];
                                if (at_border) {
                                    const std::uint32_t to_column = j % a.columns;
                                    const std::uint32_t rows =
                                        i > j ? i / a.columns - j / a.columns : j / a.columns - i / a.columns;
                                    if (rows <= 1 && to_column + 1 >= column && to_column <= column + 1)
                                        continue;
                                }
                                if (count == a.most_pairs)
                                    return count + 1;
                                a.pairs[count++] = {i, j};
                            }
                        }
                }
            }
        }
    return count;
}

/// Cells along one axis, kept as whole numbers in Real: a position of 1e30 has a cell too, and NaN equals no cell.
/// Adding zero turns -0 into 0: they are the same cell.
template <class Real>
HWY_INLINE Lane<Real> cell_of(Lane<Real> x, Real size) {
    const Tag<Real> d;
    return hn::Add(hn::Floor(hn::Div(x, hn::Set(d, size))), hn::Zero(d));
}

template <class Real>
KeptPairs<Real> keep_pairs(const CellArguments<Real>& a, Real reach_squared, PointPair* pairs, std::size_t count) {
    const Tag<Real> d;
    constexpr std::size_t step = HWY_LANES(Real);
    HWY_ALIGN Real ends[2][3][step] = {};
    KeptPairs<Real> kept;
    auto least = hn::Set(d, kept.least_squared);
    for (std::size_t k = 0; k < count; k += step) {
        const std::size_t n = HWY_MIN(count - k, step);
        for (std::size_t l = 0; l < n; ++l)
            for (std::size_t end = 0; end < 2; ++end)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    ends[end][axis][l] = a.x[axis][pairs[k + l][end]];
        auto square = hn::Zero(d);
        auto keep = lanes_before<Real>(static_cast<std::ptrdiff_t>(n));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto first = hn::Load(d, ends[0][axis]), second = hn::Load(d, ends[1][axis]);
            const auto v = hn::Sub(first, second);
            square = hn::Add(square, hn::Mul(v, v));
            keep = hn::And(keep, hn::Eq(cell_of<Real>(first, a.cell[axis]), cell_of<Real>(second, a.cell[axis])));
        }
        keep = hn::AndNot(hn::Ge(square, hn::Set(d, reach_squared)), keep);
        least = hn::IfThenElse(hn::And(keep, hn::Lt(square, least)), square, least);
        for (std::uint32_t bits = bits_of<Real>(keep); bits != 0; bits &= bits - 1)
            pairs[kept.count++] = pairs[k + static_cast<std::size_t>(std::countr_zero(bits))];
    }
    kept.least_squared = hn::GetLane(hn::MinOfLanes(d, least));
    return kept;
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
