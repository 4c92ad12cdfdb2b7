// A hierarchy of bounding boxes over a cloth: square blocks of the grid, each of up to four smaller ones, down to
// single cells. The grid is the tree, so its memory is fixed and nothing is built, only fitted (G. van den Bergen,
// "Efficient collision detection of complex deformable models using AABB trees", Journal of Graphics Tools 2 (1997)).
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "sim/aligned.h"

namespace clothlab::sim {

/// A block's or a cell's place in its level.
struct GridBlock {
    int column = 0, row = 0;
};

template <class Real>
class BlockTree {
public:
    /// For a grid of so many points.
    void resize(int columns, int rows) {
        levels_.clear();
        for (int c = columns - 1, r = rows - 1;; c = (c + 1) / 2, r = (r + 1) / 2) {
            levels_.push_back({c, r, {}});
            levels_.back().boxes.resize(static_cast<std::size_t>(c) * static_cast<std::size_t>(r));
            if (c == 1 && r == 1)
                break;
        }
    }

    /// Fits all boxes to the points. Coordinates that are not numbers are in no box.
    void fit(const Vec3Array<Real>& x) {
        Level& cells = levels_[0];
        const auto columns = static_cast<std::size_t>(cells.columns) + 1;
        for (int row = 0; row < cells.rows; ++row)
            for (int column = 0; column < cells.columns; ++column) {
                Box& box = cells.at({column, row});
                box = Box();
                const std::size_t i = static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
                for (const std::size_t corner : {i, i + 1, i + columns, i + columns + 1})
                    box.include({x.x[corner], x.y[corner], x.z[corner]}, {x.x[corner], x.y[corner], x.z[corner]});
            }
        for (std::size_t level = 1; level < levels_.size(); ++level)
            for (int row = 0; row < levels_[level].rows; ++row)
                for (int column = 0; column < levels_[level].columns; ++column) {
                    Box& box = levels_[level].at({column, row});
                    box = Box();
                    for_children(level, {column, row}, [&](GridBlock child) {
                        const Box& inner = levels_[level - 1].at(child);
                        box.include(inner.low, inner.high);
                    });
                }
    }

    /// Calls visit(a, b) once for every two different cells whose boxes are at most `reach` (m) apart along each axis,
    /// in an order that depends on the grid alone.
    template <class Visit>
    void for_near_cells(Real reach, Visit visit) const {
        within(levels_.size() - 1, {0, 0}, reach, visit);
    }

    std::size_t bytes() const {
        std::size_t sum = levels_.capacity() * sizeof(Level);
        for (const Level& level : levels_)
            sum += level.boxes.capacity() * sizeof(Box);
        return sum;
    }

private:
    /// Empty at first.
    struct Box {
        static constexpr Real inf = std::numeric_limits<Real>::infinity();
        std::array<Real, 3> low{inf, inf, inf}, high{-inf, -inf, -inf};

        void include(const std::array<Real, 3>& from, const std::array<Real, 3>& to) {
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = from[k] < low[k] ? from[k] : low[k];
                high[k] = to[k] > high[k] ? to[k] : high[k];
            }
        }
    };
    struct Level {
        int columns = 0, rows = 0;
        std::vector<Box> boxes;
        std::size_t index(GridBlock b) const {
            return static_cast<std::size_t>(b.row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(b.column);
        }
        Box& at(GridBlock b) { return boxes[index(b)]; }
        const Box& at(GridBlock b) const { return boxes[index(b)]; }
    };

    template <class Visit>
    void for_children(std::size_t level, GridBlock b, Visit visit) const {
        const Level& below = levels_[level - 1];
        for (int row = 2 * b.row; row < 2 * b.row + 2 && row < below.rows; ++row)
            for (int column = 2 * b.column; column < 2 * b.column + 2 && column < below.columns; ++column)
                visit(GridBlock{column, row});
    }

    /// All pairs within a block.
    template <class Visit>
    void within(std::size_t level, GridBlock b, Real reach, Visit& visit) const {
        if (level == 0)
            return;
        std::array<GridBlock, 4> children;
        std::size_t count = 0;
        for_children(level, b, [&](GridBlock child) { children[count++] = child; });
        for (std::size_t i = 0; i < count; ++i) {
            within(level - 1, children[i], reach, visit);
            for (std::size_t k = i + 1; k < count; ++k)
                between(level - 1, children[i], children[k], reach, visit);
        }
    }

    /// All pairs of one cell of each block.
    template <class Visit>
    void between(std::size_t level, GridBlock a, GridBlock b, Real reach, Visit& visit) const {
        const Box &box_a = levels_[level].at(a), &box_b = levels_[level].at(b);
        for (std::size_t k = 0; k < 3; ++k)
            if (!(box_a.low[k] - reach <= box_b.high[k] && box_b.low[k] - reach <= box_a.high[k]))
                return;
        if (level == 0)
            return visit(a, b);
        for_children(level, a, [&](GridBlock in_a) {
            for_children(level, b, [&](GridBlock in_b) { between(level - 1, in_a, in_b, reach, visit); });
        });
    }

    std::vector<Level> levels_; ///< the cells first, the whole cloth last
};

} // namespace clothlab::sim
