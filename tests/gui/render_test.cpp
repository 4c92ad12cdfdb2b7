// The pictures that the renderer draws, judged by claims about their pixels and by what it says that it drew.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <catch2/catch_approx.hpp>

#include "gui/render_fixture.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Approx;

namespace {

double srgb(double linear) {
    return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

} // namespace

TEST_CASE("A cloth seen from above covers the pixels where it is projected", "[render]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(10, 12);
    const render::Image empty = studio.draw(empty_scene());
    const render::Image image = studio.draw(scene_of(cloth));
    // 1 m at 2 m distance, of the 2 * 2 m * tan(20°) that the height shows.
    const double side = 90 / (4 * std::tan(20 * M_PI / 180));
    CHECK(count_differences(image, empty) == Approx(side * side).epsilon(0.06));
    for (int y = 0; y < 90; ++y) {
        for (int x = 0; x < 160; ++x) {
            const double out = std::max(std::abs(x + 0.5 - 80), std::abs(y + 0.5 - 45)) - side / 2;
            if (std::abs(out) > 1)
                REQUIRE(differs(image, empty, x, y) == (out < 0));
        }
    }
    CHECK(studio.report.cloth_triangles == 2 * 9 * 11);
    CHECK(studio.report.points_in_view == 120);
    CHECK(studio.report.points_not_drawable == 0);
    CHECK(studio.report.cloth_box.width() == Approx(side).margin(1.5));
    CHECK(studio.report.cloth_box.height() == Approx(side).margin(1.5));
    CHECK((studio.report.width == 160 && studio.report.height == 90));
}

TEST_CASE("Both sides of the cloth are lit, each in its colour", "[render]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(10, 10);
    const render::Image above = studio.draw(scene_of(cloth, 2)), below = studio.draw(scene_of(cloth, -2));
    const std::uint8_t *front = above.pixel(80, 45), *back = below.pixel(80, 45);
    const double background = brightness(above.pixel(2, 45));
    CHECK(brightness(front) > background + 50);
    CHECK(brightness(back) > background + 30);
    CHECK(front[0] > front[2] + 50);
    CHECK(back[2] > back[0]);

    render::Scene swapped = scene_of(cloth, -2);
    swapped.options.swap_sides = true;
    const render::Image warm = studio.draw(swapped);
    CHECK(warm.pixel(80, 45)[0] > warm.pixel(80, 45)[2] + 30);
}

TEST_CASE("Light is computed in linear values and written as sRGB", "[render]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(3, 3);
    render::Scene scene = scene_of(cloth);
    scene.options.fill = 0;
    scene.options.surface = shader_of("diffuse", {{"front_colour", "#FFFFFF"}});
    scene.options.lights = {};
    SECTION("ambient light of 1 shows the colour itself") {
        scene.options.ambient = 1;
        scene.options.surface = shader_of("diffuse", {{"front_colour", "#8040C0"}});
        const render::Image image = studio.draw(scene);
        CHECK(image.pixel(80, 45)[0] == Approx(0x80).margin(1));
        CHECK(image.pixel(80, 45)[1] == Approx(0x40).margin(1));
        CHECK(image.pixel(80, 45)[2] == Approx(0xC0).margin(1));
    }
    SECTION("a point light falls off with the square of its distance") {
        scene.options.ambient = 0;
        scene.options.lights[0].intensity = 0.5f;
        for (const double height : {1.0, 2.0, 4.0}) {
            scene.options.lights[0].position = {0, static_cast<float>(height), 0};
            const render::Image image = studio.draw(scene);
            CHECK(image.pixel(80, 45)[1] == Approx(srgb(0.5 / (height * height))).margin(2));
        }
    }
}

TEST_CASE("Switching a spring kind off removes its lines and nothing else", "[render]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(6, 6);
    render::Scene scene = scene_of(cloth);
    scene.options.surface = shader_of("wireframe");
    scene.options.line_width = 2.5f;
    const render::Image all = studio.draw(scene);
    const render::DrawReport full = studio.report;
    CHECK(full.cloth_triangles == 0);
    CHECK(full.springs == std::array<std::size_t, 3>{60, 50, 48});
    scene.options.show_springs = {};
    const render::Image none = studio.draw(scene);

    for (std::size_t kind = 0; kind < 3; ++kind) {
        INFO("spring kind " << kind);
        scene.options.show_springs = {};
        scene.options.show_springs[kind] = true;
        const render::Image alone = studio.draw(scene);
        CHECK(studio.report.springs[kind] == full.springs[kind]);
        scene.options.show_springs = {true, true, true};
        scene.options.show_springs[kind] = false;
        const render::Image without = studio.draw(scene);
        for (std::size_t other = 0; other < 3; ++other)
            CHECK(studio.report.springs[other] == (other == kind ? 0 : full.springs[other]));

        CHECK(count_differences(all, without) > 20);
        bool own_colour = false, elsewhere = false;
        for (int y = 0; y < 90; ++y) {
            for (int x = 0; x < 160; ++x) {
                elsewhere = elsewhere || (differs(all, without, x, y) && !differs(alone, none, x, y));
                double off = 0;
                for (int k = 0; k < 3; ++k)
                    off = std::max(off, std::abs(alone.pixel(x, y)[k] - 255.0 * render::spring_colours[kind][k]));
                own_colour = own_colour || off <= 2;
            }
        }
        CHECK_FALSE(elsewhere);
        CHECK(own_colour);
    }
}

TEST_CASE("Springs are drawn over a shaded surface when asked for", "[render]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(6, 6);
    render::Scene scene = scene_of(cloth);
    const render::Image plain = studio.draw(scene);
    CHECK(studio.report.springs == std::array<std::size_t, 3>{});
    scene.options.springs_over_surface = true;
    const render::Image both = studio.draw(scene);
    CHECK(studio.report.springs[0] == 60);
    CHECK(studio.report.cloth_triangles == 50);
    CHECK(count_differences(plain, both) > 500);
}

TEST_CASE("Pins and colliders are drawn where they have a meaning", "[render]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(5, 5);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<sim::Collider> colliders = {sim::Sphere{{0.8, 0, 0}, 0.2, 0}, sim::Sphere{{0, 0, 0}, nan, 0},
                                                  sim::Plane{{0, -0.5, 0}, {0, 2, 0}, 0},
                                                  sim::Plane{{0, 0, 0}, {0, 0, 0}, 0}};
    const std::vector<sim::GridPoint> pinned = {{0, 0}, {4, 4}, {5, 0}, {0, -1}};
    render::Scene scene = scene_of(cloth);
    const render::Image plain = studio.draw(scene);
    scene.colliders = colliders;
    scene.pinned = pinned;
    const render::Image image = studio.draw(scene);
    CHECK(studio.report.spheres == 1);
    CHECK(studio.report.planes == 1);
    CHECK(studio.report.pins == 2);
    const int x = studio.report.cloth_box.min_x, y = studio.report.cloth_box.min_y;
    CHECK(brightness(image.pixel(x, y)) > 230);
    CHECK(differs(image, plain, 2, 45));                                                // the plane
    CHECK(brightness(image.pixel(80 + 49, 45)) > brightness(image.pixel(155, 5)) + 40); // the sphere

