// Arrows and the marker in the picture.
#include <limits>

#include "gui/render_fixture.h"

namespace clothlab::test {
namespace {

constexpr glm::vec3 green{0, 1, 0};

/// How many pixels are green, and how green the greenest is.
struct Green {
    int pixels = 0, most = 0;
};
Green green_in(const render::Image& image) {
    Green found;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const std::uint8_t* p = image.pixel(x, y);
            const int more = p[1] - std::max(p[0], p[2]);
            found.pixels += more > 40 ? 1 : 0;
            found.most = std::max(found.most, more);
        }
    return found;
}

/// In a picture from 2 m above, with nothing else in it.
Green drawn(Studio& studio, const std::vector<render::Arrow>& arrows) {
    render::Scene scene = empty_scene();
    scene.arrows = arrows;
    return green_in(studio.draw(scene));
}

} // namespace

TEST_CASE("An arrow is drawn from its tail to its tip, with a head that is wider than the shaft") {
    Studio studio;
    render::Scene scene = empty_scene();
    const render::Image without = studio.draw(scene);
    CHECK(studio.report.arrows == 0);
    const std::vector<render::Arrow> arrows{{{-0.5f, 0, 0}, {0.5f, 0, 0}, green}};
    scene.arrows = arrows;
    const render::Image image = studio.draw(scene);
    CHECK(studio.report.arrows == 1);
    // 90 px are 2 tan(20 degrees) 2 m.
    const double px = 90 / 1.4559;
    int left = image.width, right = 0;
    std::array<int, 160> height{};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (differs(image, without, x, y)) {
                left = std::min(left, x);
                right = std::max(right, x);
                ++height[static_cast<std::size_t>(x)];
                CHECK(std::abs(y - 45) < 9);
            }
    CHECK(std::abs(left - (80 - 0.5 * px)) < 3);
    CHECK(std::abs(right - (80 + 0.5 * px)) < 4);
    CHECK(height[80] >= 2);
    CHECK(height[static_cast<std::size_t>(right) - 9] > height[80] + 2);
}

TEST_CASE("An arrow is as wide far away as near, and its head no longer than itself") {
    Studio studio;
    std::array<int, 2> pixels{};
    for (std::size_t i = 0; i < 2; ++i) {
        const float x = i == 0 ? 0.1f : 1, y = i == 0 ? 1.8f : 0; // 0.2 m and 2 m away, equally long in the picture
        pixels[i] = drawn(studio, {{{-0.5f * x, y, 0}, {0.5f * x, y, 0}, green}}).pixels;
    }
    CHECK(pixels[0] > 100);
    CHECK(std::abs(pixels[0] - pixels[1]) < 10);
    const int small = drawn(studio, {{{0, 0, 0}, {0.04f, 0, 0}, green}}).pixels; // 2.5 px
    CHECK(small > 0);
    CHECK(small < 10);
}

TEST_CASE("Arrows without a length, with ends that are no numbers, or behind the eye leave no trace") {
    Studio studio;
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const render::Image without = studio.draw(empty_scene());
    const std::vector<render::Arrow> arrows{{{0, 0, 0}, {0, 0, 0}, green},
                                            {{0, 0, 0}, {nan, 0, 0}, green},
                                            {{inf, 0, 0}, {0, 0, 0}, green},
                                            {{0, 0, 0}, {0, 1e30f, 0}, green}};
    render::Scene scene = empty_scene();
    scene.arrows = arrows;
    CHECK(studio.draw(scene).rgba == without.rgba);
    CHECK(studio.report.arrows == 0);
    const std::vector<render::Arrow> behind{{{0, 3, 0}, {0.3f, 4, 0}, green}};
    scene.arrows = behind;
    CHECK(studio.draw(scene).rgba == without.rgba);
    // One that begins in front of the eye and ends behind it leaves the picture on its own side.
    const std::vector<render::Arrow> passing{{{0.2f, 0, 0.2f}, {0.1f, 3, 0.1f}, green}};
    scene.arrows = passing;
    const render::Image passed = studio.draw(scene);
    int own_side = 0, other_side = 0, at_the_edge = 0;
    for (int y = 0; y < passed.height; ++y)
        for (int x = 0; x < passed.width; ++x)
            (x > 80 && y > 45 ? own_side : other_side) += differs(passed, without, x, y) ? 1 : 0;
    for (int x = 80; x < passed.width; ++x)
        at_the_edge += differs(passed, without, x, passed.height - 1) ? 1 : 0;
    CHECK(own_side > 20);
    CHECK(at_the_edge > 0);
    CHECK(other_side == 0);
    // One that comes straight to the eye is a head.
    CHECK(drawn(studio, {{{0, 0, 0}, {0, 0.5f, 0}, green}}).pixels > 0);
}

TEST_CASE("What lies in front of an arrow leaves it faint, and a marker is in front of everything") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(8, 8);
    render::Scene scene = scene_of(cloth);
    const auto at_height = [&](float y) {
        const std::vector<render::Arrow> arrows{{{-0.3f, y, 0}, {0.3f, y, 0}, green}};
        scene.arrows = arrows;
        const render::Image image = studio.draw(scene);
        scene.arrows = {};
        return green_in(image);
    };
    const Green above = at_height(0.1f), in_it = at_height(0), below = at_height(-0.1f);
    CHECK(above.pixels > 60);
    CHECK(std::abs(in_it.pixels - above.pixels) < 15); // one that lies in the cloth is seen
    CHECK(above.most > 150);
    CHECK(below.most < above.most / 2);

    const render::Image without = studio.draw(scene);
    CHECK(count_differences(studio.draw(scene), without) == 0);
    scene.marker = glm::vec3(0, -0.1f, 0);
    const render::Image marked = studio.draw(scene);
    CHECK(count_differences(marked, without) > 60);
    CHECK(differs(marked, without, 80, 45));
}

TEST_CASE("A hundred by four hundred arrows are drawn") {
    Studio studio;
    std::vector<render::Arrow> arrows;
    for (int i = 0; i < 40000; ++i) {
        const float x = static_cast<float>(i % 400) / 200 - 1, z = static_cast<float>(i / 400) / 100 - 0.5f;
        arrows.push_back({{x, 0, z}, {x + 0.01f, 0.01f, z}, green});
    }
    CHECK(drawn(studio, arrows).pixels > 5000);
    CHECK(studio.report.arrows == 40000);
}

TEST_CASE("Both parts of a split view have the arrows") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(8, 8);
    render::Scene scene = scene_of(cloth);
    scene.right = shader_of("normals");
    const render::Image without = studio.draw(scene);
    const std::vector<render::Arrow> arrows{{{-0.4f, 0.1f, 0}, {0.4f, 0.1f, 0}, green}};
    scene.arrows = arrows;
    const render::Image image = studio.draw(scene);
    CHECK(differs(image, without, 70, 45));
    CHECK(differs(image, without, 90, 45));
}

} // namespace clothlab::test
