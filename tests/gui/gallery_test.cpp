// `clothlab gallery`: its table, its pictures and its page, its captions, and what it does when something is wrong.
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_exception.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "app/core/data_folder.h"
#include "app/shader_list.h"
#include "cli/gui/gallery.h"
#include "cli/gui/gallery_caption.h"
#include "cli/gui/gallery_page.h"
#include "cli/gui/gui_commands.h"
#include "cli/progress_bar.h"
#include "render/image.h"
#include "scene/error.h"
#include "support/files.h"

namespace clothlab::test {
namespace {

namespace fs = std::filesystem;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::MessageMatches;
using cli::Section;

const std::vector<std::string> small{"cloth.num_width_points=8", "cloth.num_height_points=8",
                                     "cloth.pinned=[[0,0],[7,0]]"};

std::vector<Section> small_table() {
    return {{"First",
             "Two moments of one run.",
             small,
             {{"early", "Early", "two-pins", 2, {}}, {"late", "Late", "two-pins", 5, {}}}},
            {"Second", "Springs & <lines>.", small, {{"lines", "Lines", "two-pins", 2, {"look.shader=wireframe"}}}}};
}

struct Drawn {
    int status = 0;
    std::string page, out, err;
};

Drawn draw(const std::vector<Section>& sections, const fs::path& folder, const std::string& only = "") {
    cli::GalleryOptions options;
    options.folder = folder;
    options.only = only;
    options.width = 160;
    options.height = 120;
    options.jobs = 2;
    std::ostringstream out, err;
    Drawn result;
    result.status = cli::draw_gallery(sections, options, out, err);
    result.out = out.str();
    result.err = err.str();
    result.page = read_file(folder / "index.html");
    return result;
}

std::set<std::string> pictures_of(const std::string& page) {
    static const std::regex picture("<img src=\"([^\"]+)\"");
    std::set<std::string> names;
    for (std::sregex_iterator it(page.begin(), page.end(), picture), end; it != end; ++it)
        names.insert((*it)[1]);
    return names;
}

std::set<std::string> names_in(const fs::path& folder) {
    std::set<std::string> names;
    for (const fs::path& file : files_of(folder))
        names.insert(file.filename().string());
    return names;
}

/// The caption of a two-pins run with these settings on top.
cli::Caption caption_of(const std::string& scene_name, int frame, std::vector<std::string> settings) {
    const auto shaders = app::read_shader_list({app::data_path("shaders")});
    const scene::Scene scene = cli::load_figure({"x", "x", scene_name, frame, {}}, settings, shaders);
    const auto simulation = sim::Simulation::create(scene.simulation);
    simulation->watch(true);
    sim::Snapshot snapshot, before;
    simulation->capture(before);
    while (simulation->frame() < static_cast<std::uint64_t>(frame))
        simulation->step_frame();
    simulation->capture(snapshot, {.stability = true});
    return cli::caption(scene, shaders, settings, snapshot, before);
}

std::vector<std::string> small_with(std::vector<std::string> settings) {
    settings.insert(settings.begin(), small.begin(), small.end());
    return settings;
}

} // namespace

TEST_CASE("Every figure of the gallery names a scene, a shader and parameters that exist, and a file of its own") {
    const auto shaders = app::read_shader_list({app::data_path("shaders")});
    static const std::regex allowed("[a-z0-9.-]+");
    std::set<std::string> names;
    for (const Section& section : cli::gallery_sections()) {
        CHECK_FALSE(section.title.empty());
        CHECK_FALSE(section.text.empty());
        CHECK_FALSE(section.figures.empty());
        for (const cli::Figure& figure : section.figures) {
            INFO(figure.name);
            std::vector<std::string> settings = section.settings;
            settings.insert(settings.end(), figure.settings.begin(), figure.settings.end());
            CHECK_NOTHROW(cli::load_figure(figure, settings, shaders));
            CHECK(fs::exists(checkout() / "scenes" / (figure.scene + ".json")));
            CHECK(std::regex_match(figure.name, allowed));
            CHECK(names.insert(figure.name).second);
            CHECK_FALSE(figure.title.empty());
            CHECK(figure.frame >= 0);
        }
    }
    CHECK(names.size() > 50);
}

TEST_CASE("The gallery's page shows every figure that was drawn, and each picture is there") {
    const TemporaryFolder folder;
    const Drawn drawn = draw(small_table(), folder / "new/gallery");
    CHECK(drawn.status == 0);
    CHECK(drawn.err.empty());
    CHECK(drawn.out == (folder / "new/gallery/index.html").string() + "\n");
    CHECK(pictures_of(drawn.page) == std::set<std::string>{"early.png", "late.png", "lines.png"});
    CHECK(names_in(folder / "new/gallery") ==
          std::set<std::string>{"early.png", "index.html", "late.png", "lines.png", "overview.png"});
    CHECK(drawn.page.find("Springs &amp; &lt;lines&gt;.") != std::string::npos);
    CHECK(drawn.page.find("alt=\"First: Early. Two pins: ks 5") != std::string::npos);
    const render::Image early = render::read_png(folder / "new/gallery/early.png");
    CHECK(early.width == 160);
    CHECK(early.height > 130);
    CHECK(render::difference(early, render::read_png(folder / "new/gallery/late.png")) > 0.001);
    const render::Image overview = render::read_png(folder / "new/gallery/overview.png");
    CHECK(overview.width > 2 * 240);
    CHECK(overview.height > 2 * 180);
}

TEST_CASE("A figure is what its command draws, with a label below it") {
    const TemporaryFolder folder;
    const std::vector<Section> table = small_table();
    draw(table, folder.path(), "^lines$");
    CHECK(cli::figure_command(table[1], table[1].figures[0], 160, 120) ==
          "clothlab render two-pins --frame 2 --size 160x120 --set cloth.num_width_points=8 --set "
          "cloth.num_height_points=8 --set 'cloth.pinned=[[0,0],[7,0]]' --set look.shader=wireframe -o lines.png");
    cli::RenderArguments arguments;
    arguments.scene = {"two-pins", small_with({"look.shader=wireframe"})};
    arguments.frame = 2;
    arguments.width = 160;
    arguments.height = 120;
    arguments.output = (folder / "alone.png").string();
    REQUIRE(cli::gui_commands().render(arguments) == 0);
    const render::Image figure = render::read_png(folder / "lines.png"), alone = render::read_png(folder / "alone.png");
    int different = 0, lit = 0;
    for (int y = 0; y < figure.height; ++y)
        for (int x = 0; x < 160; ++x) {
            const std::uint8_t* p = figure.pixel(x, y);
            if (y < 120)
                different += std::equal(p, p + 4, alone.pixel(x, y)) ? 0 : 1;
            else
                lit += p[1] > 60 ? 1 : 0;
        }
    CHECK(different == 0);
    CHECK(lit > 50); // letters
}

TEST_CASE("Figures that are not drawn anew stay on the gallery's page, others leave it") {
    const TemporaryFolder folder;
    draw(small_table(), folder.path());
    const auto time = fs::last_write_time(folder / "early.png");
    fs::remove(folder / "lines.png");
    const Drawn again = draw(small_table(), folder.path(), "late");
    CHECK(again.status == 0);
    CHECK(pictures_of(again.page) == std::set<std::string>{"early.png", "late.png"});
    CHECK(fs::last_write_time(folder / "early.png") == time);
    CHECK(again.page.find("<figure id=\"lines\">") == std::string::npos);
    CHECK_THROWS_MATCHES(draw(small_table(), folder.path(), "nothing"), scene::SceneError,
                         MessageMatches(ContainsSubstring("nothing") && ContainsSubstring("early")));
    CHECK_THROWS_MATCHES(draw(small_table(), folder.path(), "["), scene::SceneError,
                         MessageMatches(ContainsSubstring("--only")));
}

TEST_CASE("A gallery's folder that cannot be written is an error that names it, before anything is drawn") {
    const TemporaryFolder folder;
    write_file(folder / "file", "");
    CHECK_THROWS_MATCHES(draw(small_table(), folder / "file/gallery"), std::runtime_error,
                         MessageMatches(ContainsSubstring("file/gallery")));
    fs::create_directories(folder / "taken/early.png");
    const Drawn drawn = draw(small_table(), folder / "taken");
    CHECK(drawn.status == 1);
    CHECK_THAT(drawn.err, ContainsSubstring("figure early: cannot write the picture"));
    CHECK(pictures_of(drawn.page) == std::set<std::string>{"late.png", "lines.png"});
}

TEST_CASE("A figure that fails is named, and the others are drawn") {
    const TemporaryFolder folder;
    std::vector<Section> table = small_table();
    table[0].figures[0].settings = {"cloth.ksi=4"};
    table[1].figures.push_back({"velvet", "Velvet", "two-pins", 2, {"look.shader=velvet"}});
    const Drawn drawn = draw(table, folder.path());
    CHECK(drawn.status == 1);
    CHECK_THAT(drawn.err, ContainsSubstring("figure early: ") && ContainsSubstring("cloth.ksi") &&
                              ContainsSubstring("figure velvet: "));
    CHECK(pictures_of(drawn.page) == std::set<std::string>{"late.png", "lines.png"});
    CHECK_THAT(drawn.page, ContainsSubstring("This figure could not be drawn") && ContainsSubstring("cloth.ksi"));
}

TEST_CASE("An interrupted gallery ends at once, with a page of what there is") {
    const TemporaryFolder folder;
    std::vector<Section> table = small_table();
    table[1].figures.push_back({"endless", "Endless", "two-pins", 1000000000, {}});
    int asked = 0;
    cli::GalleryOptions options;
    options.folder = folder.path();
    options.width = 40;
    options.height = 30;
    options.jobs = 1;
    std::atomic<int> calls = 0;
    options.interrupted = [&] { return ++calls > 50; };
    std::ostringstream out, err;
    CHECK(cli::draw_gallery(table, options, out, err) == 1);
    CHECK_THAT(err.str(), ContainsSubstring("interrupted; ") && ContainsSubstring(" of 4 figures"));
    for (const std::string& picture : pictures_of(read_file(folder / "index.html"))) {
        CHECK(fs::exists(folder / picture));
        ++asked;
    }
    CHECK(asked < 4);
}

TEST_CASE("Captions of runs that fail say why, those of sound runs do not") {
    const cli::Caption sound = caption_of("two-pins", 20, small_with({}));
    CHECK_FALSE(sound.trouble);
    CHECK_THAT(sound.outcome, ContainsSubstring("In motion") && ContainsSubstring("stable up to 2"));
    CHECK_THAT(sound.outcome,
               !ContainsSubstring("nstable") && !ContainsSubstring("Blown") && !ContainsSubstring("Jitter"));
    CHECK_THAT(sound.parameters, ContainsSubstring("ks 5\u00a0000\u00a0N/m, density 15\u00a0g/cm²") &&
                                     ContainsSubstring("8 × 8 points") && ContainsSubstring("frame 20, 0.222 s"));

    const cli::Caption jitter = caption_of("two-pins", 30, small_with({"cloth.ks=10000000"}));
    CHECK(jitter.trouble);
    CHECK_THAT(jitter.outcome, ContainsSubstring("Jitter: at ") && ContainsSubstring("too stiff for 30 substeps"));

    const cli::Caption blown_up = caption_of("two-pins", 2, small_with({"cloth.ks=1000000000"}));
    CHECK(blown_up.trouble);
    CHECK_THAT(blown_up.outcome, ContainsSubstring("Blown up: at ") && ContainsSubstring("too stiff for 30 substeps"));

    const cli::Caption pushed = caption_of("two-pins", 3, small_with({"cloth.density=-150"}));
    CHECK(pushed.trouble);
    CHECK_THAT(pushed.outcome, ContainsSubstring("springs push where they should pull"));

    const cli::Caption below = caption_of(
        "self-collision", 3, {"cloth.num_width_points=8", "cloth.num_height_points=8", "cloth.offset=0,-0.3,0"});
    CHECK(below.trouble);
    CHECK_THAT(below.outcome, ContainsSubstring("24 points are below the plane"));
    CHECK_THAT(below.parameters, ContainsSubstring("offset (0, -0.3, 0)\u00a0m"));

    const cli::Caption start = caption_of("two-pins", 0, small_with({"look.show_shearing=false"}));
    CHECK_THAT(start.outcome, ContainsSubstring("before the first step"));
    CHECK_THAT(start.look, ContainsSubstring("Shader Diffuse, shear off"));
}

TEST_CASE("Numbers in captions are written as people read them") {
    CHECK(cli::readable(0.2) == "0.2");
    CHECK(cli::readable(-15) == "-15");
    CHECK(cli::readable(1000000) == "1\u00a0000\u00a0000");
    CHECK(cli::readable(-1500) == "-1\u00a0500");
    CHECK(cli::readable(12.3456) == "12.35");
}

TEST_CASE("A progress bar tells the share and the time left") {
    CHECK(cli::progress_line(0, 3, "a") == "[------------------------------]   0 %  a");
    CHECK(cli::progress_line(0.5, 70, "b") == "[###############---------------]  50 %  1:10 left  b");
    CHECK(cli::progress_line(1, 70, "c") == "[##############################] 100 %  0:00 left  c");
    std::ostringstream file;
    {
        cli::ProgressBar bar(file, 10, false);
        bar.show(5, "half");
    }
    CHECK(file.str().empty());
}

} // namespace clothlab::test
