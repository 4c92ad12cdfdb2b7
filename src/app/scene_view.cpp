#include "app/scene_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clothlab::app {
namespace {

glm::vec3 to_glm(const sim::Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

} // namespace

render::View to_view(const scene::Camera& camera, double aspect) {
    const scene::CameraFrame frame = scene::frame(camera);
    render::View view;
    view.eye = to_glm(frame.eye);
    view.target = to_glm(camera.target);
    view.up = to_glm(frame.up);
    constexpr double half_degree = std::numbers::pi / 360;
    const double half_height = std::tan(camera.fov * half_degree) / std::min(aspect, 1.0);
    view.fov_y_degrees = static_cast<float>(std::atan(half_height) / half_degree);
    // Depth precision where it is needed: a cloth seen from 100 m does not need the first centimetres.
    view.near_plane = static_cast<float>(std::clamp(camera.distance / 100, 0.001, 1.0));
    view.far_plane = view.near_plane * 20000;
    return view;
}

render::Scene to_render(const scene::Scene& scene, const sim::Snapshot* snapshot, double aspect) {
    render::Scene result;
    result.snapshot = snapshot;
    result.colliders = scene.simulation.colliders;
    result.pinned = scene.simulation.cloth.pinned;
    result.view = to_view(scene::camera_of(scene), aspect);
    const scene::Look& look = scene.look;
    render::Options& o = result.options;
    o.shader = look.shader;
    o.show_springs = {look.show_structural, look.show_shearing, look.show_bending};
    o.springs_over_surface = look.springs_over_surface;
    o.show_pins = look.show_pins;
    o.show_colliders = look.show_colliders;
    // The front faces the viewer at first: up, or, for cloth that stands, to +z.
    o.swap_sides = scene.simulation.cloth.orientation == sim::Orientation::vertical;
    o.sphere_lat_lines = look.sphere_latitude_lines;
    o.sphere_lon_lines = look.sphere_longitude_lines;
    return result;
}

} // namespace clothlab::app
