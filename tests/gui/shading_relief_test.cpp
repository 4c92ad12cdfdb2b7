// Height maps: bump, displacement, and pictures on cloth.
#include "gui/shading.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// A folder of shaders with one more: the heights of the points that a shader's vertex stage moves, as colour.
void add_height_shader(const std::filesystem::path& folder, const std::string& of) {
    std::filesystem::copy(shader_folder, folder, std::filesystem::copy_options::recursive);
    std::filesystem::copy(folder / "cloth" / (of + ".vert"), folder / "cloth" / "heights.vert");
    write_file(folder / "cloth" / "heights.frag",
               "#version 330 core\nin vec3 world_position;\nout vec4 pixel;\n"
               "void main() { pixel = vec4(4.0 * world_position.y, -4.0 * world_position.y, 0.0, 1.0); }\n");
}

/// Grey from left to right, or from below: `step` of 255 more a pixel.
std::string slope(const std::filesystem::path& file, int size, int step, bool upwards = false) {
    return write_picture(file, size, size, [=](int x, int y) { return step * (upwards ? size - 1 - y : x); });
}

constexpr std::array<std::array<int, 2>, 3> pixels = {{{80, 45}, {71, 40}, {88, 55}}};

} // namespace

TEST_CASE("Displaced points are as high as the map says, times k_h, to the front", "[shading]") {
    Studio studio;
    const TemporaryFolder folder;
    add_height_shader(folder / "shaders", "displacement");
    studio.renderer = render::Renderer(folder / "shaders");
    const sim::Snapshot cloth = flat_cloth(33, 33);
    const std::string map = slope(folder / "slope.png", 64, 4);
    for (const float side : {1.f, -1.f}) { // the front above and below
        render::Scene scene = scene_of(cloth, 2 * side);
        scene.options.swap_sides = side < 0;
        scene.options.surface =
            shader_of("displacement", {{"height_map", map}, {"k_h", 0.2}, {"repeat_u", 1.0}, {"repeat_v", 1.0}});
        scene.options.surface.shader = "heights";
        const render::Image image = studio.draw(scene);
        for (const int x : {65, 80, 93}) {
            // Where a pixel looks depends a little on the height itself.
            float height = 0;
            for (int i = 0; i < 20; ++i) {
                const float u = seen_at(scene.view, image, x, 45, height).x + 0.5f;
                height = side * 0.2f * 4 / 255 * (64 * u - 0.5f);
            }
            INFO("pixel " << x << ", height " << height);
            CHECK(std::abs(image.pixel(x, 45)[side > 0 ? 0 : 1] - srgb_of(4 * std::abs(height))) <= 1);
            CHECK(image.pixel(x, 45)[side > 0 ? 1 : 0] == 0);
        }
    }
}

TEST_CASE("A cloth raised towards the eye is seen as large as it then is", "[shading]") {
    Studio studio;
    studio.target.resize(800, 450);
    const TemporaryFolder folder;
    const sim::Snapshot cloth = flat_cloth(4, 4);
    for (const int grey : {0, 102, 255}) {
        render::Scene scene = scene_of(cloth);
        scene.options.background_top = scene.options.background_bottom = glm::vec3(0);
        scene.options.surface = shader_of(
            "displacement",
            {{"height_map", write_picture(folder / std::to_string(grey), 4, 4, [=](int, int) { return grey; })},
             {"k_h", 0.4}});
        const render::Image image = studio.draw(scene);
        int width = 0;
        for (int x = 0; x < 800; ++x)
            width += image.pixel(x, 225)[0] > 40 ? 1 : 0;
        const double scale = 450 / (2 * std::tan(20 * 3.14159265 / 180));
        CHECK(std::abs(width - scale / (2 - 0.4 * grey / 255)) <= 2);
    }
}

TEST_CASE("A flat height map leaves the normals alone", "[shading]") {
    Studio studio;
    const TemporaryFolder folder;
    const sim::Snapshot cloth = flat_cloth(4, 4);
    const std::string flat = write_picture(folder / "flat.png", 4, 4, [](int, int) { return 200; });
    render::Scene scene = scene_of(cloth);
    set_two_lamps(scene.options);
    scene.options.surface = shader_of("blinn-phong");
    const render::Image plain = studio.draw(scene);
    scene.options.surface = shader_of("bump", {{"height_map", flat}, {"k_h", 0.1}, {"k_n", 1000.0}});
    CHECK(count_differences(studio.draw(scene), plain) == 0);
    scene.options.surface = shader_of("displacement", {{"height_map", flat}, {"k_h", 0.0}, {"k_n", 1000.0}});
    CHECK(count_differences(studio.draw(scene), plain) == 0);
}

