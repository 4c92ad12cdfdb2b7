// The grid of pictures of `clothlab experiment sweep --pictures`.
#include <catch2/catch_test_macros.hpp>

#include "app/core/data_folder.h"
#include "cli/gui/scene_grid.h"
#include "scene/error.h"
#include "scene/io.h"
#include "support/files.h"
#include "support/program.h"

namespace clothlab::test {
namespace {

render::LabelFaces faces() {
    return {render::Typeface(app::data_path("fonts/Roboto-Regular.ttf")),
            render::Typeface(app::data_path("fonts/Roboto-Bold.ttf"))};
}

render::Image plain(int width, int height, std::uint8_t red) {
    render::Image image{width, height, {}};
    for (int i = 0; i < width * height; ++i)
        image.rgba.insert(image.rgba.end(), {red, 0, 0, 255});
    return image;
}

cli::SceneGrid made_up_grid() {
    cli::SceneGrid grid;
    grid.width = 120;
    grid.height = 90;
    grid.columns = 3;
    grid.column_labels = {"k = 1", "k = 2", "k = 3"};
    grid.row_labels = {"d = 1", "d = 2"};
    grid.cells.resize(6);
    return grid;
}

/// Where the pixels of pure red are: the first column and row of each value.
std::array<int, 2> place_of(const render::Image& image, std::uint8_t red) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (const std::uint8_t* p = image.pixel(x, y); p[0] == red && p[1] == 0 && p[2] == 0)
                return {x, y};
    return {-1, -1};
}

std::size_t count_of(const render::Image& image, const std::array<std::uint8_t, 3>& colour) {
    std::size_t count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            count += std::equal(colour.begin(), colour.end(), image.pixel(x, y));
    return count;
}

/// Pixels of the colour of trouble, smooth edges included: lighter or darker, but with its proportions.
std::size_t trouble_of(const render::Image& image) {
    std::size_t count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const std::uint8_t* p = image.pixel(x, y);
            const double red = p[0], green = p[1] / red, blue = p[2] / red;
            count += red > 120 && std::abs(green - 0.69) < 0.06 && std::abs(blue - 0.52) < 0.06;
        }
    return count;
}

} // namespace

TEST_CASE("A grid's pictures stand in rows and columns, clear of each other and of the labels") {
    const cli::SceneGrid grid = made_up_grid();
    std::vector<render::Image> pictures;
    for (int i = 0; i < 6; ++i)
        pictures.push_back(plain(120, 90, static_cast<std::uint8_t>(40 * i + 50)));
    const render::Image whole = labelled_grid(grid, pictures, faces());
    std::vector<std::array<int, 2>> places;
    for (int i = 0; i < 6; ++i) {
        const auto red = static_cast<std::uint8_t>(40 * i + 50);
        places.push_back(place_of(whole, red));
        REQUIRE(count_of(whole, {red, 0, 0}) == 120 * 90); // whole: nothing is drawn over it
    }
    REQUIRE(places[0][0] > 30); // right of the rows' labels
    REQUIRE(places[0][1] > 15); // below the columns' labels
    REQUIRE(places[1][0] >= places[0][0] + 120);
    REQUIRE(places[1][1] == places[0][1]);
    REQUIRE(places[3][0] == places[0][0]);
    REQUIRE(places[3][1] >= places[0][1] + 90 + 10); // with a line between
    REQUIRE(places[5][0] == places[2][0]);
    REQUIRE(places[5][0] + 120 <= whole.width);
}

TEST_CASE("Labels that are too long for a grid are cut off, not written over their neighbours") {
    cli::SceneGrid grid = made_up_grid();
    const std::vector<render::Image> pictures(6, plain(120, 90, 200));
    const render::Image before = labelled_grid(grid, pictures, faces());
    for (auto* labels : {&grid.column_labels, &grid.row_labels})
        for (std::string& label : *labels)
            label += " and äöü much more than there is room for in any of these";
    grid.cells[0].caption = "a caption that does not fit below its picture either, at all";
    grid.cells[0].trouble = "diverged";
    const render::Image after = labelled_grid(grid, pictures, faces());
    REQUIRE(count_of(after, {200, 0, 0}) == 6 * 120 * 90);
    REQUIRE(after.height == before.height);
    REQUIRE(after.width <= before.width + 120);
}

TEST_CASE("What went wrong in a run stands below its picture in another colour") {
    cli::SceneGrid grid = made_up_grid();
    const std::vector<render::Image> pictures(6, plain(120, 90, 200));
    REQUIRE(trouble_of(labelled_grid(grid, pictures, faces())) == 0);
    grid.cells[5].trouble = "diverged";
    REQUIRE(trouble_of(labelled_grid(grid, pictures, faces())) > 10);
}

TEST_CASE("A look that cannot be drawn is said before the runs") {
    scene::Scene scene;
    REQUIRE_NOTHROW(cli::check_look(scene, "s"));
    scene.look.shader = "no-such-shader";
    REQUIRE_THROWS_AS(cli::check_look(scene, "s"), scene::SceneError);
}

TEST_CASE("A sweep draws a picture of every cell, the first parameter to the right, the second downwards",
          "[program]") {
    const TemporaryFolder folder;
    const std::string file = (folder / "grid.png").string();
    const std::vector<std::string> words{"experiment",
                                         "sweep",
                                         "two-pins",
                                         "--set",
                                         "cloth.num_width_points=8",
                                         "--set",
                                         "cloth.num_height_points=8",
                                         "--set",
                                         "cloth.pinned=[[0,0],[7,0]]",
                                         "--vary",
                                         "cloth.ks=100,5000,1000000000",
                                         "--vary",
                                         "look.shader=diffuse,wireframe",
                                         "--set",
                                         "rules.limit=off",
                                         "--frames",
                                         "20",
                                         "--pictures",
                                         file,
                                         "--picture-size",
                                         "160x120"};
    const Finished finished = clothlab(words);
    INFO(finished.err);
    REQUIRE(finished.status == 0);
    const render::Image whole = render::read_png(file);
    REQUIRE(whole.width > 3 * 160);
    REQUIRE(whole.height > 2 * 120);

    const auto refused = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all = words;
        all.insert(all.end(), more.begin(), more.end());
        const Finished answer = clothlab(all);
        REQUIRE(answer.status == 2);
        return answer.err;
    };
    REQUIRE(refused({"--vary", "cloth.density=1,2"}).find("--pictures: a grid has two directions") !=
            std::string::npos);
    REQUIRE(refused({"--shard", "1/2"}).find("--pictures: a shard has only some") != std::string::npos);
    REQUIRE(refused({"--set", "look.shaders.toon.no_such=1"}).find("the shader has no such parameter") !=
            std::string::npos);
}

} // namespace clothlab::test
