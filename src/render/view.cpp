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

float half_height(const View& view) {
    return std::tan(glm::radians(std::clamp(view.fov_y_degrees, 1.f, 170.f)) / 2);
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
    const float near_plane = std::max(view.near_plane, 1e-6f);
    const float far_plane = std::max(view.far_plane, 2 * near_plane);
    return glm::perspective(2 * std::atan(half_height(view)), std::max(aspect, 1e-4f), near_plane, far_plane);
}

void Box::add(const glm::vec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
}

void Box::add(const Box& box) {
    min = glm::min(min, box.min);
    max = glm::max(max, box.max);
}

bool drawable(const glm::vec3& p) {
    // Comparisons with NaN are false.
    return std::abs(p.x) <= drawable_range && std::abs(p.y) <= drawable_range && std::abs(p.z) <= drawable_range;
}

Box bounds(const sim::Snapshot& snapshot) {
    Box box;
    for (std::size_t i = 0; i + 2 < snapshot.positions.size(); i += 3) {
        const glm::vec3 p(snapshot.positions[i], snapshot.positions[i + 1], snapshot.positions[i + 2]);
        if (drawable(p))
            box.add(p);
    }
    return box;
}

Box bounds(const sim::Snapshot& snapshot, std::span<const sim::Collider> colliders) {
    Box box = bounds(snapshot);
    for (const sim::Collider& collider : colliders) {
        const auto* sphere = std::get_if<sim::Sphere>(&collider);
        if (sphere == nullptr)
            continue;
        const glm::vec3 origin(sphere->origin.x, sphere->origin.y, sphere->origin.z);
        const auto radius = static_cast<float>(sphere->radius);
        if (!drawable(origin - radius) || !drawable(origin + radius))
            continue;
        box.add(origin - radius);
        box.add(origin + radius);
    }
    return box;
}

View fit_view(const Box& given, glm::vec3 direction, float aspect, float fov_y_degrees) {
    const Box box = given.empty() ? Box{{-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}} : given;
    View view;
    view.fov_y_degrees = fov_y_degrees;
    view.target = (box.min + box.max) * 0.5f;
    if (!(glm::length(direction) > 1e-9f))
        direction = {0, 0, 1};
    view.eye = view.target + glm::normalize(direction);

    // The least distance at which all corners are inside the four sides of the view, and a margin.
    const Axes a = axes(view);
    const float tan_y = half_height(view), tan_x = tan_y * std::max(aspect, 1e-4f);
    float distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p = glm::vec3(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                      corner & 4 ? box.max.z : box.min.z) -
                            view.target;
        const float needed = std::max(std::abs(glm::dot(p, a.right)) / tan_x, std::abs(glm::dot(p, a.up)) / tan_y);
        distance = std::max(distance, needed + glm::dot(p, a.back));
    }
    distance = std::max(distance * 1.06f, 0.01f);
    const float radius = glm::length(box.max - box.min) / 2;
    view.eye = view.target + a.back * distance;
    view.near_plane = std::max(distance * 0.01f, 1e-4f);
    view.far_plane = std::max(200.f, 20 * (distance + radius));
    return view;
}

View orbit(View view, float yaw, float pitch) {
    const glm::vec3 arm = view.eye - view.target;
    const float distance = glm::length(arm);
    if (!(distance > 1e-9f))
        return view;
    const glm::vec3 up = glm::length(view.up) > 1e-9f ? glm::normalize(view.up) : glm::vec3(0, 1, 0);
    // Elevation over the plane across `up`, and a horizontal direction to turn.
    const float limit = glm::radians(89.f);
    const float elevation = std::asin(std::clamp(glm::dot(arm, up) / distance, -1.f, 1.f));
    const float raised = std::clamp(elevation + pitch, -limit, limit);
    const glm::vec3 right = axes(view).right;
    const glm::vec3 level = glm::normalize(glm::cross(right, up));
    const glm::vec3 turned = glm::vec3(glm::rotate(glm::mat4(1), yaw, up) * glm::vec4(level, 0));
    view.eye = view.target + distance * (std::cos(raised) * turned + std::sin(raised) * up);
    return view;
}

View pan(View view, float right, float down, float viewport_height) {
    const Axes a = axes(view);
    const float per_pixel =
        2 * half_height(view) * glm::length(view.eye - view.target) / std::max(viewport_height, 1.f);
    const glm::vec3 shift = (-right * a.right + down * a.up) * per_pixel;
    view.eye += shift;
    view.target += shift;
    return view;
}

View zoom(View view, float factor) {
    const glm::vec3 arm = view.eye - view.target;
    const float distance = glm::length(arm);
    if (!(distance > 1e-9f) || !(factor > 0))
        return view;
    const float nearest = 2 * view.near_plane, furthest = std::max(nearest, view.far_plane / 4);
    view.eye = view.target + arm / distance * std::clamp(distance * factor, nearest, furthest);
    return view;
}

} // namespace clothlab::render
