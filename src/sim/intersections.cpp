// Segment against triangle by signed volumes: the ends lie on different sides of the triangle's plane, and the line
// passes on the same side of all three of its edges (C. Ericson, "Real-time collision detection", 2005, section 5.3.4).
// The pairs come from a bounding volume hierarchy over square blocks of the grid, compared with itself: the grid is the
// tree, so besides the blocks' boxes nothing is kept (a cloth may have millions of triangles).
#include "sim/intersections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "sim/grid.h"

namespace clothlab::sim {
namespace {

using Index = std::uint32_t;
using Segment = std::array<Index, 2>;
using Face = std::array<Index, 3>;

/// Empty at first. In single precision, as the positions are, so it is exact.
struct Box {
    static constexpr float inf = std::numeric_limits<float>::infinity();
    std::array<float, 3> low{inf, inf, inf}, high{-inf, -inf, -inf};

    void include(const std::array<float, 3>& from, const std::array<float, 3>& to) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], from[k]);
            high[k] = std::max(high[k], to[k]);
        }
    }
};

struct BoxedFace {
    Face face;
    Box box;
};

bool overlap(const Box& a, const Box& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (a.high[k] < b.low[k] || b.high[k] < a.low[k])
            return false;
    return true;
}

/// Of boxes that overlap: whether both lie in one plane across an axis. Then all volumes between their points are
/// exactly zero, without rounding, and nothing passes through anything.
bool coplanar(const Box& a, const Box& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (a.low[k] == a.high[k] && b.low[k] == b.high[k])
            return true;
    return false;
}

/// Six times the signed volume of a tetrahedron.
double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z},
        w{d.x - a.x, d.y - a.y, d.z - a.z};
    return u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) + u.z * (v.x * w.y - v.y * w.x);
}

struct Mesh {
    Index columns, rows;
    std::span<const float> positions;

    std::array<float, 3> point(Index i) const {
        const float* p = &positions[std::size_t{3} * i];
        return {p[0], p[1], p[2]};
    }
    Vec3 at(Index i) const {
        const auto [x, y, z] = point(i);
        return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
    }
    bool finite(Index i) const {
        const auto [x, y, z] = point(i);
        return std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
    }

    /// Calls visit(segment or face, its box) if all its corners are finite.
    template <std::size_t n, class Visit>
    void visit_finite(const std::array<Index, n>& corners, Visit& visit) const {
        Box box;
        for (const Index i : corners) {
            if (!finite(i))
                return;
            box.include(point(i), point(i));
        }
        visit(corners, box);
    }

    /// The finite edges of a cell, named by its upper left point, but for its lower and right sides, which are the next
    /// cells'. The last row and column have cells of one edge.
    template <class Visit>
    void for_each_edge(Index row, Index column, Visit visit) const {
        const Index i = row * columns + column;
        const bool right = column + 1 < columns, below = row + 1 < rows;
        if (right)
            visit_finite(Segment{i, i + 1}, visit);
        if (below)
            visit_finite(Segment{i, i + columns}, visit);
        if (right && below)
            visit_finite(Segment{i + 1, i + columns}, visit); // the diagonal
    }

    /// The finite triangles of a cell.
    template <class Visit>
    void for_each_face(Index row, Index column, Visit visit) const {
        const Index i = row * columns + column;
        if (column + 1 >= columns || row + 1 >= rows)
            return;
        visit_finite(Face{i, i + 1, i + columns}, visit);
        visit_finite(Face{i + 1, i + columns + 1, i + columns}, visit);
    }

    /// Calls visit(row, column) for every cell.
    template <class Visit>
    void for_each_cell(Visit visit) const {
        for (Index row = 0; row < rows; ++row)
            for (Index column = 0; column < columns; ++column)
                visit(row, column);
    }

    bool passes_through(const Segment& edge, const Face& face) const {
        for (const Index i : edge)
            if (i == face[0] || i == face[1] || i == face[2])
                return false;
        const Vec3 p = at(edge[0]), q = at(edge[1]);
        const Vec3 a = at(face[0]), b = at(face[1]), c = at(face[2]);
        const double above = volume(a, b, c, p), below = volume(a, b, c, q);
        if (!(above * below < 0))
            return false;
        const double u = volume(p, q, a, b), v = volume(p, q, b, c), w = volume(p, q, c, a);
        return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
    }
};

