#include "sim/collision/regular_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace clothlab::sim {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Half of the largest extent of a box along a unit vector, the box being given by half of its sides.
double extent(const Vector& unit, const Vector& half) {
    return std::abs(unit[0]) * half[0] + std::abs(unit[1]) * half[1] + std::abs(unit[2]) * half[2];
}

template <class Real>
void include(BlockShape<Real>& shape, const BlockShape<Real>& other) {
    for (std::size_t k = 0; k < shape.low.size(); ++k) {
        shape.low[k] = std::min(shape.low[k], other.low[k]);
        shape.high[k] = std::max(shape.high[k], other.high[k]);
    }
}

/// A lower bound of how far apart two points of a part of the grid are, per column and row that are between them: for
/// c columns and r rows at least this times the root of c² + r², in m. Negative or not a number where it says nothing.
///
/// From one point to another go c edges along a row, each some mean edge e and no more than a box around it from
/// that, and r edges f along a column. In the plane of e and f their sum is not shorter than |c e + r f| less what the
/// boxes allow, c and r times half their extents there; and |c e + r f| is not shorter than the lesser singular value
/// of (e f) times the root. What edges do out of the plane, as those of a bent cloth do first, only takes points
/// farther apart.
template <class Real>
double least_distance(const BlockShape<Real>& shape) {
    Vector e, f, half_e, half_f;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto low_e = static_cast<double>(shape.low[3 + k]), high_e = static_cast<double>(shape.high[3 + k]);
        const auto low_f = static_cast<double>(shape.low[6 + k]), high_f = static_cast<double>(shape.high[6 + k]);
        e[k] = 0.5 * (low_e + high_e);
        f[k] = 0.5 * (low_f + high_f);
        half_e[k] = 0.5 * (high_e - low_e);
        half_f[k] = 0.5 * (high_f - low_f);
    }
    const double ee = dot(e, e), ff = dot(f, f), ef = dot(e, f);
    const double singular = std::sqrt(0.5 * std::max(ee + ff - std::hypot(ee - ff, 2 * ef), 0.0));
    const double length_e = std::sqrt(ee), rest = std::sqrt(ff - ef * ef / ee);
    Vector u, v; // of length one, across each other, in the plane
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = e[k] / length_e;
        v[k] = (f[k] - ef / ee * e[k]) / rest;
    }
    const double across_e = extent(u, half_e), along_e = extent(v, half_e);
    const double across_f = extent(u, half_f), along_f = extent(v, half_f);
    const double spread = std::sqrt(across_e * across_e + along_e * along_e + across_f * across_f + along_f * along_f);
    constexpr double rounding = 1e-5; // of edges in single precision, and of the plane where they are nearly parallel
    return singular - spread - rounding * (length_e + std::sqrt(ff));
}

} // namespace

template <class Real>
void RegularBlocks<Real>::resize(std::size_t columns, std::size_t rows) {
    columns_ = columns;
    rows_ = rows;
    levels_.clear();
    spans_.clear();
    points_ = 0;
    if (columns <= block_side || rows < 2)
        return;
    for (std::size_t c = (columns + block_side - 1) / block_side, r = (rows + block_side - 1) / block_side;;
         c = (c + 1) / 2, r = (r + 1) / 2) {
        levels_.push_back({c, r, std::vector<BlockShape<Real>>(c * r)});
        if (c == 1 && r == 1)
            break;
    }
    flags_.assign(levels_.front().shapes.size(), 0);
    marked_.assign(levels_.front().shapes.size(), 0);
    spans_.reserve(rows * (levels_.front().columns / 2 + 1));
}

template <class Real>
template <class Visit>
void RegularBlocks<Real>::for_children(std::size_t level, Block b, Visit visit) const {
    const Level& below = levels_[level - 1];
    for (std::size_t row = 2 * b.row; row < std::min(2 * b.row + 2, below.rows); ++row)
        for (std::size_t column = 2 * b.column; column < std::min(2 * b.column + 2, below.columns); ++column)
            visit(Block{column, row});
}

template <class Real>
void RegularBlocks<Real>::fit(const Kernels<Real>& kernels, const ConstAxes<Real>& x, Real reach_squared,
                              std::size_t begin, std::size_t end) {
    kernels.block_shapes({x, columns_, rows_, begin, end, reach_squared, levels_[0].shapes.data(), flags_.data()});
}

template <class Real>
bool RegularBlocks<Real>::finish() {
    for (const std::uint8_t flags : flags_)
        if ((flags & block_not_finite) != 0)
            return false;
    for (std::size_t level = 1; level < levels_.size(); ++level)
        for (std::size_t row = 0; row < levels_[level].rows; ++row)
            for (std::size_t column = 0; column < levels_[level].columns; ++column) {
                BlockShape<Real>& shape = levels_[level].shapes[row * levels_[level].columns + column];
                shape = levels_[level - 1].at({2 * column, 2 * row});
                for_children(level, {column, row}, [&](Block child) { include(shape, levels_[level - 1].at(child)); });
            }
    return true;
}

