// The ghost: another cloth over the picture, and the heat map of the distance to it.
#include <limits>

#include "app/ghost_view.h"
#include "gui/render_fixture.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// A flat cloth of 1 m x 1 m, moved.
sim::Snapshot flat_cloth_at(glm::vec3 by, int columns = 8, int rows = 8) {
    sim::Snapshot s = flat_cloth(columns, rows);
    for (std::size_t i = 0; i < s.positions.size(); ++i)
        s.positions[i] += by[static_cast<int>(i % 3)];
    return s;
}

/// Shrunk around the origin, and moved.
sim::Snapshot small_cloth_at(glm::vec3 by, float size, int columns = 8, int rows = 8) {
    sim::Snapshot s = flat_cloth(columns, rows);
    for (std::size_t i = 0; i < s.positions.size(); ++i)
        s.positions[i] = size * s.positions[i] + by[static_cast<int>(i % 3)];
    return s;
}

struct Box {
    int min_x = 1 << 20, min_y = 1 << 20, max_x = -1, max_y = -1;
};

Box differences(const render::Image& a, const render::Image& b) {
    Box box;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            if (differs(a, b, x, y))
                box = {std::min(box.min_x, x), std::min(box.min_y, y), std::max(box.max_x, x), std::max(box.max_y, y)};
    return box;
}

/// Where a point on the plane y = 0 is in the Studio's picture, seen from 2 m above.
glm::vec2 pixel_of(float x, float z) {
    const float px_per_m = 90 / (2 * 2 * std::tan(glm::radians(20.f)));
    return {80 + px_per_m * x, 45 + px_per_m * z};
}

} // namespace

TEST_CASE("A ghost changes the picture where it is and nowhere else, whatever the cloth is drawn with", "[ghost]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(8, 8);
    const sim::Snapshot ghost = small_cloth_at({0.2f, 0.02f, 0.1f}, 0.3f, 5, 9);
    const glm::vec2 low = pixel_of(0.05f, -0.05f), high = pixel_of(0.35f, 0.25f);
    for (const char* shader : {"diffuse", "wireframe", "strain", "translucent", "distance"}) {
        INFO(shader);
        render::Scene scene = scene_of(cloth);
        scene.options.surface = shader_of(shader);
        scene.options.surface.lines = std::string(shader) == "wireframe";
        scene.options.surface.translucent = std::string(shader) == "translucent";
        const render::Image without = studio.draw(scene);
        const render::DrawReport report = studio.report;
        CHECK(report.ghost_triangles == 0);
        scene.ghost = &ghost;
        const render::Image with = studio.draw(scene);
        const Box box = differences(without, with);
        CHECK(std::abs(static_cast<float>(box.min_x) - low.x) < 2);
        CHECK(std::abs(static_cast<float>(box.min_y) - low.y) < 2);
        CHECK(std::abs(static_cast<float>(box.max_x) - high.x) < 2);
        CHECK(std::abs(static_cast<float>(box.max_y) - high.y) < 2);
        for (int y = box.min_y + 2; y < box.max_y - 2; ++y) // all of it
            for (int x = box.min_x + 2; x < box.max_x - 2; ++x)
                REQUIRE(differs(without, with, x, y));
        CHECK(studio.report.ghost_triangles == 2 * 4 * 8);
        CHECK(studio.report.cloth_triangles == report.cloth_triangles);
        CHECK(studio.report.springs == report.springs);
        CHECK(studio.report.points_in_view == report.points_in_view);
        CHECK(studio.report.line_width == report.line_width);
        scene.ghost = nullptr; // and it leaves nothing behind
        CHECK(count_differences(studio.draw(scene), without) == 0);
    }
}

TEST_CASE("A ghost in the cloth's own place is hidden by it, from either side", "[ghost]") {
    Studio studio;
    sim::Snapshot cloth = flat_cloth(12, 12);
    for (std::size_t i = 1; i < cloth.positions.size(); i += 3)
        cloth.positions[i] = 0.1f * std::sin(8 * cloth.positions[i - 1]);
    for (const float eye : {2.f, -2.f}) {
        render::Scene scene = scene_of(cloth, eye);
        scene.view.eye.x = 0.7f;
        const render::Image without = studio.draw(scene);
        scene.ghost = &cloth;
        const render::Image with = studio.draw(scene);
        CHECK(studio.report.ghost_triangles == 2 * 11 * 11);
        // But for some pixels at the outline, which the cloth does not cover wholly.
        CHECK(count_differences(without, with) < 20);
    }
}

