// Textures from files, before they go to OpenGL: what is read, and what is said about files that are no good.
#include <sys/stat.h>

#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>

#include "gui/texture_fixture.h"
#include "render/texture_files.h"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

using namespace clothlab;
using namespace clothlab::test;
using Catch::Approx;
namespace fs = std::filesystem;

namespace {

constexpr int plenty = 16384; ///< px a side

/// A JPEG of slopes of grey, 64 x 48.
std::string jpeg_file() {
    std::vector<std::uint8_t> grey;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            grey.push_back(static_cast<std::uint8_t>(2 * x + 2 * y));
    std::string bytes;
    stbi_write_jpg_to_func(
        [](void* to, void* data, int size) {
            static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
        },
        &bytes, 64, 48, 1, grey.data(), 90);
    return bytes;
}

std::string open_error(const fs::path& file, int most_pixels = plenty) {
    return error_of([&] { render::open_texture(file, most_pixels).rgba8(); });
}

std::string environment_error(const fs::path& path, int most_pixels = plenty) {
    return error_of([&] { render::load_environment(path, most_pixels); });
}

/// The colour in the middle of a face.
std::array<float, 3> middle(const render::FloatImage& image) {
    const float* p = image.pixel(image.width / 2, image.height / 2);
    return {p[0], p[1], p[2]};
}

} // namespace

TEST_CASE("A JPEG is read as it was written", "[texture]") {
    const TemporaryFolder folder;
    write_file(folder / "slope.jpg", jpeg_file());
    const render::PictureFile file = render::open_texture(folder / "slope.jpg", plenty);
    CHECK(file.width() == 64);
    CHECK(file.height() == 48);
    CHECK_FALSE(file.high_range());
    const render::Image image = file.rgba8();
    CHECK(std::abs(image.pixel(10, 20)[1] - 60) < 6);
    CHECK(file.grey().pixel(40, 30) == Approx(140 / 255.).margin(0.02));
}

TEST_CASE("An HDR picture keeps what is brighter than white", "[texture]") {
    const TemporaryFolder folder;
    write_file(folder / "a.hdr", hdr_file(2, 1, {{8, 4, 0.5f}, {0.25f, 0.125f, 0}}));
    const render::PictureFile file = render::open_texture(folder / "a.hdr", plenty);
    REQUIRE(file.high_range());
    const render::FloatImage image = file.linear();
    CHECK(image.pixel(0, 0)[0] == 8);
    CHECK(image.pixel(0, 0)[1] == 4);
    CHECK(image.pixel(1, 0)[0] == 0.25f);
    CHECK(file.grey().pixel(0, 0) == Approx(0.2126 * 8 + 0.7152 * 4 + 0.0722 * 0.5));
}

TEST_CASE("A height map of 16 bits keeps them all, and one of 8 bits is not taken for sRGB", "[texture]") {
    const TemporaryFolder folder;
    write_file(folder / "deep.png", png_of_16_bits(2, {0, 1, 32768, 65535}));
    const render::GreyImage deep = render::open_texture(folder / "deep.png", plenty).grey();
    REQUIRE(deep.values.size() == 4);
    CHECK(deep.pixel(1, 0) == Approx(1 / 65535.));
    CHECK(deep.pixel(0, 1) == Approx(32768 / 65535.));
    CHECK(deep.pixel(1, 1) == 1);
    render::write_png(plain_picture(3, 2, {128, 128, 128}), folder / "flat.png");
    CHECK(render::open_texture(folder / "flat.png", plenty).grey().pixel(2, 1) == Approx(128 / 255.));
}

TEST_CASE("sRGB and linear values agree with the standard and with each other", "[texture]") {
    CHECK(render::linear_from_srgb(0.5f) == Approx(0.21404).epsilon(1e-4));
    CHECK(render::linear_from_srgb(0.02f) == Approx(0.02 / 12.92));
    for (const float value : {0.f, 0.002f, 0.1f, 0.5f, 1.f})
        CHECK(render::srgb_from_linear(render::linear_from_srgb(value)) == Approx(value).margin(1e-6));
}

