// The first light's shadow: where it falls, and that nothing shades itself.
#include <cmath>

#include "gui/render_fixture.h"
#include "render/shadow.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// Looks down from above the origin on a plane at y = 0.
render::Scene floor_scene(const std::vector<sim::Collider>& colliders, const glm::vec3& light) {
    render::Scene scene = empty_scene();
    scene.view = vertical_view(4);
    scene.options.surface = shader_of("diffuse");
    scene.colliders = colliders;
    scene.options.lights[0] = {light, 9};
    return scene;
}

/// The point of the plane at y = 0 that is in the middle of a pixel of the picture from above.
glm::vec3 floor_point(const render::Scene& scene, const render::Target& target, int x, int y) {
    const float half_height = std::tan(glm::radians(scene.view.fov_y_degrees / 2)) * scene.view.eye.y;
    const float px = 2 * half_height / static_cast<float>(target.height());
    return {(static_cast<float>(x) + 0.5f - static_cast<float>(target.width()) / 2) * px, 0,
            (static_cast<float>(y) + 0.5f - static_cast<float>(target.height()) / 2) * px};
}

render::Image with_shadow(Studio& studio, render::Scene scene, bool on) {
    scene.options.shadow = on;
    return studio.draw(scene);
}

/// The picture without the first light.
render::Image unlit(Studio& studio, render::Scene scene) {
    scene.options.lights[0].intensity = 0;
    return studio.draw(scene);
}

bool same(const render::Image& a, const render::Image& b, int x, int y) {
    return !differs(a, b, x, y);
}

/// From a point of the plane to the light: how near the ray gets to a point.
float distance_of_ray(const glm::vec3& from, const glm::vec3& light, const glm::vec3& point) {
    return glm::length(glm::cross(glm::normalize(light - from), point - from));
}

} // namespace

TEST_CASE("A sphere's shadow on a plane is where the way to the light meets the sphere", "[shadow]") {
    Studio studio;
    const glm::vec3 light(1.2f, 3, -0.6f), centre(0.3f, 1, -0.1f);
    const float radius = 0.4f;
    const std::vector<sim::Collider> colliders = {sim::Plane{}, sim::Sphere{{0.3, 1, -0.1}, 0.4, 0}};
    const render::Scene scene = floor_scene(colliders, light);
    const render::Image on = with_shadow(studio, scene, true), off = with_shadow(studio, scene, false),
                        dark = unlit(studio, scene);
    int umbra = 0, lit = 0;
    for (int y = 0; y < on.height; ++y) {
        for (int x = 0; x < on.width; ++x) {
            const glm::vec3 p = floor_point(scene, studio.target, x, y);
            if (distance_of_ray(p, scene.view.eye, centre) < 1.1f * radius)
                continue; // the sphere is before it
            const float near = distance_of_ray(p, light, centre);
            if (near < 0.9f * radius) { // the map's sphere is a little smaller
                CHECK(same(on, dark, x, y));
                ++umbra;
            } else if (near > 1.1f * radius) {
                CHECK(on.pixel(x, y)[1] == off.pixel(x, y)[1]);
                ++lit;
            }
        }
    }
    CHECK(umbra > 300);
    CHECK(lit > 5000);
    CHECK(count_differences(off, dark) > 5000);
}

TEST_CASE("A cloth's shadow falls on plane and sphere, in both parts of a split view", "[shadow]") {
    Studio studio;
    studio.target = render::Target(160, 90, 1); // at the divider, a driver may leave samples of a pixel undrawn
    sim::Snapshot cloth = flat_cloth(12, 12);
    for (std::size_t i = 0; i < cloth.positions.size(); i += 3)
        cloth.positions[i + 1] = 1.2f;
    const std::vector<sim::Collider> colliders = {sim::Plane{}, sim::Sphere{{-1.3, 0.1, 0}, 0.2, 0}};
    render::Scene scene = floor_scene(colliders, {2.9f, 4, 0});
    scene.snapshot = &cloth;
    scene.right = scene.options.surface;
    const render::Image on = with_shadow(studio, scene, true), off = with_shadow(studio, scene, false),
                        dark = unlit(studio, scene);
    const auto pixel_of = [&](const glm::vec3& p) {
        const render::View& view = scene.view;
        const float scale =
            static_cast<float>(on.height) / (2 * std::tan(glm::radians(view.fov_y_degrees / 2)) * (view.eye.y - p.y));
        return glm::ivec2(std::floor(static_cast<float>(on.width) / 2 + scale * p.x),
                          std::floor(static_cast<float>(on.height) / 2 + scale * p.z));
    };
    // The middle of the cloth stands before (-1.24, 0, 0); the cloth itself hides what is right of -0.9 from the eye.
    for (const glm::vec3& p : {glm::vec3(-1.3f, 0.3f, 0), glm::vec3(-1.2f, 0, 0.5f), glm::vec3(-1.6f, 0, -0.6f)}) {
        const glm::ivec2 at = pixel_of(p);
        CHECK(same(on, dark, at.x, at.y));
        CHECK(differs(on, off, at.x, at.y));
    }
    for (const glm::vec3& p : {glm::vec3(-1.2f, 0, 1.1f), glm::vec3(1.2f, 0, 0), glm::vec3(0, 1.2f, 0)}) {
        const glm::ivec2 at = pixel_of(p);
        CHECK(same(on, off, at.x, at.y));
        CHECK(differs(on, dark, at.x, at.y));
    }
    scene.divider = 0; // all of the right part
    CHECK(with_shadow(studio, scene, true) == on);
}