TEST_CASE("What is in front of a ghost hides all of it but its outline", "[ghost]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(8, 8), ghost = small_cloth_at({0, -0.3f, 0}, 0.5f);
    render::Scene scene = scene_of(cloth);
    const render::Image without = studio.draw(scene);
    scene.ghost = &ghost;
    const render::Image behind = studio.draw(scene);
    CHECK_FALSE(differs(without, behind, 80, 45));
    CHECK(count_differences(without, behind) > 20);
    scene.view = vertical_view(-2); // from the other side it is in front
    const render::Image front = studio.draw(scene);
    scene.ghost = nullptr;
    CHECK(differs(studio.draw(scene), front, 80, 45));
}

TEST_CASE("A ghost is see-through, in the same way from both sides and in whatever order its triangles are",
          "[ghost]") {
    Studio studio;
    // Two layers, folded over: the nearer one counts, once.
    sim::Snapshot folded = flat_cloth(9, 9), single = folded;
    for (std::size_t i = 0; i < 81; ++i) {
        folded.positions[3 * i + 1] = folded.positions[3 * i] > 0 ? 0.02f : -0.02f;
        folded.positions[3 * i] = -std::abs(folded.positions[3 * i]);
    }
    const sim::Snapshot cloth = flat_cloth_at({0, -0.5f, 0});
    const auto at = [&](const sim::Snapshot* ghost, float eye, int x) {
        sim::Snapshot below = cloth;
        for (std::size_t i = 1; i < below.positions.size(); i += 3)
            below.positions[i] = eye > 0 ? -0.5f : 0.5f;
        render::Scene scene = scene_of(below, eye);
        scene.options.surface = shader_of("strain", {{"shading", 0.0}});
        scene.ghost = ghost;
        const render::Image image = studio.draw(scene);
        return brightness(image.pixel(x, 49));
    };
    for (const float eye : {2.f, -2.f}) {
        INFO(eye);
        const int within = eye > 0 ? 67 : 92; // where the layers are, off their lines
        const double without = at(nullptr, eye, within), once = at(&single, eye, within),
                     twice = at(&folded, eye, within);
        CHECK(std::abs(once - without) > 3);
        CHECK(std::abs(once - twice) < 8);
    }
    CHECK(std::abs(at(&single, 2, 67) - at(&single, -2, 67)) < 2);
}

TEST_CASE("Points of a ghost that are not finite are left out with what hangs on them", "[ghost]") {
    Studio studio;
    render::Scene scene = empty_scene();
    const render::Image empty = studio.draw(scene);
    sim::Snapshot ghost = flat_cloth(5, 5);
    ghost.positions[3 * 12] = std::numeric_limits<float>::quiet_NaN();
    ghost.positions[0] = std::numeric_limits<float>::infinity();
    scene.ghost = &ghost;
    const render::Image some = studio.draw(scene);
    CHECK(studio.report.ghost_not_drawable == 2);
    CHECK(studio.report.ghost_triangles < 32);
    CHECK(studio.report.ghost_triangles > 20);
    CHECK(studio.report.points_not_drawable == 0);
    CHECK_FALSE(differs(empty, some, 80, 45));
    CHECK(count_differences(empty, some) > 500);
    ghost.positions.assign(75, std::numeric_limits<float>::quiet_NaN());
    CHECK(count_differences(studio.draw(scene), empty) == 0);
    ghost.positions.clear(); // does not fill its grid
    CHECK(count_differences(studio.draw(scene), empty) == 0);
}

TEST_CASE("A ghost is on both sides of a split view", "[ghost]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(8, 8), ghost = flat_cloth_at({0, 0.1f, 0});
    render::Scene scene = scene_of(cloth);
    scene.right = shader_of("normals");
    const render::Image without = studio.draw(scene);
    scene.ghost = &ghost;
    const render::Image with = studio.draw(scene);
    CHECK(differs(without, with, 70, 45));
    CHECK(differs(without, with, 90, 45));
}

