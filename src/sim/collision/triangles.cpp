// R. Bridson, R. Fedkiw, J. Anderson, "Robust treatment of collisions, contact and friction for cloth animation",
// SIGGRAPH 2002: the proximities of section 6 (points and triangles, edges and edges), and how section 7 shares a push
// out among the corners, w_i / sum of w², here of displacements instead of impulses. Deviations: the direction is that
// between the closest points, also where the closest point is on an edge or corner of the triangle (they have the
// triangle's normal, and a margin around it); the missing distance is made up for in full in one step. Their friction,
// and their search for what passes through within one step, are not part of the rule: a point that is through stays so.
#include "sim/collision/triangles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "sim/collision/closest.h"

namespace clothlab::sim {
namespace {

struct Corner {
    int column, row;
    std::size_t index; ///< of the point
};
using Edge = std::array<Corner, 2>;
using Face = std::array<Corner, 3>;

/// Up to so many features of one kind, without an allocation.
template <class Feature, std::size_t most>
struct Few {
    std::array<Feature, most> list;
    std::size_t count = 0;
    void add(Feature f) { list[count++] = f; }
    const Feature* begin() const { return list.data(); }
    const Feature* end() const { return list.data() + count; }
};

bool neighbours(Corner a, Corner b) {
    return std::abs(a.column - b.column) <= 1 && std::abs(a.row - b.row) <= 1;
}

template <class Real>
class Resolver {
public:
    Resolver(const Model<Real>& model, Vec3Array<Real>& x)
        : model_(model), x_(x), reach_(Real(2) * model.thickness), columns_(model.grid->columns),
          rows_(model.grid->rows) {}

    std::size_t contacts = 0;

    void cells(GridBlock a, GridBlock b) {
        near_in_grid_ = std::abs(a.column - b.column) <= 2 && std::abs(a.row - b.row) <= 2;
        points_and_faces(a, b);
        points_and_faces(b, a);
        const Few<Edge, 5> of_a = edges_of(a), of_b = edges_of(b);
        for (const Edge& one : of_a)
            for (const Edge& other : of_b)
                edges(one, other);
    }

private:
    // Each cell owns its upper left point and the edges there, so that each feature has one owner; the last cells of
    // rows and columns own what is left.
    Few<Corner, 4> points_of(GridBlock c) const {
        Few<Corner, 4> points;
        const bool last_column = c.column == columns_ - 2, last_row = c.row == rows_ - 2;
        points.add(corner(c.column, c.row));
        if (last_column)
            points.add(corner(c.column + 1, c.row));
        if (last_row)
            points.add(corner(c.column, c.row + 1));
        if (last_column && last_row)
            points.add(corner(c.column + 1, c.row + 1));
        return points;
    }
    Few<Edge, 5> edges_of(GridBlock c) const {
        const Corner upper_left = corner(c.column, c.row), upper_right = corner(c.column + 1, c.row),
                     lower_left = corner(c.column, c.row + 1), lower_right = corner(c.column + 1, c.row + 1);
        Few<Edge, 5> edges;
        edges.add({upper_left, upper_right});
        edges.add({upper_left, lower_left});
        edges.add({upper_right, lower_left});
        if (c.column == columns_ - 2)
            edges.add({upper_right, lower_right});
        if (c.row == rows_ - 2)
            edges.add({lower_left, lower_right});
        return edges;
    }

    Corner corner(int column, int row) const {
        return {column, row, static_cast<std::size_t>(row * columns_ + column)};
    }
    Triple<Real> now(Corner c) const { return at(x_, c.index); }
    /// Where a corner is in the flat cloth.
    Triple<Real> flat(Corner c) const {
        return {static_cast<Real>(c.column) * model_.spacing_x, static_cast<Real>(c.row) * model_.spacing_y, 0};
    }

    void points_and_faces(GridBlock of_points, GridBlock of_faces) {
        const int c = of_faces.column, r = of_faces.row;
        // As for_each_triangle splits a cell.
        const Corner upper_right = corner(c + 1, r), lower_left = corner(c, r + 1);
        const std::array<Face, 2> faces{Face{corner(c, r), upper_right, lower_left},
                                        Face{upper_right, corner(c + 1, r + 1), lower_left}};
        for (const Corner& point : points_of(of_points))
            for (const Face& face : faces)
                point_and_face(point, face);
    }