TEST_CASE("Each part of a split view has the shadow of its own cloth: of springs alone there is none", "[shadow]") {
    Studio studio;
    studio.target = render::Target(160, 90, 1);
    sim::Snapshot cloth = flat_cloth(12, 12);
    for (std::size_t i = 0; i < cloth.positions.size(); i += 3)
        cloth.positions[i + 1] = 1.2f;
    const std::vector<sim::Collider> colliders = {sim::Plane{}};
    render::Scene scene = floor_scene(colliders, {2.9f, 4, 0});
    scene.snapshot = &cloth;
    scene.options.shadow = true;
    const render::Surface solid = scene.options.surface;
    render::Surface springs = shader_of("wireframe");
    springs.lines = true;
    for (const bool solid_on_the_right : {true, false}) {
        scene.options.surface = solid_on_the_right ? solid : springs;
        const render::Image alone = studio.draw(scene);
        scene.options.surface = solid_on_the_right ? springs : solid;
        const render::Image other = studio.draw(scene);
        REQUIRE(count_differences(alone, other) > 100);
        scene.right = solid_on_the_right ? solid : springs;
        scene.divider = 0; // all of the right part
        CHECK(count_differences(studio.draw(scene), alone) == 0);
        scene.right.reset();
    }
}

TEST_CASE("Nothing shades itself: without anything in the way, a shadow changes no pixel", "[shadow]") {
    Studio studio;
    studio.target.resize(320, 180);
    const sim::Snapshot flat = flat_cloth(30, 30);
    sim::Snapshot wavy = flat;
    for (std::size_t i = 0; i < wavy.positions.size(); i += 3)
        wavy.positions[i + 1] = 0.03f * std::sin(12 * wavy.positions[i]);
    const std::vector<sim::Collider> sphere = {sim::Sphere{{0, 0, 0}, 0.5, 0}};
    const std::vector<sim::Collider> plane = {sim::Plane{{0, -1e-4, 0}, {0, 1, 0}, 0}};
    for (const glm::vec3& light : {glm::vec3(0.1f, 3, 0.1f), glm::vec3(2, 2, 1), glm::vec3(3, 1, -2)}) {
        render::Scene scene = scene_of(flat, 1.2f);
        scene.options.lights[0] = {light, 9};
        CHECK(count_differences(with_shadow(studio, scene, true), with_shadow(studio, scene, false)) == 0);
        scene.colliders = plane; // that the cloth lies on
        scene.view.eye = {0, 1.2f, 1.2f};
        CHECK(count_differences(with_shadow(studio, scene, true), with_shadow(studio, scene, false)) == 0);
        scene.snapshot = nullptr;
        scene.colliders = sphere;
        CHECK(count_differences(with_shadow(studio, scene, true), with_shadow(studio, scene, false)) == 0);
        scene.options.surface.sphere_lat_lines = scene.options.surface.sphere_lon_lines = 7;
        CHECK(count_differences(with_shadow(studio, scene, true), with_shadow(studio, scene, false)) == 0);
    }
    render::Scene scene = scene_of(wavy, 1.2f);
    scene.options.lights[0] = {{2, 2, 1}, 9};
    CHECK(count_differences(with_shadow(studio, scene, true), with_shadow(studio, scene, false)) == 0);
}

TEST_CASE("Springs alone, and what is not drawn, cast no shadow", "[shadow]") {
    Studio studio;
    sim::Snapshot cloth = flat_cloth(12, 12);
    for (std::size_t i = 0; i < cloth.positions.size(); i += 3)
        cloth.positions[i + 1] = 1.2f;
    const std::vector<sim::Collider> colliders = {sim::Plane{}, sim::Sphere{{0, 0.5, 0}, 0.2, 0}};
    render::Scene scene = floor_scene(colliders, {2, 3, 0});
    scene.snapshot = &cloth;
    scene.options.surface = shader_of("wireframe");
    const std::vector<sim::Collider> plane = {sim::Plane{}};
    scene.colliders = plane;
    CHECK(with_shadow(studio, scene, true) == with_shadow(studio, scene, false));
    scene.colliders = colliders;
    CHECK(count_differences(with_shadow(studio, scene, true), with_shadow(studio, scene, false)) > 20);
    scene.options.show_colliders = false;
    CHECK(with_shadow(studio, scene, true) == with_shadow(studio, scene, false));
}

TEST_CASE("Drawing a shadow leaves OpenGL as it found it", "[shadow]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(4, 4);
    with_shadow(studio, scene_of(cloth), true);
    GLint bound = -1, unit = -1;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    glGetIntegerv(GL_ACTIVE_TEXTURE, &unit);
    CHECK(bound == 0);
    CHECK(unit == GL_TEXTURE0);
    CHECK(glIsEnabled(GL_POLYGON_OFFSET_FILL) == GL_FALSE);
}

TEST_CASE("A light has all that casts a shadow in its view, and a finite view from wherever it is", "[shadow]") {
    const render::Box box{{-0.3f, 0.1f, -1}, {0.8f, 0.4f, 2}};
    for (const glm::vec3& light : {glm::vec3(1.9f, 3.2f, 2.6f), glm::vec3(0, 5, 0), glm::vec3(-20, 1, 0),
                                   glm::vec3(0.2f, 0.2f, 0.3f), glm::vec3(0.25f, 0.25f, 0.5f)}) {
        const render::ShadowView view = render::shadow_view(light, box, 1024);
        const bool outside = light.y > 1 || light.x < -1;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 p = glm::mix(box.low, box.high, glm::bvec3(corner & 1, corner & 2, corner & 4));
            const glm::vec4 clip = view.projection * view.view * glm::vec4(p, 1);
            CHECK((std::isfinite(clip.x) && std::isfinite(clip.y) && std::isfinite(clip.z)));
            if (outside)
                CHECK((std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w && std::abs(clip.z) < clip.w));
        }
        CHECK(view.ahead > 0);
        CHECK(view.ahead < 0.03f);
    }
}
