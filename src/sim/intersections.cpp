// Segment against triangle by signed volumes: the ends lie on different sides of the triangle's plane, and the line
// passes on the same side of all three of its edges (C. Ericson, "Real-time collision detection", 2005, section 5.3.4).
#include "sim/intersections.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "sim/grid.h"
#include "sim/random.h"

namespace clothlab::sim {
namespace {

using Index = std::uint32_t;
using Segment = std::array<Index, 2>;
using Face = std::array<Index, 3>;

struct Mesh {
    std::span<const float> positions;
    Vec3 at(Index i) const {
        return {static_cast<double>(positions[3 * i]), static_cast<double>(positions[3 * i + 1]),
                static_cast<double>(positions[3 * i + 2])};
    }
};

struct Box {
    std::array<double, 3> low, high;
};

template <std::size_t n>
Box box_of(const Mesh& mesh, const std::array<Index, n>& corners) {
    const Vec3 first = mesh.at(corners[0]);
    Box box{{first.x, first.y, first.z}, {first.x, first.y, first.z}};
    for (const Index i : corners) {
        const Vec3 p = mesh.at(i);
        const std::array v{p.x, p.y, p.z};
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] = std::min(box.low[k], v[k]);
            box.high[k] = std::max(box.high[k], v[k]);
        }
    }
    return box;
}

bool overlap(const Box& a, const Box& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (a.high[k] < b.low[k] || b.high[k] < a.low[k])
            return false;
    return true;
}

/// Six times the signed volume of a tetrahedron.
double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z},
        w{d.x - a.x, d.y - a.y, d.z - a.z};
    return u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) + u.z * (v.x * w.y - v.y * w.x);
}

bool passes_through(const Mesh& mesh, const Segment& edge, const Face& face) {
    const Vec3 p = mesh.at(edge[0]), q = mesh.at(edge[1]);
    const Vec3 a = mesh.at(face[0]), b = mesh.at(face[1]), c = mesh.at(face[2]);
    const double above = volume(a, b, c, p), below = volume(a, b, c, q);
    if (!(above * below < 0))
        return false;
    const double u = volume(p, q, a, b), v = volume(p, q, b, c), w = volume(p, q, c, a);
    return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

/// A uniform grid of the triangles' boxes, one cell about as large as the longest side of a typical box, hashed to
/// lists.
class FaceGrid {
public:
    FaceGrid(const Mesh& mesh, const std::vector<Face>& faces) {
        std::vector<double> sizes;
        for (const Face& f : faces) {
            boxes_.push_back(box_of(mesh, f));
            double size = 0;
            for (std::size_t k = 0; k < 3; ++k)
                size = std::max(size, boxes_.back().high[k] - boxes_.back().low[k]);
            sizes.push_back(size);
        }
        if (sizes.empty())
            return;
        std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2), sizes.end());
        cell_ = std::max(sizes[sizes.size() / 2], 1e-9);
        slots_.resize(std::bit_ceil(2 * faces.size()));
        for (std::size_t i = 0; i < faces.size(); ++i) {
            if (!cells(boxes_[i], [&](std::size_t slot) { slots_[slot].push_back(static_cast<Index>(i)); }))
                large_.push_back(static_cast<Index>(i));
        }
    }

    /// Candidates for a box, each once, in order.
    void near(const Box& box, std::vector<Index>& out) const {
        out = large_;
        if (slots_.empty())
            return; // no face at all
        const auto add = [&](std::size_t slot) {
            for (const Index i : slots_[slot])
                if (overlap(box, boxes_[i]))
                    out.push_back(i);
        };
        if (!cells(box, add)) {
            out.resize(boxes_.size());
            for (std::size_t i = 0; i < out.size(); ++i)
                out[i] = static_cast<Index>(i);
        }
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
    }

private:
    /// Visits the slots of a box's cells; false, without a visit, when they are too many to be worth it.
    template <class Visit>
    bool cells(const Box& box, Visit visit) const {
        std::array<std::int64_t, 3> low{}, high{};
        double count = 1;
        for (std::size_t k = 0; k < 3; ++k) {
            const double from = std::floor(box.low[k] / cell_), to = std::floor(box.high[k] / cell_);
            if (!(std::abs(from) < 1e15) || !(std::abs(to) < 1e15))
                return false;
            count *= to - from + 1;
            low[k] = static_cast<std::int64_t>(from);
            high[k] = static_cast<std::int64_t>(to);
        }
        if (count > 64)
            return false;
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                    std::uint64_t h = SplitMix64::mix(static_cast<std::uint64_t>(x));
                    h = SplitMix64::mix(h ^ static_cast<std::uint64_t>(y));
                    h = SplitMix64::mix(h ^ static_cast<std::uint64_t>(z));
                    visit(static_cast<std::size_t>(h & (slots_.size() - 1)));
                }
        return true;
    }

    std::vector<Box> boxes_;
    std::vector<std::vector<Index>> slots_;
    std::vector<Index> large_; ///< faces over so many cells that they are looked at always
    double cell_ = 1;
};

} // namespace

std::size_t count_intersections(int columns, int rows, std::span<const float> positions) {
    const Mesh mesh{positions};
    const auto finite = [&](Index i) {
        return std::isfinite(positions[3 * i]) && std::isfinite(positions[3 * i + 1]) &&
               std::isfinite(positions[3 * i + 2]);
    };
    std::vector<Face> faces;
    for_each_triangle(columns, rows, [&](Index a, Index b, Index c) {
        if (finite(a) && finite(b) && finite(c))
            faces.push_back({a, b, c});
    });
    const FaceGrid grid(mesh, faces);

    std::size_t count = 0;
    std::vector<Index> candidates;
    const auto test = [&](Index p, Index q) {
        if (!finite(p) || !finite(q))
            return;
        const Segment edge{p, q};
        grid.near(box_of(mesh, edge), candidates);
        for (const Index i : candidates) {
            const Face& f = faces[i];
            if (std::find(f.begin(), f.end(), p) != f.end() || std::find(f.begin(), f.end(), q) != f.end())
                continue;
            count += passes_through(mesh, edge, f) ? 1u : 0u;
        }
    };
    const auto stride = static_cast<Index>(columns);
    for (Index row = 0; row < static_cast<Index>(rows); ++row)
        for (Index column = 0; column < stride; ++column) {
            const Index i = row * stride + column;
            if (column + 1 < stride)
                test(i, i + 1);
            if (row + 1 < static_cast<Index>(rows))
                test(i, i + stride);
            if (column > 0 && row + 1 < static_cast<Index>(rows))
                test(i, i + stride - 1); // the diagonal
        }
    return count;
}

} // namespace clothlab::sim
