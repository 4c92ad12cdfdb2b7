// What bounds the blocks of a grid: their points, and the edges between those.
#if defined(CLOTHLAB_SIM_KERNELS_BLOCK_SHAPES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLOTHLAB_SIM_KERNELS_BLOCK_SHAPES_INL_H
#undef CLOTHLAB_SIM_KERNELS_BLOCK_SHAPES_INL_H
#else
#define CLOTHLAB_SIM_KERNELS_BLOCK_SHAPES_INL_H
#endif

#include <cmath>
#include <limits>
#include <type_traits>

#include "sim/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clothlab::sim::HWY_NAMESPACE {

template <class Real>
struct LaneBounds {
    Lane3<Real> low, high;
    LaneBounds() {
        constexpr Real infinity = std::numeric_limits<Real>::infinity();
        low = set3(infinity, infinity, infinity);
        high = set3(-infinity, -infinity, -infinity);
    }
    HWY_INLINE void include(const Lane3<Real>& v) {
        low = {hn::Min(low.x, v.x), hn::Min(low.y, v.y), hn::Min(low.z, v.z)};
        high = {hn::Max(high.x, v.x), hn::Max(high.y, v.y), hn::Max(high.z, v.z)};
    }
    HWY_INLINE void store(std::size_t first, BlockShape<Real>& shape) const {
        const Tag<Real> d;
        const auto put = [&](std::size_t at, Lane<Real> lows, Lane<Real> highs) HWY_ATTR {
            shape.low[first + at] = hn::GetLane(hn::MinOfLanes(d, lows));
            shape.high[first + at] = hn::GetLane(hn::MaxOfLanes(d, highs));
        };
        put(0, low.x, high.x);
        put(1, low.y, high.y);
        put(2, low.z, high.z);
    }
};

/// One block: whole vectors of points, those of the block's columns or, at the right border, the last ones of the rows.
/// Where a point has no column before it, the edge to the next one takes its place, and the same with rows.
template <bool leftmost, class Real>
HWY_INLINE void shape_of_block(const BlockArguments<Real>& a, std::size_t block_row, std::size_t block_column,
                               std::size_t index) {
    const Tag<Real> d;
    const auto reach = hn::Set(d, a.reach_squared);
    const auto columns = static_cast<std::ptrdiff_t>(a.columns);
    const std::size_t column = block_column * block_side, from = HWY_MIN(column, a.columns - block_side);
    const std::size_t row = block_row * block_side, end = HWY_MIN(row + block_side, a.rows);
    LaneBounds<Real> points, along_row, along_column;
    Lane<Real> total = hn::Zero(d);
    std::uint32_t near_left = 0, near_up = 0; // a bit per column
    const auto look = [&](std::size_t r, auto has_row_before) HWY_ATTR {
        for (std::size_t s = 0; s < block_side; s += HWY_LANES(Real)) {
            const auto i = static_cast<std::ptrdiff_t>(r * a.columns + from + s);
            const Lane3<Real> x = load3(a.x, i), beside = load3(a.x, leftmost ? i + 1 : i - 1);
            const Lane3<Real> left = leftmost ? subtract3(beside, x) : subtract3(x, beside);
            const Lane3<Real> up =
                has_row_before ? subtract3(x, load3(a.x, i - columns)) : subtract3(load3(a.x, i + columns), x);
            points.include(x);
            along_row.include(left);
            along_column.include(up);
            const auto left_squared = dot3(left, left), up_squared = dot3(up, up);
            near_left |= bits_of<Real>(hn::Lt(left_squared, reach)) << s;
            near_up |= bits_of<Real>(hn::Lt(up_squared, reach)) << s;
            total = hn::Add(total, hn::Add(left_squared, up_squared));
        }
    };
    if (row == 0)
        look(row, std::false_type());
    else
        look(row, std::true_type());
    const bool near_above = near_up != 0;
    for (std::size_t r = row + 1; r < end; ++r)
        look(r, std::true_type());
    points.store(0, a.shapes[index]);
    along_row.store(3, a.shapes[index]);
    along_column.store(6, a.shapes[index]);
    const bool near_before = (near_left >> (column - from) & 1u) != 0;
    const bool finite = std::isfinite(hn::GetLane(hn::SumOfLanes(d, total)));
    a.flags[index] = static_cast<std::uint8_t>((near_left != 0 || near_up != 0 ? block_near : 0) |
                                               (near_before ? block_near_before : 0) |
                                               (near_above ? block_near_above : 0) | (finite ? 0 : block_not_finite));
}

template <class Real>
void block_shapes(const BlockArguments<Real>& arguments) {
    const BlockArguments<Real> a = arguments; // what is stored is none of them: they stay in registers
    const std::size_t across = (a.columns + block_side - 1) / block_side;
    for (std::size_t row = a.begin; row < a.end; ++row) {
        shape_of_block<true>(a, row, 0, row * across);
        for (std::size_t column = 1; column < across; ++column)
            shape_of_block<false>(a, row, column, row * across + column);
    }
}

} // namespace clothlab::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
