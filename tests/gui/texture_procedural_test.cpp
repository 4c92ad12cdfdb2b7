// Textures made by code: they tile, they are the same each time, and the colour maps are the published ones.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>

#include "render/procedural.h"

using namespace clothlab::render;
using Catch::Approx;

namespace {

/// Brightness of any picture, 0 to 1.
GreyImage brightness(const GreyImage& image) {
    return image;
}
GreyImage brightness(const Image& image) {
    GreyImage grey{image.width, image.height, {}};
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
        grey.values.push_back(static_cast<float>(image.rgba[i] + image.rgba[i + 1] + image.rgba[i + 2]) / 765);
    return grey;
}
GreyImage brightness(const Cube<Image>& cube) {
    return brightness(cube[0]);
}

GreyImage brightness_of(const char* name) {
    return std::visit([](auto make) { return brightness(make()); }, find_built_in(name)->make);
}

Image picture_of(const char* name) {
    return std::get<Image (*)()>(find_built_in(name)->make)();
}

double mean(const GreyImage& image) {
    return std::accumulate(image.values.begin(), image.values.end(), 0.) / static_cast<double>(image.values.size());
}

/// The mean difference between a column, or a row, and the next, which after the last is the first.
double step_after(const GreyImage& image, int i, bool columns) {
    const int lines = columns ? image.width : image.height, next = (i + 1) % lines;
    double sum = 0;
    for (int j = 0; j < image.height; ++j) // square pictures
        sum += std::abs(columns ? image.pixel(i, j) - image.pixel(next, j) : image.pixel(j, i) - image.pixel(j, next));
    return sum / image.height;
}

std::uint64_t add_to_hash(std::uint64_t hash, const void* data, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i) // FNV-1a
        hash = (hash ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001B3u;
    return hash;
}
std::uint64_t hash_of(const Image& image) {
    return add_to_hash(0xCBF29CE484222325u, image.rgba.data(), image.rgba.size());
}
std::uint64_t hash_of(const GreyImage& image) {
    return add_to_hash(0xCBF29CE484222325u, image.values.data(), image.values.size() * sizeof(float));
}
std::uint64_t hash_of(const Cube<Image>& cube) {
    std::uint64_t hash = 0;
    for (const Image& face : cube)
        hash = hash * 31 + hash_of(face);
    return hash;
}

struct FacePoint {
    int face;
    float s, t; ///< -1 to 1
};

/// The face and the place on it that OpenGL takes for a direction: the core profile's table "Selection of cube map
/// images".
FacePoint face_of(float x, float y, float z) {
    const float ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
    if (ax >= ay && ax >= az)
        return x > 0 ? FacePoint{0, -z / ax, -y / ax} : FacePoint{1, z / ax, -y / ax};
    if (ay >= az)
        return y > 0 ? FacePoint{2, x / ay, z / ay} : FacePoint{3, x / ay, -z / ay};
    return z > 0 ? FacePoint{4, x / az, -y / az} : FacePoint{5, -x / az, -y / az};
}

const std::uint8_t* pixel_at(const Cube<Image>& cube, const FacePoint& p) {
    const Image& image = cube[static_cast<std::size_t>(p.face)];
    const auto index = [&](float a) {
        return std::min(static_cast<int>((a + 1) / 2 * static_cast<float>(image.width)), image.width - 1);
    };
    return image.pixel(index(p.s), index(p.t));
}

int difference(const std::uint8_t* a, const std::uint8_t* b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

/// Luminance of a pixel of a colour map (IEC 61966-2-1).
float luminance(const Image& image, int x) {
    const std::uint8_t* p = image.pixel(x, 0);
    return 0.2126f * linear_from_srgb(p[0] / 255.f) + 0.7152f * linear_from_srgb(p[1] / 255.f) +
           0.0722f * linear_from_srgb(p[2] / 255.f);
}

bool about(const std::uint8_t* p, unsigned rgb, int tolerance) {
    const std::uint8_t expected[] = {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8),
                                     static_cast<std::uint8_t>(rgb)};
    return difference(p, expected) <= tolerance && p[3] == 255;
}

} // namespace

