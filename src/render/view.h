// From where and how the scene is seen: a plain camera and its matrices.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace clothlab::render {

enum class Projection : std::uint8_t { perspective, orthographic };

/// A camera. Lengths in m.
struct View {
    glm::vec3 eye{0.5f, 1.2f, 3.0f};
    glm::vec3 target{0.5f, 0.5f, 0.5f};
    glm::vec3 up{0, 1, 0};
    float fov_y_degrees = 40; ///< full vertical angle
    float near_plane = 0.02f;
    float far_plane = 200;
    Projection projection = Projection::perspective;
    float height = 1; ///< of an orthographic picture, from bottom to top; its near plane may be behind the eye
    bool operator==(const View&) const = default;
};

/// World to camera. A view without a direction (eye on target, up along it) still gives a finite matrix.
glm::mat4 view_matrix(const View& view);
/// Camera to clip space; aspect is width / height.
glm::mat4 projection_matrix(const View& view, float aspect);

/// Where light has to go to be seen: the eye and 1, or, as orthographic light goes the same way from everywhere, that
/// direction and 0.
glm::vec4 seen_from(const View& view);

/// Points further than this from the origin in any coordinate, in m, are not drawn: a cloth that blew up.
inline constexpr float drawable_range = 1e6f;
bool drawable(const glm::vec3& point);

} // namespace clothlab::render
