// The cloth on the graphics card: positions and normals new with every snapshot, the topology only with a new grid.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/gl.h"
#include "sim/description.h"
#include "sim/grid.h"
#include "sim/snapshot.h"

namespace clothlab::render {

class ClothMesh {
public:
    ClothMesh();

    /// Takes over a snapshot's positions. One whose positions do not fill its grid is taken as no cloth.
    void update(const sim::Snapshot& snapshot);
    /// No cloth: nothing is drawn.
    void clear();

    /// Makes the points' attributes those of the next draw.
    void bind() const { glBindVertexArray(vertices_.id()); }
    /// Draws with the program in use, as triangles with position, normal, uv (0 to 1 along columns and rows), tangent
    /// (see cloth_tangents) and the snapshot's point quantity (0 where it has none), anticlockwise seen from the side
    /// the normals point to. Returns the number of triangles.
    std::size_t draw_surface() const;
    /// Draws the springs of a kind as GL_LINES with position and normal. Returns their number. Bending springs that
    /// follow each other along a row or column overlap: every second one runs backwards, so that a shader which moves
    /// lines to one side shows both.
    std::size_t draw_springs(sim::SpringKind kind) const;
    /// Draws the points that are named and inside the grid as GL_POINTS. Returns their number.
    std::size_t draw_points(std::span<const sim::GridPoint> points);

    /// Points left out, with all that hangs on them.
    std::size_t not_drawable() const { return not_drawable_; }
    /// For each point 1 when it is drawn, 0 when not.
    std::span<const std::uint8_t> drawn() const { return usable_; }

private:
    struct Indices {
        Buffer buffer = Buffer::create();
        GLsizei count = 0;
    };
    void make_indices();
    void upload_quantity(std::span<const float> quantity);
    void upload(Indices& indices);

    int columns_ = 0, rows_ = 0;
    std::size_t not_drawable_ = 0;
    bool partial_ = false; ///< the index buffers leave points out
    std::vector<std::uint8_t> usable_;
    std::vector<float> positions_, normals_, tangents_; ///< the first only where points are left out
    std::vector<std::uint32_t> scratch_;

    VertexArray vertices_ = VertexArray::create();
    Buffer position_ = Buffer::create(), normal_ = Buffer::create(), uv_ = Buffer::create();
    Buffer tangent_ = Buffer::create(), quantity_ = Buffer::create();
    Indices triangles_, points_;
    std::array<Indices, sim::spring_kinds> springs_;
};

} // namespace clothlab::render