TEST_CASE("Bump tilts normals by the course's formula, along u and v, on both sides", "[shading]") {
    Studio studio;
    const TemporaryFolder folder;
    const sim::Snapshot cloth = flat_cloth(4, 4);
    const float k_h = 0.05f, k_n = 400;
    struct Case {
        int size, step;
        bool along_v;
        float repeat;
    };
    // The same slope in texture coordinates, in a map of half the size: twice the change from pixel to pixel.
    for (const auto& [size, step, along_v, repeat] :
         {Case{64, 4, false, 1}, Case{32, 8, false, 1}, Case{64, 4, true, 1}, Case{64, 4, false, 0.5f}})
        for (const float side : {1.f, -1.f})
            for (const bool swapped : {false, true}) {
                INFO(size << " px, along v " << along_v << ", side " << side << ", swapped " << swapped);
                render::Scene scene = scene_of(cloth, 2 * side);
                set_two_lamps(scene.options);
                for (render::Light& lamp : scene.options.lights)
                    lamp.position.y *= side;
                scene.options.swap_sides = swapped;
                const std::string map =
                    slope(folder / (std::to_string(size) + std::to_string(along_v) + ".png"), size, step, along_v);
                scene.options.surface = shader_of("bump", {{"height_map", map},
                                                           {"k_h", k_h},
                                                           {"k_n", k_n},
                                                           {"repeat_u", repeat},
                                                           {"repeat_v", repeat},
                                                           {"front_colour", "#C0C0C0"},
                                                           {"back_colour", "#C0C0C0"},
                                                           {"ks", 0.5},
                                                           {"p", 10.0}});
                const render::Image image = studio.draw(scene);
                // The front's own axes: u is x; a picture is upright on the front, so v is up (-z) on the upper side.
                const glm::vec3 n_front(0, swapped ? -1 : 1, 0),
                    along = along_v ? glm::cross(n_front, {1, 0, 0}) : glm::vec3(1, 0, 0);
                const float tilt = static_cast<float>(step) / 255 * k_h * k_n;
                const glm::vec3 n = glm::normalize(n_front - tilt * along) * (n_front.y == side ? 1.f : -1.f);
                for (const auto& [x, y] : pixels) {
                    const glm::vec3 at = seen_at(scene.view, image, x, y, 0);
                    const Lighting light{scene.options, scene.view.eye, at, n};
                    const glm::vec3 base = render::linear(render::colour(0xC0C0C0));
                    check_pixel(image, x, y, base * light.diffuse() + glm::vec3(0.5f * light.specular(10)), 1.5);
                }
            }
}

TEST_CASE("A picture is upright on the front, whichever side that is, and repeats", "[shading]") {
    Studio studio;
    const TemporaryFolder folder;
    const sim::Snapshot cloth = flat_cloth(4, 4);
    // Four colours, of 8 x 8 pixels each, so that their middles are not mixed.
    const std::array<glm::ivec3, 4> colours = {{{200, 30, 30}, {30, 200, 30}, {30, 30, 200}, {180, 180, 40}}};
    const auto quarter = [&](int x, int y) { return static_cast<std::size_t>((x < 8 ? 0 : 1) + (y < 8 ? 0 : 2)); };
    const std::string picture =
        write_picture(folder / "four.png", 16, 16, [&](int x, int y) { return colours[quarter(x, y)]; });
    // What a beholder of the front sees from left to right and from the top.
    const auto check = [&](const render::Image& image, bool mirrored) {
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 2; ++x) {
                const glm::ivec3 expected = colours[static_cast<std::size_t>((mirrored ? 1 - x : x) + 2 * y)];
                for (int k = 0; k < 3; ++k)
                    CHECK(std::abs(image.pixel(65 + 29 * x, 30 + 29 * y)[k] - expected[k]) <= 1);
            }
    };
    render::Scene scene = scene_of(cloth);
    scene.options.surface =
        shader_of("texture", {{"albedo", picture}, {"lit", false}, {"repeat_u", 1.0}, {"repeat_v", 1.0}});
    check(studio.draw(scene), false);
    scene = scene_of(cloth, -2);
    scene.options.surface =
        shader_of("texture", {{"albedo", picture}, {"lit", false}, {"repeat_u", 1.0}, {"repeat_v", 1.0}});
    scene.view.up = {0, 0, 1}; // as when one walks around it
    const render::Image from_behind = studio.draw(scene);
    for (int k = 0; k < 3; ++k) // columns run on, rows the other way
        CHECK(std::abs(from_behind.pixel(65, 59)[k] - colours[0][k]) <= 1);

    sim::Snapshot standing = cloth; // rows from below to above, as vertical cloth has them
    for (std::size_t i = 0; i < standing.positions.size(); i += 3) {
        standing.positions[i + 1] = standing.positions[i + 2];
        standing.positions[i + 2] = 0;
    }
    scene.snapshot = &standing;
    scene.view.eye = {0, 0, 2};
    scene.view.up = {0, 1, 0};
    scene.options.swap_sides = true;
    check(studio.draw(scene), false);
    scene.view.eye = {0, 0, -2};
    check(studio.draw(scene), true);

    scene.view.eye = {0, 0, 2};
    scene.options.surface =
        shader_of("texture", {{"albedo", picture}, {"lit", false}, {"repeat_u", 3.0}, {"repeat_v", 1.0}});
    const render::Image three = studio.draw(scene);
    int changes = 0;
    for (int x = 56; x < 103; ++x)
        changes +=
            (three.pixel(x, 30)[0] > three.pixel(x, 30)[1]) != (three.pixel(x + 1, 30)[0] > three.pixel(x + 1, 30)[1]);
    CHECK(changes == 5);
}