TEST_CASE("Built-in textures have names of their own, and the sizes that are promised", "[texture]") {
    std::set<std::string> names;
    for (const BuiltInTexture& texture : built_in_textures()) {
        CHECK(names.insert(texture.name).second);
        CHECK(find_built_in(texture.name) == &texture);
    }
    CHECK(names.size() == 17);
    CHECK(find_built_in("brick") == nullptr);
    for (const char* name : {"bricks", "weave-height", "noise-height", "checker"}) {
        CHECK(brightness_of(name).width == 512);
        CHECK(brightness_of(name).height == 512);
    }
    for (const char* name : {"toon-ramp", "viridis", "blue-orange"}) {
        CHECK(picture_of(name).width == 256);
        CHECK(picture_of(name).height == 1);
    }
}

TEST_CASE("Textures that repeat have no seam", "[texture]") {
    for (const char* name :
         {"bricks", "weave", "skin", "bricks-height", "weave-height", "skin-height", "noise-height"}) {
        const GreyImage image = brightness_of(name);
        for (const bool columns : {true, false}) {
            double largest = 0;
            for (int i = 0; i + 1 < image.width; ++i)
                largest = std::max(largest, step_after(image, i, columns));
            INFO(name << (columns ? ", from right to left" : ", from bottom to top"));
            CHECK(step_after(image, image.width - 1, columns) <= largest);
        }
    }
}

TEST_CASE("A texture made twice is the same, no two are, and all look as they did on the first machine", "[texture]") {
    // The mean brightness of some: on another machine, rounding may differ in single pixels.
    const std::map<std::string, double> known = {
        {"bricks", 0.4125}, {"weave", 0.5853}, {"skin-height", 0.6087}, {"noise-height", 0.4672}, {"sky", 0.5536}};
    std::set<std::uint64_t> hashes;
    for (const BuiltInTexture& texture : built_in_textures()) {
        INFO(texture.name);
        std::visit(
            [&](auto make) {
                const auto made = make();
                const std::uint64_t hash = hash_of(made);
                CHECK(hash_of(make()) == hash);
                CHECK(hashes.insert(hash).second);
                if (known.contains(texture.name))
                    CHECK(mean(brightness(made)) == Approx(known.at(texture.name)).margin(0.002));
            },
            texture.make);
    }
}

TEST_CASE("Height maps fit their pictures: joints lie below bricks, gaps below threads", "[texture]") {
    const GreyImage bricks = brightness_of("bricks-height"), weave = brightness_of("weave-height");
    CHECK(bricks.pixel(64, 25) > 0.7f);   // the middle of the first brick
    CHECK(bricks.pixel(256, 51) < 0.45f); // the joint under the first row
    CHECK(bricks.pixel(128, 25) < 0.45f); // between two bricks
    CHECK(bricks.pixel(128, 77) > 0.7f);  // a row lower there is a brick
    const Image colours = picture_of("bricks");
    CHECK(colours.pixel(64, 25)[0] > colours.pixel(64, 25)[2] + 30);   // red
    CHECK(colours.pixel(128, 25)[0] < colours.pixel(128, 25)[2] + 30); // grey
    int holes = 0;
    for (const float height : weave.values)
        holes += height < 0.05f ? 1 : 0;
    CHECK(holes > 28 * 28 * 4);
    CHECK(holes < 512 * 512 / 10);
    for (const char* name : {"bricks-height", "weave-height", "skin-height", "noise-height"}) {
        const GreyImage image = brightness_of(name);
        const auto [low, high] = std::minmax_element(image.values.begin(), image.values.end());
        INFO(name);
        CHECK(*low >= 0);
        CHECK(*high <= 1);
        CHECK(*high - *low > 0.6f);
    }
}

TEST_CASE("Colour maps have the published colours, and grow lighter from end to end", "[texture]") {
    struct Known {
        const char* name;
        unsigned low, quarter, middle, high; ///< of 256 colours those of index 0, 64, 128, 255
        int tolerance;                       ///< of 52 control points instead of 256
    };
    for (const Known& known : {Known{"viridis", 0x440154, 0x3B528B, 0x21918C, 0xFDE725, 1},
                               Known{"cividis", 0x00224E, 0x434E6C, 0x7D7C78, 0xFEE838, 2},
                               Known{"inferno", 0x000004, 0x57106E, 0xBC3754, 0xFCFFA4, 1}}) {
        const Image map = picture_of(known.name);
        INFO(known.name);
        CHECK(about(map.pixel(0, 0), known.low, 0));
        CHECK(about(map.pixel(64, 0), known.quarter, known.tolerance));
        CHECK(about(map.pixel(128, 0), known.middle, known.tolerance));
        CHECK(about(map.pixel(255, 0), known.high, 0));
        for (int x = 8; x < 256; x += 8)
            CHECK(luminance(map, x) > luminance(map, x - 8));
    }
    const Image diverging = picture_of("blue-orange");
    CHECK(about(diverging.pixel(0, 0), 0x053061, 0));
    CHECK(about(diverging.pixel(127, 0), 0xF7F7F7, 2));
    CHECK(about(diverging.pixel(128, 0), 0xF7F7F7, 2));
    CHECK(about(diverging.pixel(255, 0), 0x7F3B08, 0));
    for (int x = 8; x < 128; x += 8) {
        CHECK(luminance(diverging, x) > luminance(diverging, x - 8));
        CHECK(luminance(diverging, 255 - x) > luminance(diverging, 263 - x));
    }
}

