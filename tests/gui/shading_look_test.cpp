// Mirror, toon, translucent cloth and heat maps against what their formulas give.
#include <algorithm>
#include <map>

#include "gui/shading.h"
#include "render/procedural.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// A built-in ramp's colour at x from 0 to 1, linear.
glm::vec3 ramp_at(const char* name, double x) {
    const render::Image image = std::get<render::Image (*)()>(render::find_built_in(name)->make)();
    const double at = std::clamp(x, 0.0, 1.0) * (image.width - 1);
    const int left = static_cast<int>(at), right = std::min(left + 1, image.width - 1);
    glm::vec3 colour;
    for (int k = 0; k < 3; ++k)
        colour[k] = static_cast<float>(
            std::lerp(linear_of(image.pixel(left, 0)[k]), linear_of(image.pixel(right, 0)[k]), at - left));
    return colour;
}

/// y = slope_x x + slope_z z.
sim::Snapshot tilted_cloth(float slope_x, float slope_z) {
    sim::Snapshot cloth = flat_cloth(3, 3);
    for (std::size_t i = 0; i < cloth.positions.size(); i += 3)
        cloth.positions[i + 1] = slope_x * cloth.positions[i] + slope_z * cloth.positions[i + 2];
    return cloth;
}

} // namespace

TEST_CASE("A mirror shows the side of the surroundings that the eye's ray leaves to", "[shading]") {
    Studio studio;
    struct Case {
        float eye_height, slope_x, slope_z;
        glm::ivec3 colour;
    };
    // Looked at straight down, cloth that rises by 45 degrees mirrors what lies on its lower side.
    for (const auto& [eye_height, slope_x, slope_z, colour] :
         {Case{2, -1, 0, {255, 0, 0}}, Case{2, 1, 0, {0, 255, 255}}, Case{2, 0, 0, {0, 255, 0}},
          Case{-2, 0, 0, {255, 0, 255}}, Case{2, 0, -1, {0, 0, 255}}, Case{2, 0, 1, {255, 255, 0}},
          Case{-2, 1, 0, {255, 0, 0}}}) {
        const sim::Snapshot cloth = tilted_cloth(slope_x, slope_z);
        render::Scene scene = scene_of(cloth, eye_height);
        scene.options.surface = shader_of("mirror", {{"environment", "six-colours"}});
        const render::Image image = studio.draw(scene);
        INFO("eye " << eye_height << ", slopes " << slope_x << ", " << slope_z);
        for (int k = 0; k < 3; ++k)
            CHECK(std::abs(image.pixel(80, 45)[k] - colour[k]) <= 1);
    }
}

TEST_CASE("A toon's light has as many bands as asked for, in the ramp's colours", "[shading]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(4, 4);
    render::Scene scene = scene_of(cloth);
    scene.options.lights = {render::Light{{0.45f, 0.2f, 0}, 0.07f}, render::Light{}}; // over the edge on the right
    const glm::vec3 light = render::linear(render::colour(0xE0714F)),
                    dark = light * render::linear(render::colour(0x6A4C86));
    for (const int bands : {2, 3, 6}) {
        INFO(bands << " bands");
        scene.options.surface = shader_of("toon", {{"ramp", "cividis"},
                                                   {"bands", double{static_cast<double>(bands)}},
                                                   {"full_light", 1.0},
                                                   {"ks", 0.0},
                                                   {"outline", 0.0}});
        const render::Image image = studio.draw(scene);
        std::map<std::array<int, 3>, int> count;
        for (int x = 54; x < 106; ++x)
            for (int y = 20; y < 70; ++y)
                ++count[{image.pixel(x, y)[0], image.pixel(x, y)[1], image.pixel(x, y)[2]}];
        std::erase_if(count, [](const auto& entry) { return entry.second < 20; }); // edges between bands
        REQUIRE(count.size() == static_cast<std::size_t>(bands));
        int band = 0; // red rises from band to band
        for (const auto& [colour, pixels] : count) {
            const double level =
                glm::dot(ramp_at("cividis", (band++ + 0.5) / bands), glm::vec3(0.2126f, 0.7152f, 0.0722f));
            for (int k = 0; k < 3; ++k)
                CHECK(std::abs(colour[static_cast<std::size_t>(k)] -
                               srgb_of(std::lerp(double{dark[k]}, double{light[k]}, level))) <= 1.5);
        }
    }
}

TEST_CASE("Layers of translucent cloth are blended from back to front, seen from both sides", "[shading]") {
    Studio studio;
    // Folded once, so that half of it lies 0.2 m above the other.
    sim::Snapshot cloth;
    cloth.columns = 2;
    cloth.rows = 6;
    for (const glm::vec2& yz : {glm::vec2(0, -0.5f), {0, 0}, {0, 0.5f}, {0.2f, 0.5f}, {0.2f, 0}, {0.2f, -0.5f}})
        for (const float x : {-0.5f, 0.5f})
            cloth.positions.insert(cloth.positions.end(), {x, yz.x, yz.y});
    const glm::vec3 tint = render::linear(render::colour(0x5CC2B0));
    const float opacity = 0.6f;
    for (const float side : {1.f, -1.f}) {
        INFO("eye at " << 2 * side);
        render::Scene scene = scene_of(cloth, 2 * side);
        scene.options.background_top = scene.options.background_bottom = render::colour(0x804020);
        scene.options.lights = {render::Light{{0.1f, 0.7f, -0.2f}, 0.3f}, render::Light{}};
        scene.options.ambient = 0.1f;
        scene.options.surface =
            shader_of("translucent", {{"k_h", 0.0}, {"ks", 0.0}, {"through", 0.5}, {"opacity", opacity}});
        const render::Image image = studio.draw(scene);
        for (const auto& [x, y] : {std::array{80, 38}, {70, 35}, {90, 30}}) {
            glm::vec3 expected = render::linear(render::colour(0x804020));
            for (const float height : {side > 0 ? 0.f : 0.2f, side > 0 ? 0.2f : 0.f}) {
                const glm::vec3 at = seen_at(scene.view, image, x, y, height);
                const Lighting light{scene.options, scene.view.eye, at, {0, side, 0}};
                const glm::vec3 layer = tint * (0.1f + light.diffuse() + 0.5f * light.behind());
                expected = opacity * layer + (1 - opacity) * expected;
            }
            check_pixel(image, x, y, expected, 2); // each layer is rounded to 8 bits
            CHECK(image.pixel(x, y)[3] == 255);
        }
    }
}

