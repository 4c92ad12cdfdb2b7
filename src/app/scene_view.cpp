#include "app/scene_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/camera.h"

namespace clothlab::app {
namespace {

glm::vec3 to_glm(const sim::Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

render::Light to_light(const scene::Lamp& lamp) {
    return {to_glm(lamp.position), static_cast<float>(lamp.intensity)};
}

render::Uniform uniform(const scene::ShaderParameter& parameter, const scene::ShaderValue& value) {
    switch (parameter.type) {
    case scene::ShaderParameterType::number:
        return {parameter.name, static_cast<float>(std::get<double>(value))};
    case scene::ShaderParameterType::integer:
        return {parameter.name, static_cast<int>(std::get<double>(value))};
    case scene::ShaderParameterType::flag:
        return {parameter.name, std::get<bool>(value)};
    case scene::ShaderParameterType::colour:
        return {parameter.name, render::linear(to_glm(std::get<sim::Vec3>(value)))};
    case scene::ShaderParameterType::texture:
        break;
    }
    return {parameter.name,
            render::TextureName{std::get<std::string>(value), static_cast<render::TextureUsage>(parameter.usage)}};
}

const scene::ShaderDeclaration* find(const std::vector<scene::ShaderDeclaration>& shaders, const std::string& name) {
    const auto found = std::find_if(shaders.begin(), shaders.end(),
                                    [&](const scene::ShaderDeclaration& shader) { return shader.name == name; });
    return found == shaders.end() ? nullptr : &*found;
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
    if (camera.projection == scene::Projection::orthographic) {
        view.projection = render::Projection::orthographic;
        view.height = static_cast<float>(scene::height_at_target(camera) / std::min(aspect, 1.0));
        view.far_plane = static_cast<float>(20 * std::max(camera.distance, 1.0));
        view.near_plane = -view.far_plane; // nothing is too near to be seen
        return view;
    }
    // Depth precision where it is needed: a cloth seen from 100 m does not need the first centimetres.
    view.near_plane = static_cast<float>(std::clamp(camera.distance / 100, 0.001, 1.0));
    view.far_plane = view.near_plane * 20000;
    return view;
}

int samples_of(scene::Multisampling choice, int automatic) {
    switch (choice) {
    case scene::Multisampling::automatic:
        break;
    case scene::Multisampling::off:
        return 1;
    case scene::Multisampling::two:
        return 2;
    case scene::Multisampling::four:
        return 4;
    case scene::Multisampling::eight:
        return 8;
    }
    return automatic;
}

sim::SnapshotExtras extras_of(const scene::Look& look, const std::vector<scene::ShaderDeclaration>& shaders) {
    const auto quantity_of = [&](const std::string& name) {
        const scene::ShaderDeclaration* shader = find(shaders, name);
        const auto quantity = shader ? sim::find_point_quantity(shader->quantity) : std::nullopt;
        return quantity.value_or(sim::PointQuantity::none);
    };
    sim::SnapshotExtras extras;
    extras.quantity = quantity_of(look.shader);
    if (look.split.on && quantity_of(look.split.shader) != extras.quantity)
        extras.second_quantity = quantity_of(look.split.shader);
    return extras;
}

render::Surface to_surface(const scene::Look& look, const std::vector<scene::ShaderDeclaration>& shaders,
                           const std::string& shader) {
    render::Surface surface;
    surface.shader = shader;
    surface.sphere_lat_lines = look.sphere_latitude_lines;
    surface.sphere_lon_lines = look.sphere_longitude_lines;
    const scene::ShaderDeclaration* found = find(shaders, shader);
    if (!found)
        return surface;
    surface.lines = found->lines;
    surface.translucent = found->translucent;
    for (const scene::ShaderParameter& p : found->parameters)
        surface.uniforms.push_back(uniform(p, value_of(look, *found, p)));
    return surface;
}

render::Scene to_render(const scene::Scene& scene, const std::vector<scene::ShaderDeclaration>& shaders,
                        const sim::Snapshot* snapshot, double aspect) {
    render::Scene result;
    result.snapshot = snapshot;
    result.colliders = scene.simulation.colliders;
    result.pinned = scene.simulation.cloth.pinned;
    result.view = to_view(scene::camera_of(scene), aspect);
    const scene::Look& look = scene.look;
    render::Options& o = result.options;
    o.surface = to_surface(look, shaders, look.shader);
    if (look.split.on) {
        result.right = to_surface(look, shaders, look.split.shader);
        result.right->sphere_lat_lines = look.split.sphere_latitude_lines;
        result.right->sphere_lon_lines = look.split.sphere_longitude_lines;
        result.right->second_quantity = extras_of(look, shaders).second_quantity != sim::PointQuantity::none;
        result.divider = static_cast<float>(look.split.position);
    }
    o.show_springs = {look.show_structural, look.show_shearing, look.show_bending};
    o.springs_over_surface = look.springs_over_surface;
    o.show_pins = look.show_pins;
    o.show_colliders = look.show_colliders;
    o.ground_grid = look.ground_grid;
    o.spheres_like_cloth = look.sphere == scene::SphereLook::cloth;
    // The front faces the viewer at first: up, or, for cloth that stands, to +z.
    o.swap_sides = scene.simulation.cloth.orientation == sim::Orientation::vertical;
    o.lights = {to_light(look.lamp), to_light(look.second_lamp)};
    o.ambient = static_cast<float>(look.ambient);
    o.fill = static_cast<float>(look.fill);
    o.shadow = look.shadow;
    return result;
}

} // namespace clothlab::app
