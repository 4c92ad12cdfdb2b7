#include "scene/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace clothlab::scene {
namespace {

constexpr double radian = std::numbers::pi / 180;

double dot(const sim::Vec3& a, const sim::Vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

double mixed(double a, double b, double share) {
    return a + (b - a) * share;
}

/// How far the camera has to be from its target for a point to be seen, in m.
double distance_for(const Camera& camera, const CameraFrame& axes, const sim::Vec3& point) {
    const sim::Vec3& t = camera.target;
    const sim::Vec3 p{point.x - t.x, point.y - t.y, point.z - t.z};
    const sim::Vec3 back{(axes.eye.x - t.x) / camera.distance, (axes.eye.y - t.y) / camera.distance,
                         (axes.eye.z - t.z) / camera.distance};
    const double off_axis = std::max(std::abs(dot(p, axes.right)), std::abs(dot(p, axes.up)));
    const double needed = off_axis / std::tan(camera.fov / 2 * radian);
    return camera.projection == Projection::orthographic ? needed : needed + dot(p, back);
}

/// Around the target, with a little margin around the points.
Camera far_enough(Camera camera, std::span<const sim::Vec3> points) {
    const CameraFrame axes = frame(camera);
    double distance = 0;
    for (const sim::Vec3& p : points)
        distance = std::max(distance, distance_for(camera, axes, p));
    camera.distance = std::clamp(1.06 * distance, min_distance, max_distance);
    return camera;
}

void include(Box& box, const sim::Vec3& low, const sim::Vec3& high) {
    box.low = {std::min(box.low.x, low.x), std::min(box.low.y, low.y), std::min(box.low.z, low.z)};
    box.high = {std::max(box.high.x, high.x), std::max(box.high.y, high.y), std::max(box.high.z, high.z)};
}

} // namespace

CameraFrame frame(const Camera& camera) {
    const double cy = std::cos(camera.yaw * radian), sy = std::sin(camera.yaw * radian);
    const double cp = std::cos(camera.pitch * radian), sp = std::sin(camera.pitch * radian);
    const sim::Vec3& t = camera.target;
    const double d = camera.distance;
    return {.eye = {t.x + d * sy * cp, t.y + d * sp, t.z + d * cy * cp},
            .right = {cy, 0, -sy},
            .up = {-sy * sp, cp, -cy * sp}};
}

std::span<const SideInfo> sides() {
    static const Camera usual;
    static const std::array list{
        SideInfo{Side::front, "Front", 0, 0},  SideInfo{Side::back, "Back", 180, 0},
        SideInfo{Side::right, "Right", 90, 0}, SideInfo{Side::left, "Left", -90, 0},
        SideInfo{Side::top, "Top", 0, 90},     SideInfo{Side::three_quarter, "Three-quarter", usual.yaw, usual.pitch},
    };
    return list;
}

Camera seen_from(Camera camera, Side side) {
    const SideInfo& info = sides()[static_cast<std::size_t>(side)];
    camera.yaw = info.yaw;
    camera.pitch = info.pitch;
    return camera;
}

Box start_box(const sim::Description& description) {
    const sim::Cloth& cloth = description.cloth;
    const sim::Vec3& o = cloth.offset;
    Box box;
    if (cloth.orientation == sim::Orientation::horizontal) {
        box = {{o.x, o.y + 1, o.z}, {o.x + cloth.width, o.y + 1, o.z + cloth.height}};
        // Horizontal cloth falls: down to a collider, or by its own height when it hangs from pins.
        box.low.y = description.colliders.empty() ? box.high.y - cloth.height : std::min(box.low.y, 0.0);
    } else {
        box = {{o.x, o.y, o.z}, {o.x + cloth.width, o.y + cloth.height, o.z}};
    }
    for (const sim::Collider& collider : description.colliders) {
        const auto* s = std::get_if<sim::Sphere>(&collider);
        if (!s)
            continue;
        const double r = s->radius;
        include(box, {s->origin.x - r, s->origin.y - r, s->origin.z - r},
                {s->origin.x + r, s->origin.y + r, s->origin.z + r});
    }
    return box;
}

Camera fitted(Camera camera, const Box& box) {
    camera.target = {(box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2, (box.low.z + box.high.z) / 2};
    std::array<sim::Vec3, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
        corners[i] = {(i & 1 ? box.high : box.low).x, (i & 2 ? box.high : box.low).y, (i & 4 ? box.high : box.low).z};
    return far_enough(camera, corners);
}

Camera fitted(Camera camera, std::span<const float> points) {
    std::vector<sim::Vec3> seen;
    for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
        const sim::Vec3 p{static_cast<double>(points[i]), static_cast<double>(points[i + 1]),
                          static_cast<double>(points[i + 2])};
        if (std::hypot(p.x, p.y, p.z) < max_distance) // not so for NaN
            seen.push_back(p);
    }
    if (seen.empty())
        return camera;
    // The middle of the box along the camera's own axes: the middle of the picture.
    const CameraFrame axes = frame(camera);
    const sim::Vec3 &r = axes.right, &u = axes.up;
    const sim::Vec3 back{r.y * u.z - r.z * u.y, r.z * u.x - r.x * u.z, r.x * u.y - r.y * u.x};
    const auto middle = [&seen](const sim::Vec3& axis) {
        double low = dot(seen.front(), axis), high = low;
        for (const sim::Vec3& p : seen) {
            low = std::min(low, dot(p, axis));
            high = std::max(high, dot(p, axis));
        }
        return (low + high) / 2;
    };
    const double along_r = middle(r), along_u = middle(u), along_back = middle(back);
    camera.target = {along_r * r.x + along_u * u.x + along_back * back.x,
                     along_r * r.y + along_u * u.y + along_back * back.y,
                     along_r * r.z + along_u * u.z + along_back * back.z};
    return far_enough(camera, seen);
}

Camera fitting_camera(const sim::Description& description) {
    return fitted(Camera{}, start_box(description));
}

Camera camera_of(const Scene& scene) {
    return scene.camera ? *scene.camera : fitting_camera(scene.simulation);
}

double height_at_target(const Camera& camera) {
    return 2 * camera.distance * std::tan(camera.fov / 2 * radian);
}

Camera between(const Camera& from, const Camera& to, double share) {
    if (share >= 1)
        return to;
    Camera camera = to;
    camera.target = {mixed(from.target.x, to.target.x, share), mixed(from.target.y, to.target.y, share),
                     mixed(from.target.z, to.target.z, share)};
    camera.distance = from.distance * std::pow(to.distance / from.distance, share); // as fast near as far away
    camera.yaw = from.yaw + std::remainder(to.yaw - from.yaw, 360.0) * share;
    camera.pitch = mixed(from.pitch, to.pitch, share);
    camera.fov = mixed(from.fov, to.fov, share);
    return camera;
}

} // namespace clothlab::scene