TEST_CASE("A ghost casts no shadow", "[ghost]") {
    Studio studio;
    render::Scene scene = empty_scene();
    const std::vector<sim::Collider> floor = {sim::Plane{{0, -0.5, 0}, {0, 1, 0}, 0}};
    scene.colliders = floor;
    scene.options.shadow = true;
    scene.options.lights[0] = {{0, 3, 0}, 9};
    const sim::Snapshot cloth = small_cloth_at({-0.5f, 0, 0}, 0.2f), ghost = small_cloth_at({0.5f, 0, 0}, 0.3f);
    scene.snapshot = &cloth;
    const render::Image without = studio.draw(scene);
    scene.ghost = &ghost;
    const Box box = differences(without, studio.draw(scene));
    CHECK(static_cast<float>(box.min_x) > pixel_of(0.34f, 0).x - 2); // its shadow would begin further to the left
    CHECK(static_cast<float>(box.max_x) < pixel_of(0.66f, 0).x + 2);
}

TEST_CASE("The distance to a ghost is in the snapshot that is drawn, and coloured as the map says", "[ghost]") {
    auto cloth = std::make_shared<sim::Snapshot>(flat_cloth(8, 8));
    cloth->capture = 12345;
    cloth->quantity_kind = sim::PointQuantity::distance;
    cloth->quantity.assign(64, 0.f);
    const auto colour_at = [](const sim::Snapshot& snapshot) {
        Studio studio;
        render::Scene scene = scene_of(snapshot);
        scene.options.surface = shader_of("distance", {{"shading", 0.0}, {"low", 0.0}, {"high", 200.0}});
        const render::Image image = studio.draw(scene);
        const std::uint8_t* p = image.pixel(83, 42);
        return glm::ivec3(p[0], p[1], p[2]);
    };
    const auto ramp_at = [&](float share) {
        sim::Snapshot plain = *cloth;
        plain.quantity.assign(64, 0.2f * share);
        return colour_at(plain);
    };
    const sim::Snapshot ghost = flat_cloth_at({0.06f, 0.08f, 0});
    const app::GhostView view = app::compare_with_ghost(cloth, &ghost);
    REQUIRE(view.distance);
    CHECK(std::abs(view.distance->rms - 0.1) < 1e-7);
    CHECK(std::abs(view.distance->max - 0.1) < 1e-7);
    REQUIRE(view.snapshot != cloth);
    CHECK(view.snapshot->capture == 0); // or a mesh that has the cloth already would not look at it
    REQUIRE(view.snapshot->quantity.size() == 64);
    for (const float d : view.snapshot->quantity)
        CHECK(std::abs(d - 0.1f) < 1e-6f);
    CHECK(colour_at(*view.snapshot) == ramp_at(0.5f));
    CHECK(colour_at(*view.snapshot) != ramp_at(0.25f));
    CHECK(colour_at(*cloth) == ramp_at(0));
}

TEST_CASE("Comparing with a ghost copies nothing unless distances are drawn", "[ghost]") {
    auto cloth = std::make_shared<sim::Snapshot>(flat_cloth(4, 4));
    const sim::Snapshot ghost = flat_cloth_at({0, 0.5f, 0}, 4, 4), finer = flat_cloth(5, 4);
    cloth->quantity_kind = sim::PointQuantity::strain;
    cloth->quantity.assign(16, 0.02f);
    CHECK(app::compare_with_ghost(cloth, &ghost).snapshot == cloth);
    CHECK(app::compare_with_ghost(cloth, &ghost).distance->max == 0.5);
    cloth->second_quantity_kind = sim::PointQuantity::distance;
    const app::GhostView both = app::compare_with_ghost(cloth, &ghost);
    CHECK(both.snapshot->quantity == cloth->quantity);
    CHECK(both.snapshot->second_quantity == std::vector<float>(16, 0.5f));
    CHECK(app::compare_with_ghost(cloth, &finer).snapshot == cloth);
    CHECK_FALSE(app::compare_with_ghost(cloth, &finer).distance);
    CHECK(app::compare_with_ghost(cloth, nullptr).snapshot == cloth);
    CHECK_FALSE(app::compare_with_ghost(cloth, nullptr).distance);
    CHECK_FALSE(app::compare_with_ghost(nullptr, &ghost).snapshot);
}
