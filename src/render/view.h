// From where and how the scene is seen: a plain camera, its matrices, and how mouse movements change it.
#pragma once

#include <span>

#include <glm/glm.hpp>

#include "sim/description.h"
#include "sim/snapshot.h"

namespace clothlab::render {

/// A perspective camera. Lengths in m.
struct View {
    glm::vec3 eye{0.5f, 1.2f, 3.0f};
    glm::vec3 target{0.5f, 0.5f, 0.5f};
    glm::vec3 up{0, 1, 0};
    float fov_y_degrees = 40; ///< full vertical angle
    float near_plane = 0.02f;
    float far_plane = 200;
    bool operator==(const View&) const = default;
};

/// World to camera. A view without a direction (eye on target, up along it) still gives a finite matrix.
glm::mat4 view_matrix(const View& view);
/// Camera to clip space; aspect is width / height.
glm::mat4 projection_matrix(const View& view, float aspect);

/// An axis-aligned box in m; empty when a min is larger than its max.
struct Box {
    glm::vec3 min{1e30f}, max{-1e30f};
    bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
    void add(const glm::vec3& point);
    void add(const Box& box);
};

/// The box around all of a snapshot's points that can be drawn (finite, within drawable_range).
Box bounds(const sim::Snapshot& snapshot);
/// The box around a snapshot's points and the spheres among the colliders.
Box bounds(const sim::Snapshot& snapshot, std::span<const sim::Collider> colliders);

/// Points further than this from the origin in any coordinate, in m, are not drawn: a cloth that blew up.
inline constexpr float drawable_range = 1e6f;
bool drawable(const glm::vec3& point);

/// The view that shows a box whole, from a direction (from the box towards the eye). An empty box is taken as the
/// 1 m cube above the origin.
View fit_view(const Box& box, glm::vec3 direction = {0.45f, 0.4f, 1}, float aspect = 16.f / 9,
              float fov_y_degrees = 40);

/// The eye moved around the target by angles in radians; stops short of the poles.
View orbit(View view, float yaw, float pitch);
/// Eye and target moved so that what is at the target follows the mouse: pixels right and down, of a viewport of this
/// height in pixels.
View pan(View view, float right, float down, float viewport_height);
/// The eye's distance to the target times a factor, kept within the planes.
View zoom(View view, float factor);

} // namespace clothlab::render
