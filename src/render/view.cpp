#include "render/view.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace clothlab::render {

namespace {

struct Axes {
    glm::vec3 right, up, back;
};

/// The camera's axes, also where eye, target and up do not say what they are.
Axes axes(const View& view) {
    glm::vec3 back = view.eye - view.target;
    const float distance = glm::length(back);
    back = distance > 1e-9f ? back / distance : glm::vec3(0, 0, 1);
    glm::vec3 right = glm::cross(view.up, back);
    if (!(glm::length(right) > 1e-6f))
        right = glm::cross(glm::vec3(0, 0, back.y > 0 ? -1 : 1), back);
    if (!(glm::length(right) > 1e-6f))
        right = glm::vec3(1, 0, 0);
    right = glm::normalize(right);
    return {right, glm::cross(back, right), back};
}

} // namespace

glm::mat4 view_matrix(const View& view) {
    const Axes a = axes(view);
    glm::mat4 m(1);
    for (int i = 0; i < 3; ++i) {
        m[i][0] = a.right[i];
        m[i][1] = a.up[i];
        m[i][2] = a.back[i];
    }
    m[3] = glm::vec4(-glm::dot(a.right, view.eye), -glm::dot(a.up, view.eye), -glm::dot(a.back, view.eye), 1);
    return m;
}

glm::mat4 projection_matrix(const View& view, float aspect) {
    if (view.projection == Projection::orthographic) {
        const float half = std::max(view.height, 1e-6f) / 2, half_width = half * std::max(aspect, 1e-4f);
        const float furthest = std::max(view.far_plane, view.near_plane + 1e-3f);
        return glm::ortho(-half_width, half_width, -half, half, view.near_plane, furthest);
    }
    const float near_plane = std::max(view.near_plane, 1e-6f);
    const float far_plane = std::max(view.far_plane, 2 * near_plane);
    const float fov = glm::radians(std::clamp(view.fov_y_degrees, 1.f, 170.f));
    return glm::perspective(fov, std::max(aspect, 1e-4f), near_plane, far_plane);
}

glm::vec4 seen_from(const View& view) {
    return view.projection == Projection::perspective ? glm::vec4(view.eye, 1) : glm::vec4(axes(view).back, 0);
}

bool drawable(const glm::vec3& p) {
    // Comparisons with NaN are false.
    return std::abs(p.x) <= drawable_range && std::abs(p.y) <= drawable_range && std::abs(p.z) <= drawable_range;
}

} // namespace clothlab::render
