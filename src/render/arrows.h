// Vectors in the scene as arrows that are equally wide on the screen wherever they are: displacements, forces.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/gl.h"

namespace clothlab::render {

class ShaderLibrary;

struct Arrow {
    glm::vec3 from, to; ///< m
    glm::vec3 colour;   ///< sRGB, 0 to 1
    bool operator==(const Arrow&) const = default;
};

class Arrows {
public:
    /// Draws arrows into the picture so far, and a dot at a point that is marked. What of an arrow lies behind
    /// something is drawn faintly, the marker in front of everything. `width` of shafts in px; an arrow alone is bold
    /// whatever that is. Those without a length or with ends that cannot be drawn are left out. Returns how many were
    /// drawn.
    std::size_t draw(std::span<const Arrow> arrows, const std::optional<glm::vec3>& marker, float width,
                     ShaderLibrary& shaders);

private:
    void draw_marker(const glm::vec3& at, ShaderLibrary& shaders);

    VertexArray vertices_ = VertexArray::create(), marker_vertices_ = VertexArray::create();
    Buffer data_ = Buffer::create(), marker_ = Buffer::create();
    std::vector<Arrow> drawn_;
};

} // namespace clothlab::render