    scene.options.show_colliders = scene.options.show_pins = false;
    CHECK(count_differences(studio.draw(scene), plain) == 0);
    CHECK(studio.report.spheres + studio.report.planes + studio.report.pins == 0);
}

TEST_CASE("Non-finite points leave a hole and raise no GL error", "[render]") {
    Studio studio;
    const sim::Snapshot good = flat_cloth(10, 10);
    const render::Image empty = studio.draw(empty_scene()), whole = studio.draw(scene_of(good));
    sim::Snapshot bad = good;
    const float values[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e30f};
    bad.positions[3 * 0] = values[0];
    bad.positions[3 * 9 + 1] = values[1];
    bad.positions[3 * 99 + 2] = values[2];
    const render::Image holes = studio.draw(scene_of(bad));
    CHECK(studio.report.points_not_drawable == 3);
    CHECK(studio.report.cloth_triangles == 162 - 4); // 1, 2 and 1 at these corners
    CHECK(count_differences(holes, whole) > 0);
    CHECK_FALSE(differs(holes, whole, 80, 45));

    for (std::size_t i = 0; i < bad.positions.size(); ++i)
        bad.positions[i] = values[i % 3];
    for (const char* shader : {"diffuse", "wireframe"}) {
        render::Scene scene = scene_of(bad);
        scene.options.surface = shader_of(shader);
        CHECK(count_differences(studio.draw(scene), empty) == 0);
        CHECK(studio.report.cloth_triangles + studio.report.springs[0] + studio.report.points_in_view == 0);
        CHECK(studio.report.cloth_box.empty());
    }
    CHECK(count_differences(studio.draw(scene_of(good)), whole) == 0);
}