template <class Real>
double RegularBlocks<Real>::bound() const {
    const BlockShape<Real>& all = levels_.back().shapes[0];
    double bound = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        bound = std::max(
            {bound, std::abs(static_cast<double>(all.low[axis])), std::abs(static_cast<double>(all.high[axis]))});
    return bound;
}

/// Whether no two points of the smallest rectangle that holds both blocks touch, but for neighbours in a row or column.
template <class Real>
bool RegularBlocks<Real>::regular(std::size_t level, Block a, Block b) const {
    BlockShape<Real> shape = levels_[level].at(a);
    for (std::size_t row = std::min(a.row, b.row); row <= std::max(a.row, b.row); ++row)
        for (std::size_t column = std::min(a.column, b.column); column <= std::max(a.column, b.column); ++column)
            include(shape, levels_[level].at({column, row}));
    return least_distance(shape) * std::numbers::sqrt2 >= reach_;
}

template <class Real>
void RegularBlocks<Real>::mark(Block b) {
    marked_[b.row * levels_[0].columns + b.column] = 1;
}

/// All pairs of points of a block.
template <class Real>
void RegularBlocks<Real>::within(std::size_t level, Block b) {
    if (++looked_at_ > most_looked_at() || regular(level, b, b))
        return;
    if (level == 0)
        return mark(b);
    std::array<Block, 4> children;
    std::size_t count = 0;
    for_children(level, b, [&](Block child) { children[count++] = child; });
    for (std::size_t i = 0; i < count; ++i) {
        within(level - 1, children[i]);
        for (std::size_t k = i + 1; k < count; ++k)
            between(level - 1, children[i], children[k]);
    }
}

/// All pairs of a point of one block and one of the other.
template <class Real>
void RegularBlocks<Real>::between(std::size_t level, Block a, Block b) {
    const Level& blocks = levels_[level];
    if (level == 0 && marked_[a.row * blocks.columns + a.column] && marked_[b.row * blocks.columns + b.column])
        return;
    if (++looked_at_ > most_looked_at())
        return;
    const BlockShape<Real>&in_a = blocks.at(a), &in_b = blocks.at(b);
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!(static_cast<double>(in_a.low[axis]) - reach_ <= static_cast<double>(in_b.high[axis]) &&
              static_cast<double>(in_b.low[axis]) - reach_ <= static_cast<double>(in_a.high[axis])))
            return;
    const auto apart = [](std::size_t p, std::size_t q) { return p < q ? q - p : p - q; };
    if (apart(a.row, b.row) <= 1 && apart(a.column, b.column) <= 1 && regular(level, a, b))
        return;
    if (level == 0) {
        mark(a);
        return mark(b);
    }
    for_children(level, a,
                 [&](Block of_a) { for_children(level, b, [&](Block of_b) { between(level - 1, of_a, of_b); }); });
}

template <class Real>
bool RegularBlocks<Real>::find(double reach) {
    reach_ = reach;
    looked_at_ = 0;
    std::fill(marked_.begin(), marked_.end(), std::uint8_t{0});
    const Level& blocks = levels_[0];
    for (std::size_t row = 0; row < blocks.rows; ++row)
        for (std::size_t column = 0; column < blocks.columns; ++column) {
            const std::uint8_t flags = flags_[row * blocks.columns + column];
            if ((flags & block_near) != 0)
                mark({column, row});
            if ((flags & block_near_before) != 0 && column > 0)
                mark({column - 1, row});
            if ((flags & block_near_above) != 0 && row > 0)
                mark({column, row - 1});
        }
    within(levels_.size() - 1, {0, 0});
    if (looked_at_ > most_looked_at())
        return false;
    list_spans();
    return 3 * points_ <= 2 * columns_ * rows_;
}

template <class Real>
void RegularBlocks<Real>::list_spans() {
    spans_.clear();
    points_ = 0;
    const Level& blocks = levels_[0];
    for (std::size_t row = 0; row < rows_; ++row) {
        const std::uint8_t* marked = &marked_[row / block_side * blocks.columns];
        for (std::size_t column = 0; column < blocks.columns; ++column) {
            if (!marked[column])
                continue;
            const auto begin = static_cast<std::uint32_t>(row * columns_ + column * block_side);
            const auto end = static_cast<std::uint32_t>(row * columns_ + std::min((column + 1) * block_side, columns_));
            if (!spans_.empty() && spans_.back().end == begin)
                spans_.back().end = end;
            else
                spans_.push_back({begin, end});
            points_ += end - begin;
        }
    }
}

template <class Real>
std::size_t RegularBlocks<Real>::bytes() const {
    std::size_t sum = levels_.capacity() * sizeof(Level) + flags_.capacity() + marked_.capacity() +
                      spans_.capacity() * sizeof(PointSpan);
    for (const Level& level : levels_)
        sum += level.shapes.capacity() * sizeof(BlockShape<Real>);
    return sum;
}

template class RegularBlocks<float>;
template class RegularBlocks<double>;

} // namespace clothlab::sim