/// Square blocks of cells and, on every further level, of two by two blocks, up to one block.
class TriangleTree {
public:
    explicit TriangleTree(const Mesh& mesh) : mesh_(mesh) {
        levels_.push_back(make_level(mesh.columns, mesh.rows, leaf_side));
        for_each_block(levels_[0], [&](Index row, Index column, Box& box) {
            // A block's edges and triangles reach to the first points of the next blocks.
            const Index row_end = std::min(leaf_side * (row + 1) + 1, mesh.rows);
            const Index column_end = std::min(leaf_side * (column + 1) + 1, mesh.columns);
            for (Index r = leaf_side * row; r < row_end; ++r)
                for (Index c = leaf_side * column; c < column_end; ++c)
                    if (const Index i = r * mesh.columns + c; mesh.finite(i))
                        box.include(mesh.point(i), mesh.point(i));
        });
        while (levels_.back().boxes.size() > 1) {
            levels_.push_back(make_level(levels_.back().columns, levels_.back().rows, 2));
            const Level& below = levels_[levels_.size() - 2];
            for_each_block(levels_.back(), [&](Index row, Index column, Box& box) {
                for_each_child(below, {row, column}, [&](Block child) {
                    const Box& part = below.box(child);
                    box.include(part.low, part.high);
                });
            });
        }
    }

    const Box& root() const { return levels_.back().boxes[0]; }

    /// The intersections of edges and faces whose boxes overlap.
    std::size_t count() const { return count(levels_.size() - 1, {0, 0}, {0, 0}); }

private:
    /// Blocks of 2 x 2 cells take two thirds of a point's own memory; larger ones prune less.
    static constexpr Index leaf_side = 2;

    struct Block {
        Index row, column;
        bool operator==(const Block&) const = default;
    };

    struct Level {
        Index columns, rows;
        std::vector<Box> boxes;
        const Box& box(Block b) const { return boxes[std::size_t{b.row} * columns + b.column]; }
    };

    static Level make_level(Index columns, Index rows, Index side) {
        Level level{(columns + side - 1) / side, (rows + side - 1) / side, {}};
        level.boxes.resize(std::size_t{level.columns} * level.rows);
        return level;
    }

    template <class Visit>
    static void for_each_block(Level& level, Visit visit) {
        std::size_t i = 0;
        for (Index row = 0; row < level.rows; ++row)
            for (Index column = 0; column < level.columns; ++column)
                visit(row, column, level.boxes[i++]);
    }

    template <class Visit>
    static void for_each_child(const Level& below, Block block, Visit visit) {
        for (Index row = 2 * block.row; row < std::min(2 * block.row + 2, below.rows); ++row)
            for (Index column = 2 * block.column; column < std::min(2 * block.column + 2, below.columns); ++column)
                visit(Block{row, column});
    }

    /// Within one block, or of each block with the other.
    std::size_t count(std::size_t level, Block a, Block b) const {
        const Box &box_a = levels_[level].box(a), &box_b = levels_[level].box(b);
        // Without the second condition a cloth of which all points are in one place would take all pairs.
        if (!overlap(box_a, box_b) || coplanar(box_a, box_b))
            return 0;
        if (level == 0)
            return count_leaf(a, b) + (a == b ? 0 : count_leaf(b, a));
        std::size_t n = 0;
        const Level& below = levels_[level - 1];
        const auto order = [&](Block c) { return std::size_t{c.row} * below.columns + c.column; };
        for_each_child(below, a, [&](Block i) {
            for_each_child(below, b, [&](Block j) {
                if (a != b || order(i) <= order(j)) // a pair within one block has no order: take it once
                    n += count(level - 1, i, j);
            });
        });
        return n;
    }

