// The cloth's triangles from the furthest to the nearest: what blending needs to be right from any side.
#pragma once

#include <cstdint>
#include <vector>

#include "render/cloth_mesh.h"
#include "render/view.h"

namespace clothlab::render {

class SortedTriangles {
public:
    /// Draws the cloth's surface with the program in use, as ClothMesh::draw_surface does, in the order of the
    /// triangles' centres along the view. Triangles that cut through each other have no right order. `snapshot` is what
    /// the mesh was updated with. Returns the number of triangles.
    std::size_t draw(const ClothMesh& cloth, const sim::Snapshot& snapshot, const View& view);

private:
    struct Triangle {
        float distance; ///< of three times its centre, along the view
        std::uint32_t a, b, c;
    };
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> indices_;
    Buffer buffer_ = Buffer::create();
};

} // namespace clothlab::render
