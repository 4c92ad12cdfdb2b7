// A second cloth over a picture: where it would be in another future. See-through, of one colour, with its outline.
#pragma once

#include "render/cloth_mesh.h"
#include "render/shader_library.h"

namespace clothlab::render {

class Ghost {
public:
    /// Takes over a snapshot as ClothMesh does; none: nothing is drawn.
    void update(const sim::Snapshot* snapshot);
    /// Draws over what has been drawn, with its depths: in front of it see-through, and behind it by more than a
    /// hundredth of the distance only the outline. Of several layers the nearest is drawn, so it is the same in
    /// whatever order its triangles are. Where it is as far away as the cloth, the cloth hides it. Leaves the depth
    /// buffer with the ghost in it. Returns the number of triangles.
    std::size_t draw(ShaderLibrary& shaders) const;

    /// Draws it for cloth that is see-through itself to be drawn over; all layers, none of which is left in the depth
    /// buffer.
    void draw_under(ShaderLibrary& shaders) const;

    /// Points left out, with all that hangs on them.
    std::size_t not_drawable() const { return cloth_.not_drawable(); }

private:
    const Program& use(ShaderLibrary& shaders) const;

    ClothMesh cloth_;
    glm::vec2 cells_{1, 1}; ///< between its lines
};

} // namespace clothlab::render