    /// Of the edges of one leaf through the faces of another, or of the same.
    std::size_t count_leaf(Block a, Block b) const {
        const Box &box_a = levels_[0].box(a), &box_b = levels_[0].box(b);
        std::array<BoxedFace, 2 * leaf_side * leaf_side> faces;
        std::size_t face_count = 0;
        for_each_cell(b, [&](Index row, Index column) {
            mesh_.for_each_face(row, column, [&](const Face& face, const Box& box) {
                if (overlap(box, box_a))
                    faces[face_count++] = {face, box};
            });
        });
        if (face_count == 0)
            return 0;
        std::size_t n = 0;
        for_each_cell(a, [&](Index row, Index column) {
            mesh_.for_each_edge(row, column, [&](const Segment& edge, const Box& box) {
                if (!overlap(box, box_b))
                    return;
                for (std::size_t i = 0; i < face_count; ++i)
                    if (overlap(box, faces[i].box))
                        n += mesh_.passes_through(edge, faces[i].face) ? 1u : 0u;
            });
        });
        return n;
    }

    template <class Visit>
    void for_each_cell(Block leaf, Visit visit) const {
        for (Index row = leaf_side * leaf.row; row < std::min(leaf_side * (leaf.row + 1), mesh_.rows); ++row)
            for (Index column = leaf_side * leaf.column;
                 column < std::min(leaf_side * (leaf.column + 1), mesh_.columns); ++column)
                visit(row, column);
    }

    const Mesh& mesh_;
    std::vector<Level> levels_;
};

/// Tells what is far larger, or far further out, than the typical face: it covers many cells of a lattice whose side is
/// the typical face's longest, or cells beyond the range of exact integers.
class Outsized {
public:
    explicit Outsized(const Mesh& mesh) {
        std::vector<double> sizes;
        sizes.reserve(std::size_t{2} * (mesh.columns - 1) * (mesh.rows - 1));
        mesh.for_each_cell([&](Index row, Index column) {
            mesh.for_each_face(row, column, [&](const Face&, const Box& box) {
                double size = 0;
                for (std::size_t k = 0; k < 3; ++k)
                    size = std::max(size, static_cast<double>(box.high[k]) - static_cast<double>(box.low[k]));
                sizes.push_back(size);
            });
        });
        if (sizes.empty())
            return;
        const auto median = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
        std::nth_element(sizes.begin(), median, sizes.end());
        cell_ = std::max(*median, 1e-9);
    }

    bool operator()(const Box& box) const {
        double count = 1;
        for (std::size_t k = 0; k < 3; ++k) {
            const double from = std::floor(static_cast<double>(box.low[k]) / cell_),
                         to = std::floor(static_cast<double>(box.high[k]) / cell_);
            if (!(std::abs(from) < 1e15) || !(std::abs(to) < 1e15))
                return true;
            count *= to - from + 1;
        }
        return count > 64;
    }

private:
    double cell_ = 1;
};

/// The intersections of edges and faces whose boxes are apart: by rounding of the volumes there may be some, and they
/// count where one of the two is outsized.
std::size_t count_apart(const Mesh& mesh) {
    const Outsized outsized(mesh);
    std::vector<BoxedFace> outsized_faces;
    mesh.for_each_cell([&](Index row, Index column) {
        mesh.for_each_face(row, column, [&](const Face& face, const Box& box) {
            if (outsized(box))
                outsized_faces.push_back({face, box});
        });
    });
    std::size_t n = 0;
    mesh.for_each_cell([&](Index row, Index column) {
        mesh.for_each_edge(row, column, [&](const Segment& edge, const Box& edge_box) {
            const auto test = [&](const Face& face, const Box& face_box) {
                if (!overlap(edge_box, face_box))
                    n += mesh.passes_through(edge, face) ? 1u : 0u;
            };
            if (outsized(edge_box)) {
                mesh.for_each_cell([&](Index r, Index c) { mesh.for_each_face(r, c, test); });
                return;
            }
            for (const auto& [face, box] : outsized_faces)
                test(face, box);
        });
    });
    return n;
}

} // namespace

std::size_t count_intersections(int columns, int rows, std::span<const float> positions) {
    if (columns < 2 || rows < 2)
        return 0;
    const Mesh mesh{static_cast<Index>(columns), static_cast<Index>(rows), positions};
    const TriangleTree tree(mesh);
    if (coplanar(tree.root(), tree.root()))
        return 0;
    return tree.count() + count_apart(mesh);
}

} // namespace clothlab::sim
