// The cloth on the graphics card: positions and normals new with every snapshot, the topology only with a new grid.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
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

    /// Takes over a snapshot's positions and quantity; nothing is done for the capture that it has already
    /// (Snapshot::capture). A snapshot whose positions do not fill its grid is taken as no cloth.
    void update(const sim::Snapshot& snapshot);
    /// No cloth: nothing is drawn.
    void clear();

    /// Whether the attribute `quantity` is the snapshot's first one, as after an update, or the second; 0 where it has
    /// none.
    void use_quantity(bool second);
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
    struct Stream {
        Buffer buffer = Buffer::create();
        std::size_t size = 0; ///< in floats
    };
    void make_indices();
    void make_uv();
    void make_vertices(const sim::Snapshot& snapshot);
    void upload(Indices& indices);

    std::uint64_t capture_ = 0; ///< that the mesh has; 0: one that has no number
    int columns_ = 0, rows_ = 0;
    std::size_t not_drawable_ = 0;
    std::array<std::optional<std::size_t>, 2> quantity_at_; ///< where in the vertex data
    bool partial_ = false;                                  ///< the index buffers leave points out
    std::vector<std::uint8_t> usable_;
    std::vector<float> data_; ///< what goes into vertex_data_
    std::vector<std::uint32_t> scratch_;

    VertexArray vertices_ = VertexArray::create();
    Buffer uv_ = Buffer::create();
    /// All positions, then all normals, tangents and, if any, quantities. One after the other in turn: the driver may
    /// still draw with the last two.
    std::array<Stream, 3> vertex_data_;
    std::size_t current_ = 0; ///< the one to draw with
    Indices triangles_, points_;
    std::array<Indices, sim::spring_kinds> springs_;
};

} // namespace clothlab::render