TEST_CASE("A lamp with a shadow shines through translucent cloth, which does not shade itself", "[shading]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(4, 4);
    render::Scene scene = scene_of(cloth, -2);
    set_two_lamps(scene.options);
    scene.options.shadow = true;
    scene.options.surface = shader_of("translucent", {{"k_h", 0.0}, {"ks", 0.0}, {"through", 0.8}, {"opacity", 1.0}});
    const render::Image image = studio.draw(scene);
    const glm::vec3 at = seen_at(scene.view, image, 80, 45, 0), down(0, -1, 0);
    const float light = 0.8f * Lighting{scene.options, scene.view.eye, at, down}.behind();
    check_pixel(image, 80, 45, render::linear(render::colour(0x5CC2B0)) * light);
}

TEST_CASE("Translucent spheres show their far side and the plane behind", "[shading]") {
    Studio studio;
    const std::vector<sim::Collider> sphere = {sim::Sphere{{0, 0, 0}, 0.5, 0}};
    const std::vector<sim::Collider> both = {sim::Sphere{{0, 0, 0}, 0.5, 0}, sim::Plane{{0, -0.6, 0}, {0, 1, 0}, 0}};
    const glm::vec3 tint = render::linear(render::colour(0x5CC2B0));
    std::array<glm::vec3, 2> seen;
    for (const bool plane : {false, true}) {
        render::Scene scene = empty_scene();
        scene.options.spheres_like_cloth = true;
        scene.options.lights = {};
        scene.options.ambient = 0.25f;
        scene.options.background_top = scene.options.background_bottom = glm::vec3(0);
        scene.options.surface = shader_of("translucent", {{"k_h", 0.0}, {"ks", 0.0}, {"opacity", 0.5}});
        scene.colliders = sphere;
        if (plane)
            scene.colliders = both;
        const render::Image image = studio.draw(scene);
        CHECK(image.pixel(80, 45)[3] == 255);
        for (int k = 0; k < 3; ++k)
            seen[plane ? 1 : 0][k] = static_cast<float>(linear_of(image.pixel(80, 45)[k]));
        if (!plane)
            check_pixel(image, 80, 45, 0.75f * 0.25f * tint, 2);
    }
    CHECK(seen[1].x > seen[0].x + 0.002f);
}

TEST_CASE("A heat map's colour is the map's at the value, and that of the ends beyond them", "[shading]") {
    Studio studio;
    sim::Snapshot cloth = flat_cloth(4, 4);
    struct Case {
        const char* shader;
        const char* map;
        double unit, low, high; ///< one of the legend's units in SI, and the ends that are set
    };
    for (const Case& c :
         {Case{"strain", "blue-orange", 0.01, -10, 10}, Case{"speed", "viridis", 1, 0, 2},
          Case{"gap", "cividis", 0.001, 20, -5}, Case{"curvature", "viridis", 1, 0, 40},
          Case{"distance", "viridis", 0.001, 0, 50}, Case{"wireframe-strain", "blue-orange", 0.01, -10, 10}}) {
        render::Scene scene = scene_of(cloth);
        scene.options.line_width = 9;
        scene::ShaderValues values = {{"low", c.low}, {"high", c.high}, {"map", c.map}};
        if (c.shader != std::string("wireframe-strain"))
            values["shading"] = 0.0;
        scene.options.surface = shader_of(c.shader, values);
        for (const double x : {0.0, 0.2, 0.75, 1.0, -3.0, 4.0}) {
            INFO(c.shader << " at " << x);
            cloth.quantity.assign(16, static_cast<float>(c.unit * std::lerp(c.low, c.high, x)));
            const render::Image image = studio.draw(scene);
            check_pixel(image, 80, 45, ramp_at(c.map, x));
        }
    }
}

TEST_CASE("Shading of heat maps is the light's share in them", "[shading]") {
    Studio studio;
    sim::Snapshot cloth = flat_cloth(4, 4);
    cloth.quantity.assign(16, 0.05f);
    render::Scene scene = scene_of(cloth);
    set_two_lamps(scene.options);
    for (const float shading : {0.4f, 1.f}) {
        scene.options.surface = shader_of("strain", {{"shading", shading}});
        const render::Image image = studio.draw(scene);
        for (const auto& [x, y] : {std::array{80, 45}, {60, 60}}) {
            const glm::vec3 at = seen_at(scene.view, image, x, y, 0);
            const float light = std::min(1.f, Lighting{scene.options, scene.view.eye, at, {0, 1, 0}}.diffuse());
            check_pixel(image, x, y, glm::mix(1.f, light, shading) * ramp_at("blue-orange", 0.75));
        }
    }
}