TEST_CASE("Any grid and any size of picture draws", "[render]") {
    Studio studio;
    const std::vector<sim::Collider> colliders = {sim::Sphere{{0, 0, 0}, 0.3, 0}, sim::Plane{}};
    for (const auto& [columns, rows] : {std::pair{2, 2}, {2, 40}, {40, 2}, {7, 5}}) {
        const sim::Snapshot cloth = flat_cloth(columns, rows);
        for (const auto& [width, height] : {std::pair{1, 1}, {0, -3}, {1, 300}, {160, 90}}) {
            studio.target.resize(width, height);
            for (const char* shader : {"diffuse", "wireframe"}) {
                render::Scene scene = scene_of(cloth);
                scene.colliders = colliders;
                scene.options.surface = shader_of(shader);
                scene.options.surface.sphere_lat_lines = columns - 10;
                const render::Image image = studio.draw(scene);
                CHECK((image.width == std::max(1, width) && image.height == std::max(1, height)));
                CHECK((studio.report.width == image.width && studio.report.height == image.height));
            }
        }
    }
    sim::Snapshot nothing;
    CHECK(brightness(studio.draw(scene_of(nothing)).pixel(0, 0)) > 10);
    nothing.columns = nothing.rows = 3; // without the positions
    CHECK(studio.draw(scene_of(nothing)).width == 160);
    CHECK(studio.report.cloth_triangles == 0);
}

TEST_CASE("A view from inside the cloth draws", "[render]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(20, 20);
    render::Scene scene = scene_of(cloth);
    scene.view.eye = {0.01f, 0.001f, 0.01f};
    scene.view.target = {0.3f, 0, 0.2f};
    scene.view.up = {0, 1, 0};
    for (const char* shader : {"diffuse", "wireframe"}) {
        scene.options.surface = shader_of(shader);
        studio.draw(scene);
        CHECK(studio.report.points_in_view > 0);
        CHECK(studio.report.points_in_view < 400);
    }
    scene.view.target = scene.view.eye;
    studio.draw(scene);
}

TEST_CASE("Drawing leaves OpenGL as it found it", "[render]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(4, 4);
    render::Target other(8, 8);
    const GLuint texture = studio.target.texture();
    studio.draw(scene_of(cloth));
    GLint bound = -1;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    CHECK(bound == 0);
    for (const GLenum state : {GL_FRAMEBUFFER_SRGB, GL_DEPTH_TEST, GL_BLEND, GL_SCISSOR_TEST, GL_PROGRAM_POINT_SIZE})
        CHECK(glIsEnabled(state) == GL_FALSE);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 1, 1);
    studio.target.resize(200, 100);
    CHECK(studio.target.texture() == texture);
    CHECK(studio.draw(scene_of(cloth)) == studio.draw(scene_of(cloth)));
    CHECK(studio.report.points_in_view == 16);
}