TEST_CASE("Pictures of 1 x 1 and 8192 x 16 pixels are textures", "[texture]") {
    const TemporaryFolder folder;
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(8192, 16)}) {
        render::write_png(plain_picture(width, height, {10, 20, 30}), folder / "a.png");
        const render::Image image = render::open_texture(folder / "a.png", plenty).rgba8();
        CHECK(image.width == width);
        CHECK(image.height == height);
        CHECK(image.pixel(width - 1, height - 1)[2] == 30);
        const auto around =
            std::get<render::Cube<render::FloatImage>>(render::load_environment(folder / "a.png", plenty));
        CHECK(around[3].width == std::max(1, height / 2));
        CHECK(around[3].pixel(0, 0)[2] == Approx(render::linear_from_srgb(30 / 255.f)));
    }
}

TEST_CASE("A picture that is missing, empty, cut short or none is named with the reason", "[texture]") {
    const TemporaryFolder folder;
    const auto expect = [&](const std::string& name, const std::string& reason) {
        const std::string message = open_error(folder / name);
        INFO(name << ": " << message);
        CHECK(contains(message, (folder / name).string()));
        CHECK(contains(message, reason));
    };
    expect("missing.png", "No such file");
    fs::create_directory(folder / "folder.png");
    expect("folder.png", "it is a folder");
    REQUIRE(::mkfifo((folder / "pipe.png").c_str(), 0600) == 0);
    expect("pipe.png", "it is not a regular file");
    write_file(folder / "empty.png", "");
    expect("empty.png", "it is empty");
    write_file(folder / "text.png", "This is a text, and no picture at all. It is long enough to look like a header.");
    expect("text.png", "no PNG, JPEG, BMP or HDR");

    render::Image noise = plain_picture(32, 32, {0, 0, 0});
    for (std::size_t i = 0; i < noise.rgba.size(); ++i)
        noise.rgba[i] = static_cast<std::uint8_t>(i * i * 2654435761u >> 13);
    render::write_png(noise, folder / "a.png");
    const std::string png = read_file(folder / "a.png"), jpeg = jpeg_file();
    for (const double part : {0.02, 0.3, 0.9}) {
        write_file(folder / "cut.png", png.substr(0, static_cast<std::size_t>(part * static_cast<double>(png.size()))));
        expect("cut.png", "");
        write_file(folder / "cut.jpg",
                   jpeg.substr(0, static_cast<std::size_t>(part * static_cast<double>(jpeg.size()))));
        expect("cut.jpg", "");
    }
    const std::string hdr = hdr_file(2, 2, {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
    write_file(folder / "cut.hdr", hdr.substr(0, 60));
    expect("cut.hdr", "");
}

TEST_CASE("A picture too large for the graphics is refused with both sizes before it is decoded", "[texture]") {
    const TemporaryFolder folder;
    render::write_png(plain_picture(64, 2, {1, 2, 3}), folder / "wide.png");
    const std::string message = open_error(folder / "wide.png", 32);
    CHECK(contains(message, (folder / "wide.png").string()));
    CHECK(contains(message, "64 x 2"));
    CHECK(contains(message, "32 at most"));
    CHECK(open_error(folder / "wide.png", 64).empty());
}

TEST_CASE("A folder of six faces is surroundings, whatever kinds of picture they are", "[texture]") {
    const TemporaryFolder folder;
    const auto faces = marked_faces();
    write_faces(folder.path(), faces);
    const auto same = std::get<render::Cube<render::Image>>(render::load_environment(folder.path(), plenty));
    CHECK(same == faces);
    // With one face of high range all are linear.
    fs::remove(folder / "posy.png");
    write_file(folder / "posy.hdr", hdr_file(2, 2, {{8, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}));
    const auto linear = std::get<render::Cube<render::FloatImage>>(render::load_environment(folder.path(), plenty));
    CHECK(linear[2].pixel(0, 0)[0] == 8);
    CHECK(linear[0].pixel(0, 0)[0] == Approx(render::linear_from_srgb(20 / 255.f)));
}

TEST_CASE("A folder with a bad face says which and why", "[texture]") {
    const TemporaryFolder folder;
    const fs::path path = folder / "faces";
    write_faces(path, marked_faces());
    REQUIRE(environment_error(path).empty());
    fs::remove(path / "negy.png");
    CHECK(contains(environment_error(path), path.string()));
    CHECK(contains(environment_error(path), "named negy"));
    fs::remove(path / "posx.png");
    CHECK(contains(environment_error(path), "named posx, negy"));

    write_faces(path, marked_faces());
    render::write_png(plain_picture(3, 3, {0, 0, 0}), path / "posz.png");
    CHECK(contains(environment_error(path), "posz.png is 3 x 3 pixels, but posx.png is 2 x 2"));
    render::write_png(plain_picture(2, 1, {0, 0, 0}), path / "posz.png");
    CHECK(contains(environment_error(path), "posz.png is not square"));
    write_file(path / "posz.png", "no picture");
    CHECK(contains(environment_error(path), (path / "posz.png").string()));
    write_faces(path, marked_faces());
    CHECK(contains(environment_error(path, 1), "posx.png"));
    CHECK(contains(environment_error(folder / "none"), (folder / "none").string()));
}

TEST_CASE("A panorama lies around the viewer: its middle is behind the scene, its right is +x, its top above",
          "[texture]") {
    // 16 x 8: the colour says where in the picture it is.
    render::FloatImage panorama{16, 8, {}};
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
            panorama.rgb.insert(panorama.rgb.end(), {static_cast<float>(x), static_cast<float>(y), 2});
    const render::Cube<render::FloatImage> cube = render::cube_from_panorama(panorama, plenty);
    CHECK(cube[0].width == 4);
    // Beside the middle pixel's corner: columns 7.5 (-z), 11.5 (+x), 3.5 (-x); the picture's rows end at 0 and 7.
    CHECK(middle(cube[5])[0] == Approx(7.5).margin(1));
    CHECK(middle(cube[0])[0] == Approx(11.5).margin(1));
    CHECK(middle(cube[1])[0] == Approx(3.5).margin(1));
    CHECK(middle(cube[2])[1] < 1.5);
    CHECK(middle(cube[3])[1] > 5.5);
    CHECK(middle(cube[5])[1] == Approx(3.5).margin(1));
    // Across the seam behind the viewer (+z): only the first and the last column, and what is between.
    for (int x = 0; x < 4; ++x)
        CHECK((cube[4].pixel(x, 2)[0] < 2 || cube[4].pixel(x, 2)[0] > 13));
    CHECK(middle(cube[4])[2] == Approx(2));
}

TEST_CASE("Stamps change when a file is written, or one of the faces in a folder", "[texture]") {
    const TemporaryFolder folder;
    CHECK(render::file_stamps(folder / "a.png").empty());
    render::write_png(plain_picture(2, 2, {0, 0, 0}), folder / "a.png");
    const auto first = render::file_stamps(folder / "a.png");
    REQUIRE(first.size() == 1);
    CHECK(render::file_stamps(folder / "a.png") == first);
    fs::last_write_time(folder / "a.png", first[0].written + std::chrono::seconds(2));
    CHECK(render::file_stamps(folder / "a.png") != first);

    write_faces(folder / "faces", marked_faces());
    const auto faces = render::file_stamps(folder / "faces");
    REQUIRE(faces.size() == 6);
    fs::last_write_time(folder / "faces" / "negz.png", faces[5].written + std::chrono::seconds(2));
    CHECK(render::file_stamps(folder / "faces") != faces);
}
