// Lit planes against the formulas of light.
#include "gui/shading.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

constexpr glm::vec3 up{0, 1, 0};
/// The middle of a picture of 160 x 90, and pixels nearer to the cloth's corners.
constexpr std::array<std::array<int, 2>, 5> pixels = {{{80, 45}, {60, 30}, {102, 28}, {98, 62}, {58, 60}}};

glm::vec3 front() {
    return render::linear(render::colour(0xE0714F));
}

} // namespace

TEST_CASE("A lit plane's pixels equal the diffuse formula's, I / r² n·l for every lamp", "[shading]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(4, 4);
    render::Scene scene = scene_of(cloth);
    set_two_lamps(scene.options);
    const render::Image image = studio.draw(scene);
    for (const auto& [x, y] : pixels) {
        const glm::vec3 at = seen_at(scene.view, image, x, y, 0);
        check_pixel(image, x, y, front() * Lighting{scene.options, scene.view.eye, at, up}.diffuse());
    }
    CHECK(brightness(image.pixel(102, 28)) > brightness(image.pixel(58, 60)) + 15); // it is no plain colour
}

TEST_CASE("A lit plane's pixels equal Blinn-Phong's formula, each part alone and all together", "[shading]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(4, 4);
    render::Scene scene = scene_of(cloth);
    set_two_lamps(scene.options);
    scene.options.ambient = 0.3f;
    const float ka = 0.5f, kd = 0.75f, ks = 0.4f, p = 12;
    const glm::vec3 highlight = render::linear(render::colour(0x80C0FF));

    std::array<render::Image, 8> images; // by the parts that are on: 1 ambient, 2 diffuse, 4 specular
    for (std::size_t on = 0; on < images.size(); ++on) {
        scene.options.surface = shader_of("blinn-phong", {{"ka", ka},
                                                          {"kd", kd},
                                                          {"ks", ks},
                                                          {"p", p},
                                                          {"highlight", "#80C0FF"},
                                                          {"ambient_on", (on & 1u) != 0},
                                                          {"diffuse_on", (on & 2u) != 0},
                                                          {"specular_on", (on & 4u) != 0}});
        images[on] = studio.draw(scene);
    }
    for (const auto& [x, y] : pixels) {
        const glm::vec3 at = seen_at(scene.view, images[0], x, y, 0);
        const Lighting light{scene.options, scene.view.eye, at, up};
        const std::array<glm::vec3, 3> parts = {ka * 0.3f * front(), kd * light.diffuse() * front(),
                                                ks * light.specular(p) * highlight};
        for (std::size_t on = 0; on < images.size(); ++on) {
            INFO("parts " << on);
            glm::vec3 sum(0);
            for (std::size_t part = 0; part < 3; ++part)
                sum += (on >> part & 1u) != 0 ? parts[part] : glm::vec3(0);
            check_pixel(images[on], x, y, sum);
        }
        // What the pictures themselves hold: the parts' linear values add up to those of the whole, but for the
        // rounding of each to 8 bits.
        for (int k = 0; k < 3; ++k) {
            double sum = 0, rounding = 0;
            for (const std::size_t on : {1u, 2u, 4u, 7u}) {
                const int byte = images[on].pixel(x, y)[k];
                sum += (on == 7 ? -1 : 1) * linear_of(byte);
                rounding += 0.5 * (linear_of(byte + 1) - linear_of(byte)) + 1e-4;
            }
            CHECK(std::abs(sum) <= rounding);
        }
    }
}

TEST_CASE("Both sides are lit alike", "[shading]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(4, 4);
    const TemporaryFolder folder;
    const std::string flat = write_picture(folder / "flat.png", 2, 2, [](int, int) { return 90; });
    const scene::ShaderValues one_colour = {{"front_colour", "#C08040"}, {"back_colour", "#C08040"}};
    scene::ShaderValues relief = one_colour;
    relief["height_map"] = flat;
    relief["k_h"] = 0.0; // the front's side moves, which is not the same from both
    scene::ShaderValues layers = {{"height_map", flat}, {"through_map", flat}, {"k_h", 0.0}};
    for (const auto& [name, values] : std::map<std::string, scene::ShaderValues>{{"diffuse", one_colour},
                                                                                 {"blinn-phong", one_colour},
                                                                                 {"bump", relief},
                                                                                 {"displacement", relief},
                                                                                 {"toon", one_colour},
                                                                                 {"texture", {{"albedo", flat}}},
                                                                                 {"translucent", layers},
                                                                                 {"strain", {}}}) {
        INFO(name);
        std::array<render::Image, 2> images;
        for (const float side : {1.f, -1.f}) {
            render::Scene scene = scene_of(cloth, 2 * side);
            set_two_lamps(scene.options);
            for (render::Light& lamp : scene.options.lights)
                lamp.position.y *= side;
            scene.options.background_bottom = scene.options.background_top;
            scene.options.surface = shader_of(name, values);
            images[side > 0 ? 0 : 1] = studio.draw(scene);
        }
        int different = 0;
        for (int y = 0; y < 90; ++y)
            for (int x = 0; x < 160; ++x)
                for (int k = 0; k < 3; ++k)
                    different += std::abs(images[0].pixel(x, y)[k] - images[1].pixel(159 - x, y)[k]) > 2 ? 1 : 0;
        CHECK(different < 10); // a triangle's edge may fall on the other side of a sample
        CHECK(images[0].pixel(100, 40)[0] > images[0].pixel(62, 58)[0]);
    }
}

TEST_CASE("Normals are colours that can be read off the picture", "[shading]") {
    Studio studio;
    sim::Snapshot cloth = flat_cloth(3, 3);
    for (std::size_t i = 0; i < cloth.positions.size(); i += 3)
        cloth.positions[i + 1] = 0.75f * cloth.positions[i];
    const glm::vec3 normal = glm::normalize(glm::vec3(-0.75f, 1, 0));
    for (const float side : {1.f, -1.f})
        for (const bool faceted : {false, true})
            for (const bool from_camera : {false, true}) {
                render::Scene scene = scene_of(cloth, 2 * side);
                scene.options.surface = shader_of("normals", {{"faceted", faceted}, {"from_camera", from_camera}});
                glm::vec3 n = side * normal;
                if (from_camera)
                    n = glm::mat3(render::view_matrix(scene.view)) * n;
                const render::Image image = studio.draw(scene);
                for (int k = 0; k < 3; ++k)
                    CHECK(std::abs(image.pixel(80, 45)[k] - 255 * (n[k] + 1) / 2) <= 1);
            }
}
