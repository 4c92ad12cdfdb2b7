#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clothlab::scene {

CameraFrame frame(const Camera& camera) {
    constexpr double radian = std::numbers::pi / 180;
    const double cy = std::cos(camera.yaw * radian), sy = std::sin(camera.yaw * radian);
    const double cp = std::cos(camera.pitch * radian), sp = std::sin(camera.pitch * radian);
    const sim::Vec3& t = camera.target;
    const double d = camera.distance;
    return {.eye = {t.x + d * sy * cp, t.y + d * sp, t.z + d * cy * cp},
            .right = {cy, 0, -sy},
            .up = {-sy * sp, cp, -cy * sp}};
}

Camera fitting_camera(const sim::Description& description) {
    const sim::Cloth& cloth = description.cloth;
    const sim::Vec3& o = cloth.offset;
    sim::Vec3 low, high;
    if (cloth.orientation == sim::Orientation::horizontal) {
        low = {o.x, o.y + 1, o.z};
        high = {o.x + cloth.width, o.y + 1, o.z + cloth.height};
        // Horizontal cloth falls: down to a collider, or by its own height when it hangs from pins.
        low.y = description.colliders.empty() ? high.y - cloth.height : std::min(low.y, 0.0);
    } else {
        low = {o.x, o.y, o.z};
        high = {o.x + cloth.width, o.y + cloth.height, o.z};
    }
    for (const sim::Collider& collider : description.colliders) {
        const auto* s = std::get_if<sim::Sphere>(&collider);
        if (!s)
            continue;
        low = {std::min(low.x, s->origin.x - s->radius), std::min(low.y, s->origin.y - s->radius),
               std::min(low.z, s->origin.z - s->radius)};
        high = {std::max(high.x, s->origin.x + s->radius), std::max(high.y, s->origin.y + s->radius),
                std::max(high.z, s->origin.z + s->radius)};
    }
    Camera camera;
    camera.target = {(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2};
    // As near as every corner of the box allows, in a square picture, and a little margin.
    const CameraFrame axes = frame(camera);
    const sim::Vec3 half{(high.x - low.x) / 2, (high.y - low.y) / 2, (high.z - low.z) / 2};
    const auto along = [](const sim::Vec3& a, const sim::Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    const sim::Vec3 back{(axes.eye.x - camera.target.x) / camera.distance,
                         (axes.eye.y - camera.target.y) / camera.distance,
                         (axes.eye.z - camera.target.z) / camera.distance};
    const double slope = std::tan(camera.fov / 2 * std::numbers::pi / 180);
    double distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const sim::Vec3 c{corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z};
        const double off_axis = std::max(std::abs(along(c, axes.right)), std::abs(along(c, axes.up)));
        distance = std::max(distance, along(c, back) + off_axis / slope);
    }
    camera.distance = 1.06 * distance;
    return camera;
}

Camera camera_of(const Scene& scene) {
    return scene.camera ? *scene.camera : fitting_camera(scene.simulation);
}

} // namespace clothlab::scene
