// The parts of the renderer that need no OpenGL: pictures and their comparison, views, normals.
#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch_approx.hpp>

#include "gui/render_fixture.h"
#include "render/cloth_normals.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Approx;

namespace {

render::Image plain(int width, int height, std::uint8_t value) {
    return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(4 * width * height), value)};
}

/// The message of what an action throws.
template <class Action>
std::string message_of(Action action) {
    try {
        action();
    } catch (const std::exception& error) {
        return error.what();
    }
    return {};
}

} // namespace

TEST_CASE("A PNG written and read back is the same", "[image]") {
    const TemporaryFolder folder;
    render::Image image = plain(37, 11, 0);
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        image.rgba[i] = static_cast<std::uint8_t>(i * 7919 >> 3);
    render::write_png(image, folder / "a.png");
    CHECK(render::read_png(folder / "a.png") == image);
}

TEST_CASE("A picture that cannot be written or read is named with the reason", "[image]") {
    const TemporaryFolder folder;
    const auto path = folder / "no" / "a.png";
    const std::string written = message_of([&] { render::write_png(plain(2, 2, 0), path); });
    CHECK(written.find(path.string()) != std::string::npos);
    CHECK(written.find("No such file") != std::string::npos);
    CHECK(message_of([&] { render::write_png({}, folder / "b.png"); }).find("empty") != std::string::npos);
    CHECK(message_of([&] { render::write_png(plain(2, 2, 0), folder.path()); }).find("irectory") != std::string::npos);
    write_file(folder / "c.png", "no picture");
    for (const auto& name : {folder / "c.png", folder / "d.png", folder.path()})
        CHECK(message_of([&] { render::read_png(name); }).find(name.string()) != std::string::npos);
}

TEST_CASE("The difference of pictures is 0 for the same, 1 for black and white, and small for a small change",
          "[image]") {
    render::Image half = plain(128, 72, 0);
    for (int y = 0; y < 72; ++y)
        for (int x = 64; x < 128; ++x)
            for (int k = 0; k < 3; ++k)
                half.rgba[static_cast<std::size_t>(4 * (y * 128 + x) + k)] = 255;
    CHECK(render::difference(half, half) == 0);
    CHECK(render::difference(plain(128, 72, 0), plain(128, 72, 255)) == Approx(1));
    CHECK(render::difference(half, plain(128, 72, 0)) == Approx(0.5));
    CHECK(render::difference(plain(100, 77, 90), plain(31, 200, 90)) == Approx(0).margin(1e-12));
    CHECK(render::difference(plain(3, 2, 255), plain(500, 2, 255)) == Approx(0).margin(1e-12));
    render::Image dot = half;
    for (std::size_t k = 0; k < 3; ++k)
        dot.rgba[k] = 255;
    CHECK(render::difference(half, dot) == Approx(1.0 / (128 * 72)));
}

TEST_CASE("Normals point up for a flat cloth and are safe where there is none", "[normals]") {
    sim::Snapshot cloth = flat_cloth(4, 3);
    std::vector<float> normals(cloth.positions.size());
    render::cloth_normals(4, 3, cloth.positions, {}, normals);
    for (std::size_t i = 0; i < normals.size(); i += 3)
        CHECK(normals[i + 1] == Approx(1));

    std::vector<std::uint8_t> usable;
    cloth.positions[0] = std::numeric_limits<float>::quiet_NaN();
    CHECK(render::find_drawable(cloth.positions, usable) == 1);
    render::cloth_normals(4, 3, cloth.positions, usable, normals);
    for (std::size_t i = 0; i < normals.size(); i += 3)
        CHECK(normals[i + 1] == Approx(1));

    for (float& x : cloth.positions)
        x = 0.25f; // all points in one place
    render::cloth_normals(4, 3, cloth.positions, {}, normals);
    for (std::size_t i = 0; i < normals.size(); i += 3)
        CHECK((normals[i] == 0 && normals[i + 1] == 1 && normals[i + 2] == 0));
}

TEST_CASE("Normals of a cylinder are its radii", "[normals]") {
    sim::Snapshot cloth = flat_cloth(60, 4);
    for (std::size_t i = 0; i < cloth.positions.size(); i += 3) {
        const float angle = 2 * cloth.positions[i];
        cloth.positions[i] = std::sin(angle);
        cloth.positions[i + 1] = std::cos(angle);
    }
    std::vector<float> normals(cloth.positions.size());
    render::cloth_normals(60, 4, cloth.positions, {}, normals);
    for (std::size_t point = 0; point < 240; ++point) {
        if (point % 60 == 0 || point % 60 == 59)
            continue; // the rim has one side only
        CHECK(normals[3 * point] == Approx(cloth.positions[3 * point]).margin(0.02));
        CHECK(normals[3 * point + 1] == Approx(cloth.positions[3 * point + 1]).margin(0.02));
    }
}