TEST_CASE("The toon ramp has four steps that grow lighter", "[texture]") {
    const Image ramp = picture_of("toon-ramp");
    std::vector<int> levels{ramp.pixel(0, 0)[0]};
    for (int x = 1; x < 256; ++x)
        if (ramp.pixel(x, 0)[0] != levels.back())
            levels.push_back(ramp.pixel(x, 0)[0]);
    CHECK(levels.size() == 4);
    CHECK(std::is_sorted(levels.begin(), levels.end()));
    CHECK(levels.back() == 255);
}

TEST_CASE("Points on the faces of a cube lie in the directions for which OpenGL takes them", "[texture]") {
    for (int face = 0; face < 6; ++face) {
        for (const float s : {-0.9f, 0.1f, 0.8f}) {
            for (const float t : {-0.7f, 0.2f, 0.95f}) {
                const auto d = cube_direction(face, s, t);
                const FacePoint back = face_of(d[0], d[1], d[2]);
                CHECK(back.face == face);
                CHECK(back.s == Approx(s));
                CHECK(back.t == Approx(t));
            }
        }
    }
}

TEST_CASE("The six colours are where their directions are", "[texture]") {
    const Cube<Image> cube = std::get<Cube<Image> (*)()>(find_built_in("six-colours")->make)();
    CHECK(about(pixel_at(cube, face_of(1, 0.1f, 0.2f)), 0xFF0000, 0));
    CHECK(about(pixel_at(cube, face_of(-1, 0.1f, 0.2f)), 0x00FFFF, 0));
    CHECK(about(pixel_at(cube, face_of(0.1f, 1, 0.2f)), 0x00FF00, 0));
    CHECK(about(pixel_at(cube, face_of(0.1f, -1, 0.2f)), 0xFF00FF, 0));
    CHECK(about(pixel_at(cube, face_of(0.1f, 0.2f, 1)), 0x0000FF, 0));
    CHECK(about(pixel_at(cube, face_of(0.1f, 0.2f, -1)), 0xFFFF00, 0));
}

TEST_CASE("The faces of sky and room join at their edges, the sky above", "[texture]") {
    for (const char* name : {"sky", "room"}) {
        const Cube<Image> cube = std::get<Cube<Image> (*)()>(find_built_in(name)->make)();
        double sum = 0;
        int count = 0;
        for (int face = 0; face < 6; ++face) {
            for (int i = 4; i < 252; i += 4) {
                const float along = (static_cast<float>(i) + 0.5f) / 128 - 1, edge = 255.5f / 128 - 1;
                for (const float side : {-1.f, 1.f}) {
                    for (const bool upright : {true, false}) {
                        const float in = side * edge, out = side * 1.001f;
                        const auto d = upright ? cube_direction(face, out, along) : cube_direction(face, along, out);
                        const FacePoint inner = upright ? FacePoint{face, in, along} : FacePoint{face, along, in};
                        const FacePoint outer = face_of(d[0], d[1], d[2]);
                        REQUIRE(outer.face != face);
                        sum += difference(pixel_at(cube, inner), pixel_at(cube, outer));
                        ++count;
                    }
                }
            }
        }
        INFO(name);
        CHECK(sum / count < 4);
    }
    const Cube<Image> sky = std::get<Cube<Image> (*)()>(find_built_in("sky")->make)();
    CHECK(pixel_at(sky, face_of(-0.3f, 1, -0.6f))[2] > 150);
    CHECK(pixel_at(sky, face_of(-0.3f, -1, -0.6f))[2] < 120);
    CHECK(about(pixel_at(sky, face_of(1.9f, 3.2f, 2.6f)), 0xFFFFFF, 0)); // the sun, where the light of scenes is
}
