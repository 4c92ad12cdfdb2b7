// Which parts of a cloth are so regular that no two of their points can touch: what is left is to be looked at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/kernels/kernels.h"

namespace clothlab::sim {

/// Square blocks of the grid, each of up to four smaller ones, with what bounds their points and edges. Parts of a
/// smooth surface that bend little cannot touch each other, so that only those that bend much, or have come near some
/// part elsewhere, need a closer look: P. Volino, N. Magnenat-Thalmann, "Efficient self-collision detection on smoothly
/// discretized surface animations using geometrical shape regularity", Computer Graphics Forum 13 (1994). Their proof
/// is of directions of normals; ours, of edges, also tells how far apart points are.
template <class Real>
class RegularBlocks {
public:
    /// For a grid of so many points. A narrow one has no blocks.
    void resize(std::size_t columns, std::size_t rows);
    bool usable() const { return !levels_.empty(); }
    std::size_t block_rows() const { return levels_.front().rows; }

    /// Fits the blocks of these rows of blocks to the points, and finds which edges are shorter than the reach.
    void fit(const Kernels<Real>& kernels, const ConstAxes<Real>& x, Real reach_squared, std::size_t begin,
             std::size_t end);
    /// After all rows are fitted. False when some number is not finite; then the blocks say nothing.
    bool finish();
    /// The largest coordinate of a point, in m.
    double bound() const;
    /// Finds which blocks are not proved to be farther than the reach from all points, but for their own. The reach is
    /// that of fit. False when there are so many that to find them does not pay.
    bool find(double reach);
    /// The points of those blocks; empty when there are none.
    PointSpans points() const { return {spans_.data(), spans_.size(), points_}; }

    std::size_t bytes() const;

private:
    struct Block {
        std::size_t column, row;
    };
    struct Level {
        std::size_t columns, rows;
        std::vector<BlockShape<Real>> shapes;
        const BlockShape<Real>& at(Block b) const { return shapes[b.row * columns + b.column]; }
    };
    template <class Visit>
    void for_children(std::size_t level, Block b, Visit visit) const;
    bool regular(std::size_t level, Block a, Block b) const;
    void within(std::size_t level, Block b);
    void between(std::size_t level, Block a, Block b);
    void mark(Block b);
    void list_spans();
    /// Where cloth is crumpled there are very many pairs.
    std::size_t most_looked_at() const { return 64 + 32 * levels_[0].shapes.size(); }

    std::size_t columns_ = 0, rows_ = 0; ///< of points
    std::vector<Level> levels_;          ///< the smallest blocks first, the whole cloth last
    std::vector<std::uint8_t> flags_;    ///< of the smallest blocks
    std::vector<std::uint8_t> marked_;   ///< of the smallest blocks
    double reach_ = 0;                   ///< m
    std::size_t looked_at_ = 0;          ///< pairs of blocks
    std::vector<PointSpan> spans_;
    std::size_t points_ = 0; ///< in the spans
};

extern template class RegularBlocks<float>;
extern template class RegularBlocks<double>;

} // namespace clothlab::sim
