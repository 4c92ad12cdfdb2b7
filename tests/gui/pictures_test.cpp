// Every scene that clothlab comes with, drawn as the whole lab without a display: what the renderer and the panels say
// they drew, and the picture itself against a small one that was looked at by a person.
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators_range.hpp>

#include "app/core/data_folder.h"
#include "app/lab_app.h"
#include "render/image.h"
#include "scene/io.h"

namespace clothlab::test {
namespace {

namespace fs = std::filesystem;

constexpr int frame = 60;
/// Mean difference over 64 x 36 cells, of 1. Drivers and fonts rasterise a little differently; a missing cloth, sphere
/// or panel is ten times as much.
constexpr double tolerance = 0.004;

fs::path reference(const fs::path& scene) {
    return fs::path(CLOTHLAB_SOURCE_DIR) / "tests" / "gui" / "pictures" / (scene.stem().string() + ".png");
}

std::unique_ptr<app::LabApp> lab_on(const fs::path& file) {
    app::LabOptions options;
    options.window = app::Window::Kind::offscreen;
    options.width = 1280;
    options.height = 720;
    options.keep_layout = false;
    options.scale = 1;
    return std::make_unique<app::LabApp>(options, scene::load_scene(file), file);
}

/// A quarter of the size: enough to compare, small enough to keep.
render::Image quarter(const render::Image& image) {
    render::Image small{image.width / 4, image.height / 4, {}};
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x)
            for (int channel = 0; channel < 4; ++channel) {
                int sum = 0;
                for (int i = 0; i < 16; ++i)
                    sum += image.pixel(4 * x + i % 4, 4 * y + i / 4)[channel];
                small.rgba.push_back(static_cast<std::uint8_t>(sum / 16));
            }
    return small;
}

} // namespace

TEST_CASE("Every shipped scene is drawn with its cloth, its colliders and its panels, and looks as it should") {
    for (const fs::path& file : app::shipped_scenes()) {
        INFO(file);
        const auto app = lab_on(file);
        app->show_frame(frame);
        const sim::Description& d = app->lab().scene.simulation;
        const render::DrawReport& report = app->draw_report();
        const auto columns = static_cast<std::size_t>(d.cloth.num_width_points),
                   rows = static_cast<std::size_t>(d.cloth.num_height_points);
        CHECK(app->lab().snapshot->frame == frame);
        CHECK(report.cloth_triangles == 2 * (columns - 1) * (rows - 1));
        CHECK(report.points_in_view == columns * rows);
        CHECK(report.cloth_box.width() > report.width / 8);
        CHECK(report.pins == d.cloth.pinned.size());
        CHECK(report.spheres + report.planes == d.colliders.size());
        for (std::size_t i = 0; i < ui::panel_count; ++i)
            CHECK((app->lab().report[i].drawn || app->lab().report[i].behind) == ui::open_at_start[i]);
        CHECK(app->lab().status_bar_drawn);
        CHECK(app->lab().messages.empty());

        REQUIRE(fs::exists(reference(file)));
        const double off = render::difference(app->picture(), render::read_png(reference(file)));
        CHECK(off < tolerance);
    }
}

TEST_CASE("The comparison sees a cloth that is missing, a collider that is not drawn and a closed panel") {
    const fs::path file = app::scene_path("sphere-medium");
    const auto app = lab_on(file);
    const render::Image expected = render::read_png(reference(file));
    app->show_frame(0); // the cloth is somewhere else
    CHECK(render::difference(app->picture(), expected) > tolerance);
    app->show_frame(frame);
    CHECK(render::difference(app->picture(), expected) < tolerance);
    app->lab().open[static_cast<std::size_t>(ui::PanelId::look)] = false;
    app->show_frame(frame);
    CHECK(render::difference(app->picture(), expected) > tolerance);
    app->lab().open[static_cast<std::size_t>(ui::PanelId::look)] = true;
    app->lab().scene.look.shader = "wireframe";
    app->show_frame(frame);
    CHECK(render::difference(app->picture(), expected) > tolerance);
}

// Not run by default: `clothlab_gui_tests "[draw-pictures]"` after a wanted change of looks; then look at them.
TEST_CASE("Draw the pictures anew", "[.][draw-pictures]") {
    for (const fs::path& file : app::shipped_scenes()) {
        const auto app = lab_on(file);
        app->show_frame(frame);
        fs::create_directories(reference(file).parent_path());
        render::write_png(quarter(app->picture()), reference(file));
    }
}

} // namespace clothlab::test
