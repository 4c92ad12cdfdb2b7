// What the cloth falls on, as meshes: a unit sphere of any coarseness, and a plane's place under the scene.
#pragma once

#include <optional>

#include "render/gl.h"
#include "render/view.h"
#include "sim/description.h"

namespace clothlab::render {

/// The unit sphere around the origin, of rings and sectors. Its attributes are a cloth's: u grows to the east, v from
/// the north pole (+y) down, tangents are d position / d u, not normalised. At a pole, where that is zero, they have
/// the direction that it has along the vertex' own meridian, and the length that it has half a ring away.
class SphereMesh {
public:
    /// Rebuilt when the numbers change; numbers below 3 are raised to 3, those above 1024 lowered.
    void set_lines(int latitude, int longitude);
    /// Draws with the program in use, as triangles with position, normal (the position), uv and tangent.
    void draw() const;

private:
    int latitude_ = 0, longitude_ = 0;
    GLsizei count_ = 0;
    VertexArray vertices_ = VertexArray::create();
    Buffer points_ = Buffer::create(), indices_ = Buffer::create();
};

/// A sphere with a place in the picture: finite, of positive radius.
std::optional<glm::vec4> drawable_sphere(const sim::Sphere& sphere);

/// The part of a plane that is drawn: a disc, fading out towards its edge, around the point under the view's target.
struct PlanePatch {
    glm::vec3 centre, normal;
    glm::vec3 u, v;   ///< unit axes of the pattern; x and z for a floor
    glm::vec3 origin; ///< of the pattern: the plane's point
    float radius;     ///< m
    bool see_through; ///< it stands between the eye and what the eye looks at
};
/// Nothing for a plane without a direction or a finite place.
std::optional<PlanePatch> plane_patch(const sim::Plane& plane, const View& view);

} // namespace clothlab::render
