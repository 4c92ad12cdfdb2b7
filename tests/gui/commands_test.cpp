// The commands that draw: `clothlab render`, and the lab where there is no display.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_exception.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "app/core/data_folder.h"
#include "cli/gui/gui_commands.h"
#include "render/image.h"
#include "scene/error.h"
#include "support/files.h"

namespace clothlab::test {
namespace {

namespace fs = std::filesystem;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::MessageMatches;

cli::RenderArguments picture_of(const std::string& scene, const std::string& output) {
    cli::RenderArguments arguments;
    arguments.scene.scene = scene;
    arguments.frame = 2;
    arguments.width = 320;
    arguments.height = 200;
    arguments.output = output;
    return arguments;
}

int render(const cli::RenderArguments& arguments) {
    return cli::gui_commands().render(arguments);
}

} // namespace

TEST_CASE("render draws the viewport or the whole lab, of the size asked for") {
    const TemporaryFolder folder;
    cli::RenderArguments arguments = picture_of("two-pins", (folder / "scene.png").string());
    REQUIRE(render(arguments) == 0);
    const render::Image scene = render::read_png(arguments.output);
    CHECK(scene.width == 320);
    CHECK(scene.height == 200);
    arguments.ui = true;
    arguments.output = (folder / "lab.png").string();
    REQUIRE(render(arguments) == 0);
    const render::Image lab = render::read_png(arguments.output);
    CHECK(lab.width == 320);
    CHECK(lab.height == 200);
    CHECK(render::difference(scene, lab) > 0.02);
}

TEST_CASE("Frame, shader, camera and settings each change the picture") {
    const TemporaryFolder folder;
    const cli::RenderArguments plain = picture_of("two-pins", (folder / "plain.png").string());
    REQUIRE(render(plain) == 0);
    const render::Image expected = render::read_png(plain.output);
    const auto differs = [&](cli::RenderArguments arguments) {
        arguments.output = (folder / "other.png").string();
        REQUIRE(render(arguments) == 0);
        return render::difference(render::read_png(arguments.output), expected) > 0.002;
    };
    CHECK_FALSE(differs(plain));
    cli::RenderArguments later = plain, wireframe = plain, camera = plain, setting = plain;
    later.frame = 40;
    CHECK(differs(later));
    wireframe.shader = "wireframe";
    CHECK(differs(wireframe));
    std::ofstream((folder / "camera.json").string())
        << R"({"target": [0.5, 0.9, 0.5], "distance": 5, "yaw": 90, "pitch": 60})";
    camera.camera = (folder / "camera.json").string();
    CHECK(differs(camera));
    setting.scene.settings = {"cloth.offset=0.3,0,0"};
    CHECK(differs(setting));
}

TEST_CASE("The option --ghost draws the same scene with other parameters over it, at the same time") {
    const TemporaryFolder folder;
    cli::RenderArguments arguments = picture_of("two-pins", (folder / "picture.png").string());
    arguments.frame = 20;
    const auto picture = [&](const std::vector<std::string>& ghost, const char* shader = "diffuse") {
        arguments.ghost = ghost;
        arguments.shader = shader;
        REQUIRE(render(arguments) == 0);
        return render::read_png(arguments.output);
    };
    const render::Image plain = picture({}), soft = picture({"cloth.ks=100"});
    CHECK(render::difference(plain, soft) > 0.001);
    CHECK(render::difference(picture({"cloth.ks=100", "cloth.offset=0.4,0,0"}), soft) > 0.001);
    CHECK(render::difference(picture({"cloth.ks=5000"}), plain) < 0.0002); // the scene's own: it is hidden
    // Half as many frames a second, and yet as far.
    CHECK(render::difference(picture({"simulation.frames_per_second=45", "simulation.substeps=60"}), plain) < 0.0002);
    const render::Image near = picture({"cloth.ks=5000"}, "distance"), far = picture({"cloth.ks=100"}, "distance");
    CHECK(render::difference(near, far) > 0.01);

    const auto refused = [&](const std::string& setting, const char* why) {
        arguments.ghost = {setting};
        CHECK_THROWS_MATCHES(render(arguments), scene::SceneError, MessageMatches(ContainsSubstring(why)));
    };
    refused("look.shader=strain", "--ghost look.shader=strain");
    refused("cloth.ks", "--ghost cloth.ks: write KEY=VALUE");
    refused("cloth.kss=1", "kss");
    refused("cloth.num_width_points=1", "num_width_points");
    arguments.ui = true;
    refused("cloth.ks=1", "leave out --ui");
}

TEST_CASE("A picture that cannot be drawn or written is refused with a sentence") {
    const TemporaryFolder folder;
    cli::RenderArguments arguments = picture_of("two-pins", (folder / "picture.gif").string());
    CHECK_THROWS_MATCHES(render(arguments), scene::SceneError, MessageMatches(ContainsSubstring("FILE.png")));
    arguments.output = (folder / "picture.png").string();
    arguments.shader = "velvet";
    CHECK_THROWS_MATCHES(render(arguments), scene::SceneError,
                         MessageMatches(ContainsSubstring("velvet") && ContainsSubstring("diffuse")));
    arguments.shader.clear();
    arguments.camera = (folder / "none.json").string();
    CHECK_THROWS_MATCHES(render(arguments), scene::SceneError, MessageMatches(ContainsSubstring("none.json")));
    arguments.camera.clear();
    arguments.output = (folder / "no/folder/picture.png").string();
    CHECK_THROWS_MATCHES(render(arguments), std::runtime_error,
                         MessageMatches(ContainsSubstring("no/folder/picture.png")));
}

TEST_CASE("OpenGL 3.3 without a single extension that may be missing draws the same picture") {
    const TemporaryFolder folder;
    const auto draw = [&](const std::string& environment, const std::string& shader, const std::string& name) {
        const std::string file = (folder / name).string();
        // What Mesa's drivers then say of themselves; others ignore it.
        const std::string command = environment + " '" + CLOTHLAB_TEST_BINARY +
                                    "' render sphere-soft --frame 30 --size " +
                                    "160x120 --set look.sphere=cloth --set cloth.num_width_points=12 --shader " +
                                    shader + " -o '" + file + "' >/dev/null";
        REQUIRE(std::system(command.c_str()) == 0);
        return render::read_png(file);
    };
    const std::string least = "MESA_GL_VERSION_OVERRIDE=3.3 MESA_GLSL_VERSION_OVERRIDE=330 "
                              "MESA_EXTENSION_OVERRIDE='-GL_EXT_texture_filter_anisotropic'";
    for (const char* shader : {"displacement", "mirror", "wireframe-strain", "toon --ui"}) {
        INFO(shader);
        CHECK(render::difference(draw(least, shader, "least.png"), draw("", shader, "all.png")) < 1e-4);
    }
}

TEST_CASE("A texture whose file is missing is named instead of drawn as something else") {
    const TemporaryFolder folder;
    cli::RenderArguments arguments = picture_of("two-pins", (folder / "x.png").string());
    arguments.shader = "texture";
    arguments.scene.settings = {"look.shaders.texture.albedo=" + (folder / "gone.png").string()};
    REQUIRE_THROWS_MATCHES(render(arguments), std::runtime_error, MessageMatches(ContainsSubstring("gone.png")));
    REQUIRE_FALSE(fs::exists(arguments.output));
    arguments.scene.settings = {"look.shaders.texture.albedo=checker"};
    REQUIRE(render(arguments) == 0);
}

TEST_CASE("A sequence has the frames asked for, each as it is drawn alone") {
    const TemporaryFolder folder;
    cli::RenderArguments arguments = picture_of("two-pins", (folder / "frame-%02d.png").string());
    arguments.width = 64;
    arguments.height = 40;
    arguments.from = 3;
    arguments.every = 4;
    arguments.frame = 13; // 3, 7, 11
    REQUIRE(render(arguments) == 0);
    CHECK(files_of(folder.path()).size() == 3);
    arguments.output = (folder / "alone.png").string();
    arguments.from = 0;
    arguments.every.reset();
    arguments.frame = 7;
    REQUIRE(render(arguments) == 0);
    const render::Image second = render::read_png(folder / "frame-01.png");
    CHECK(second == render::read_png(arguments.output));
    CHECK(second != render::read_png(folder / "frame-02.png"));
}

TEST_CASE("A transparent picture has alpha 0 where nothing is drawn and 255 on the cloth") {
    const TemporaryFolder folder;
    cli::RenderArguments arguments = picture_of("two-pins", (folder / "scene.png").string());
    arguments.transparent = true;
    arguments.frame = 0;
    REQUIRE(render(arguments) == 0);
    const render::Image image = render::read_png(arguments.output);
    CHECK(image.pixel(0, 0)[3] == 0);
    CHECK(image.pixel(319, 199)[3] == 0);
    CHECK(std::count_if(image.rgba.begin(), image.rgba.end(), [](std::uint8_t v) { return v == 255; }) > 1000);
}

TEST_CASE("Options of films and sequences that do not go together are refused") {
    const auto refused = [](auto change, const char* why) {
        cli::RenderArguments arguments = picture_of("two-pins", "never-written.png");
        change(arguments);
        INFO(why);
        CHECK_THROWS_MATCHES(render(arguments), scene::SceneError, MessageMatches(ContainsSubstring(why)));
    };
    refused([](auto& a) { a.output = "a-%d-%d.png"; }, "one place for the number");
    refused([](auto& a) { a.every = 2; }, "--every");
    refused([](auto& a) { a.fps = 30; }, "-o FILE.mp4");
    refused([](auto& a) { a.output = "a-%d.png", a.from = 3; }, "after the last frame");
    refused([](auto& a) { a.output = "a.mp4", a.transparent = true; }, "no transparency");
    refused([](auto& a) { a.transparent = a.ui = true; }, "leave out --ui");
}

TEST_CASE("A film is an MP4 file, also of an odd size, without ffmpeg the command says what is missing") {
    const TemporaryFolder folder;
    cli::RenderArguments arguments = picture_of("two-pins", (folder / "it's a film.mp4").string());
    arguments.width = 161;
    arguments.height = 101;
    arguments.frame = 9;
    if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0) {
        CHECK_THROWS_MATCHES(render(arguments), std::runtime_error,
                             MessageMatches(ContainsSubstring("package ffmpeg")));
        return;
    }
    REQUIRE(render(arguments) == 0);
    std::string head(12, '\0');
    std::ifstream(arguments.output, std::ios::binary).read(head.data(), 12);
    CHECK(head.substr(4, 4) == "ftyp");
    CHECK(fs::file_size(arguments.output) > 1000);
    CHECK(files_of(folder.path()).size() == 1); // and nothing that was left over
}

TEST_CASE("With no display the lab draws itself into a picture with a draped cloth") {
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
    ::unsetenv("WAYLAND_SOCKET");
    const TemporaryFolder folder;
    cli::LabArguments arguments;
    arguments.scene.settings = {"cloth.num_width_points=30", "cloth.num_height_points=30"};
    arguments.picture = (folder / "lab.png").string();
    REQUIRE(cli::gui_commands().lab(arguments) == 0);
    const render::Image lab = render::read_png(arguments.picture);
    CHECK(lab.width == 1440);
    CHECK(lab.height == 900);
    int cloth = 0; // pixels of the cloth's colour inside the viewport
    for (int y = 50; y < 780; ++y)
        for (int x = 280; x < 1060; ++x) {
            const std::uint8_t* p = lab.pixel(x, y);
            cloth += p[0] > 140 && p[1] < 150 && p[2] < 120 ? 1 : 0;
        }
    CHECK(cloth > 10000);
}

} // namespace clothlab::test