    /// Whether the boxes of two features are at most the reach apart: most pairs of near cells are sorted out here.
    template <std::size_t n, std::size_t m>
    bool within_reach(const std::array<Corner, n>& a, const std::array<Corner, m>& b) const {
        for (const auto* axis : {x_.x.data(), x_.y.data(), x_.z.data()}) {
            Real low_a = axis[a[0].index], high_a = low_a, low_b = axis[b[0].index], high_b = low_b;
            for (std::size_t k = 1; k < n; ++k) {
                low_a = std::min(low_a, axis[a[k].index]);
                high_a = std::max(high_a, axis[a[k].index]);
            }
            for (std::size_t k = 1; k < m; ++k) {
                low_b = std::min(low_b, axis[b[k].index]);
                high_b = std::max(high_b, axis[b[k].index]);
            }
            if (low_a - reach_ > high_b || low_b - reach_ > high_a)
                return false;
        }
        return true;
    }

    void point_and_face(Corner p, const Face& f) {
        if (near_in_grid_ && (neighbours(p, f[0]) || neighbours(p, f[1]) || neighbours(p, f[2])))
            return;
        if (!within_reach(std::array{p}, f))
            return;
        const auto weights = [&](auto place) {
            const std::array<Real, 3> w = closest_on_triangle(place(p), place(f[0]), place(f[1]), place(f[2]));
            return std::array<Real, 4>{1, -w[0], -w[1], -w[2]};
        };
        separate({p, f[0], f[1], f[2]}, weights);
    }

    void edges(const Edge& a, const Edge& b) {
        if (near_in_grid_ &&
            (neighbours(a[0], b[0]) || neighbours(a[0], b[1]) || neighbours(a[1], b[0]) || neighbours(a[1], b[1])))
            return;
        if (!within_reach(a, b))
            return;
        const auto weights = [&](auto place) {
            const auto [s, t] = closest_on_segments(place(a[0]), place(a[1]), place(b[0]), place(b[1]));
            return std::array<Real, 4>{1 - s, s, t - 1, -t};
        };
        separate({a[0], a[1], b[0], b[1]}, weights);
    }

    template <class Place>
    static Triple<Real> difference(const std::array<Corner, 4>& corners, const std::array<Real, 4>& w, Place place) {
        Triple<Real> d{0, 0, 0};
        for (std::size_t k = 0; k < 4; ++k)
            d = along(d, w[k], place(corners[k]));
        return d;
    }

    /// Two features whose closest points differ by the sum of weights times corners: moves the free corners by their
    /// weights.
    template <class Weights>
    void separate(const std::array<Corner, 4>& corners, Weights weights) {
        const auto here = [&](Corner c) { return now(c); };
        const auto at_rest = [&](Corner c) { return flat(c); };
        const std::array<Real, 4> w = weights(here);
        const Triple<Real> d = difference(corners, w, here);
        const Real length = norm(d);
        if (!(length < reach_) || length == 0)
            return;
        if (norm(difference(corners, weights(at_rest), at_rest)) <= reach_)
            return;
        Real movable = 0; // the sum of squares of free corners' weights
        for (std::size_t k = 0; k < 4; ++k)
            movable += model_.pinned[corners[k].index] ? Real(0) : w[k] * w[k];
        if (movable == 0)
            return;
        // Without pins it is 1 at the least. Where hardly more than a far corner of a pinned pair is free, the whole
        // push would throw that corner away.
        const Real share = (reach_ - length) / (length * std::max(movable, Real(0.25)));
        for (std::size_t k = 0; k < 4; ++k)
            if (const std::size_t i = corners[k].index; !model_.pinned[i])
                put(x_, i, along(at(x_, i), share * w[k], d));
        contacts += 2;
    }

    const Model<Real>& model_;
    Vec3Array<Real>& x_;
    Real reach_;
    bool near_in_grid_ = false; ///< whether the two cells may have corners that are neighbours
    int columns_, rows_;
};

} // namespace

template <class Real>
std::size_t resolve_triangles(const Model<Real>& model, State<Real>& state, BlockTree<Real>& tree) {
    tree.fit(state.position);
    Resolver<Real> resolver(model, state.position);
    tree.for_near_cells(Real(2) * model.thickness, [&](GridBlock a, GridBlock b) { resolver.cells(a, b); });
    return resolver.contacts;
}

template std::size_t resolve_triangles<float>(const Model<float>&, State<float>&, BlockTree<float>&);
template std::size_t resolve_triangles<double>(const Model<double>&, State<double>&, BlockTree<double>&);

} // namespace clothlab::sim
