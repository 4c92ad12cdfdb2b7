// `clothlab textures` and `clothlab list textures`.
#include <iostream>
#include <sstream>

#include <catch2/catch_test_macros.hpp>

#include "cli/gui/gui_commands.h"
#include "gui/texture_fixture.h"
#include "render/procedural.h"
#include "render/texture_files.h"

using namespace clothlab;
using namespace clothlab::test;
namespace fs = std::filesystem;

namespace {

struct Outcome {
    int status;
    std::string out, err;
};

/// Runs the command line in this process.
Outcome run(std::vector<const char*> arguments, const cli::GuiCommands& gui) {
    arguments.insert(arguments.begin(), "clothlab");
    std::ostringstream out, err;
    std::streambuf *const out_before = std::cout.rdbuf(out.rdbuf()), *const err_before = std::cerr.rdbuf(err.rdbuf());
    const int status = cli::run_program(static_cast<int>(arguments.size()), arguments.data(), gui);
    std::cout.rdbuf(out_before);
    std::cerr.rdbuf(err_before);
    return {status, out.str(), err.str()};
}

} // namespace

TEST_CASE("textures writes every built-in texture as pictures that can be loaded again", "[texture]") {
    const TemporaryFolder folder;
    const fs::path to = folder / "new" / "textures";
    const Outcome outcome = run({"textures", "-o", to.c_str()}, cli::gui_commands());
    REQUIRE(outcome.status == 0);
    CHECK(outcome.out == to.string() + "\n");
    for (const render::BuiltInTexture& texture : render::built_in_textures()) {
        INFO(texture.name);
        if (texture.usage == render::TextureUsage::environment)
            CHECK(fs::exists(to / texture.name / "negz.png"));
        else
            CHECK(fs::exists(to / (std::string(texture.name) + ".png")));
    }
    CHECK(render::read_png(to / "viridis.png") ==
          std::get<render::Image (*)()>(render::find_built_in("viridis")->make)());
    const auto cube = render::load_environment(to / "six-colours", 16384);
    CHECK(std::get<render::Cube<render::Image>>(cube) ==
          std::get<render::Cube<render::Image> (*)()>(render::find_built_in("six-colours")->make)());
    const auto heights = std::get<render::GreyImage (*)()>(render::find_built_in("noise-height")->make)();
    CHECK(std::abs(render::PictureFile(to / "noise-height.png").grey().pixel(100, 200) - heights.pixel(100, 200)) <
          0.5f / 255 + 1e-4f);
}

TEST_CASE("textures says which folder it cannot make", "[texture]") {
    const TemporaryFolder folder;
    write_file(folder / "file", "in the way");
    const fs::path to = folder / "file" / "textures";
    const Outcome outcome = run({"textures", "-o", to.c_str()}, cli::gui_commands());
    CHECK(outcome.status == 1);
    CHECK(contains(outcome.err, to.string()));
    CHECK(run({"textures"}, cli::gui_commands()).status == 2);
}

TEST_CASE("list textures gives name, usage and title, and a program without textures says so", "[texture]") {
    const Outcome table = run({"list", "textures"}, cli::gui_commands());
    const Outcome json = run({"list", "textures", "--json"}, cli::gui_commands());
    CHECK(table.status == 0);
    CHECK(json.status == 0);
    for (const render::BuiltInTexture& texture : render::built_in_textures()) {
        CHECK(contains(table.out, std::string(texture.name) + " "));
        CHECK(contains(table.out, texture.title));
        CHECK(contains(json.out, "\"name\": \"" + std::string(texture.name) + "\""));
    }
    CHECK(contains(json.out, "\"usage\": \"environment\""));
    for (const auto& arguments : {std::vector{"list", "textures"}, std::vector{"textures", "-o", "x"}}) {
        const Outcome without = run(arguments, {});
        CHECK(without.status == 1);
        CHECK(contains(without.err, "without its GUI"));
    }
}
