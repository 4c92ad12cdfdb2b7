#include "render/collider_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "render/shader_library.h"

namespace clothlab::render {

namespace {

glm::vec3 to_glm(const sim::Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

} // namespace

void SphereMesh::set_lines(int latitude, int longitude) {
    latitude = std::clamp(latitude, 3, 1024);
    longitude = std::clamp(longitude, 3, 1024);
    if (latitude == latitude_ && longitude == longitude_)
        return;
    latitude_ = latitude;
    longitude_ = longitude;

    std::vector<float> points; // x y z u v, tangent
    std::vector<std::uint32_t> indices;
    const double pole = std::sin(0.5 * std::numbers::pi / latitude);
    for (int i = 0; i <= latitude; ++i) {
        const double v = static_cast<double>(i) / latitude, polar = v * std::numbers::pi;
        for (int k = 0; k <= longitude; ++k) {
            const double u = static_cast<double>(k) / longitude, turn = 2 * u * std::numbers::pi;
            const double ring = 2 * std::numbers::pi * std::max(std::sin(polar), pole);
            for (const double value :
                 {std::sin(polar) * std::sin(turn), std::cos(polar), std::sin(polar) * std::cos(turn), u, v,
                  ring * std::cos(turn), 0.0, -ring * std::sin(turn)})
                points.push_back(static_cast<float>(value));
        }
    }
    const auto stride = static_cast<std::uint32_t>(longitude + 1);
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(latitude); ++i) {
        for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(longitude); ++k) {
            const std::uint32_t a = i * stride + k, below = a + stride;
            indices.insert(indices.end(), {a, below, a + 1, a + 1, below, below + 1});
        }
    }
    count_ = static_cast<GLsizei>(indices.size());

    glBindVertexArray(vertices_.id());
    glBindBuffer(GL_ARRAY_BUFFER, points_.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(points.size() * sizeof(float)), points.data(),
                 GL_STATIC_DRAW);
    struct Part {
        GLuint place;
        GLint size;
        std::size_t offset;
    };
    for (const auto& [place, size, offset] : {Part{ShaderLibrary::position, 3, 0}, Part{ShaderLibrary::normal, 3, 0},
                                              Part{ShaderLibrary::uv, 2, 3}, Part{ShaderLibrary::tangent, 3, 5}}) {
        glEnableVertexAttribArray(place);
        glVertexAttribPointer(place, size, GL_FLOAT, GL_FALSE, 8 * sizeof(float),
                              reinterpret_cast<const void*>(offset * sizeof(float)));
    }
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
                 indices.data(), GL_STATIC_DRAW);
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

void SphereMesh::draw() const {
    glBindVertexArray(vertices_.id());
    glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
}

std::optional<glm::vec4> drawable_sphere(const sim::Sphere& sphere) {
    const glm::vec3 origin = to_glm(sphere.origin);
    const auto radius = static_cast<float>(sphere.radius);
    if (!drawable(origin) || !(radius > 0) || !(radius <= drawable_range))
        return {};
    return glm::vec4(origin, radius);
}

std::optional<PlanePatch> plane_patch(const sim::Plane& plane, const View& view) {
    PlanePatch patch{};
    patch.origin = to_glm(plane.point);
    const glm::dvec3 normal(plane.normal.x, plane.normal.y, plane.normal.z);
    const double length = glm::length(normal);
    if (!drawable(patch.origin) || !(length > 0) || !std::isfinite(length))
        return {};
    patch.normal = glm::vec3(normal / length);

    // x along the world's x, or along z for a wall across x.
    const glm::vec3 along = std::abs(patch.normal.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
    patch.u = glm::normalize(along - glm::dot(along, patch.normal) * patch.normal);
    patch.v = glm::cross(patch.u, patch.normal);

    const auto height = [&](const glm::vec3& p) { return glm::dot(p - patch.origin, patch.normal); };
    patch.centre = view.target - height(view.target) * patch.normal;
    patch.radius = std::clamp(5 * glm::length(view.eye - view.target), 0.5f, 0.8f * view.far_plane);
    // Whether the plane hides what stands on it.
    const glm::vec4 eye = seen_from(view);
    const float eye_height = eye.w == 0 ? glm::dot(glm::vec3(eye), patch.normal) : height(view.eye);
    patch.see_through = eye_height * height(view.target) < 0;
    return patch;
}

} // namespace clothlab::render
