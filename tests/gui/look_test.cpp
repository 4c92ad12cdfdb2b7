// How the scene is looked at: split view, lamps, spheres with the cloth's shader, shaders' parameters, dropped
// pictures.
#include <cmath>

#include "gui/lab_driver.h"
#include "gui/render_fixture.h"
#include "gui/texture_fixture.h"
#include "scene/io.h"
#include "ui/icons.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

double linear(std::uint8_t srgb) {
    const double v = srgb / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

const scene::ShaderValues& values_of(LabDriver& driver, const char* shader) {
    return driver.lab().scene.look.shaders[shader];
}

} // namespace

TEST_CASE("Each part of a split view is what its shader alone draws there", "[look]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(8, 8);
    const std::vector<sim::Collider> colliders = {sim::Sphere{{0.3, 0.1, 0}, 0.3, 0}};
    render::Scene scene = scene_of(cloth);
    scene.colliders = colliders;
    render::Surface coarse = shader_of("wireframe");
    coarse.sphere_lat_lines = coarse.sphere_lon_lines = 5;
    const render::Image left = studio.draw(scene);
    scene.options.surface = coarse;
    const render::Image right = studio.draw(scene);
    REQUIRE(count_differences(left, right) > 1000);
    scene.options.surface = shader_of("diffuse");
    scene.right = coarse;
    for (const float divider : {0.f, 0.6f, 1.f, -2.f}) {
        scene.divider = divider;
        const render::Image both = studio.draw(scene);
        CHECK(glIsEnabled(GL_SCISSOR_TEST) == GL_FALSE);
        const int at = static_cast<int>(std::lround(160 * std::clamp(divider, 0.f, 1.f)));
        int wrong = 0;
        // But for the pixels at the divider: Mesa's rasteriser cuts off samples of its neighbours.
        for (int y = 0; y < 90; ++y)
            for (int x = 0; x < 160; ++x)
                wrong += x != at && x != at - 1 && differs(both, x < at ? left : right, x, y) ? 1 : 0;
        CHECK(wrong == 0);
    }
    scene.right->shader = "no-such";
    CHECK_THROWS_AS(studio.draw(scene), render::ShaderError);
}

TEST_CASE("Two heat maps in a split view each show their own quantity", "[look]") {
    Studio studio;
    sim::Snapshot cloth = flat_cloth(8, 8);
    cloth.quantity.assign(64, 0.05f);       // strain: 5 %
    cloth.second_quantity.assign(64, 1.5f); // m/s
    const auto alone = [&](const char* shader, std::vector<float> quantity) {
        sim::Snapshot one = flat_cloth(8, 8);
        one.quantity = std::move(quantity);
        render::Scene scene = scene_of(one);
        scene.options.surface = shader_of(shader);
        return studio.draw(scene);
    };
    const render::Image strain = alone("strain", cloth.quantity), speed = alone("speed", cloth.second_quantity);
    REQUIRE(differs(strain, speed, 90, 45));
    render::Scene scene = scene_of(cloth);
    scene.options.surface = shader_of("strain");
    scene.right = shader_of("speed");
    scene.right->second_quantity = true;
    const render::Image both = studio.draw(scene);
    CHECK_FALSE(differs(both, strain, 70, 45));
    CHECK_FALSE(differs(both, speed, 90, 45));

    scene::Look look;
    look.shader = "strain";
    look.split.shader = "speed";
    const auto shaders = app::read_shader_list(shader_folder);
    CHECK(app::extras_of(look, shaders).second_quantity == sim::PointQuantity::none); // no split view
    look.split.on = true;
    CHECK(app::extras_of(look, shaders).quantity == sim::PointQuantity::strain);
    CHECK(app::extras_of(look, shaders).second_quantity == sim::PointQuantity::speed);
    look.split.shader = "wireframe-strain";
    CHECK(app::extras_of(look, shaders).second_quantity == sim::PointQuantity::none); // the first serves both
}

TEST_CASE("The light of two lamps is the sum of each alone", "[look]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(3, 3);
    render::Scene scene = scene_of(cloth);
    scene.options.surface = shader_of("diffuse", {{"front_colour", "#FFFFFF"}});
    scene.options.fill = scene.options.ambient = 0;
    const std::array<render::Light, 2> lamps = {render::Light{{0, 1.5f, 0}, 0.6f}, render::Light{{1, 1, 0.5f}, 0.9f}};
    const auto light = [&](render::Light a, render::Light b) {
        scene.options.lights = {a, b};
        return linear(studio.draw(scene).pixel(80, 45)[0]);
    };
    const double first = light(lamps[0], {}), second = light({}, lamps[1]);
    CHECK(first > 0.1);
    CHECK(second > 0.1);
    CHECK(std::abs(light(lamps[0], lamps[1]) - first - second) < 0.01);
    CHECK(std::abs(light(lamps[1], lamps[0]) - first - second) < 0.01);
}

TEST_CASE("Spheres are drawn with the cloth's shader where that is asked for", "[look]") {
    Studio studio;
    const std::vector<sim::Collider> colliders = {sim::Sphere{{0, 0, 0}, 0.5, 0}};
    render::Scene scene = empty_scene();
    scene.colliders = colliders;
    scene.options.surface = shader_of("diffuse", {{"front_colour", "#FF0000"}});
    const std::uint8_t grey = studio.draw(scene).pixel(80, 45)[2];
    CHECK(grey > 60);
    scene.options.spheres_like_cloth = true;
    const render::Image red = studio.draw(scene);
    CHECK(studio.report.spheres == 1);
    CHECK(red.pixel(80, 45)[0] > 100);
    CHECK(red.pixel(80, 45)[2] == 0);
    scene.options.surface = shader_of("wireframe"); // a sphere has no springs
    CHECK(studio.draw(scene).pixel(80, 45)[2] == grey);
}

TEST_CASE("The ground grid is drawn at y = 0 without a plane", "[look]") {
    Studio studio;
    render::Scene scene = empty_scene();
    const render::Image without = studio.draw(scene);
    scene.options.ground_grid = true;
    CHECK(count_differences(studio.draw(scene), without) > 100);
    CHECK(studio.report.planes == 0);
}

TEST_CASE("More samples per pixel give shades between along an edge", "[look]") {
    Studio studio;
    const sim::Snapshot cloth = flat_cloth(3, 3);
    render::Scene scene = scene_of(cloth);
    scene.view.up = {0.3f, 0, -1}; // edges across the pixels
    scene.options.ambient = 1;
    scene.options.lights = {};
    // Neither the cloth's colour nor the background's.
    const auto between = [&](int samples) {
        studio.target.set_samples(samples);
        const render::Image image = studio.draw(scene);
        int count = 0;
        for (int y = 0; y < 90; ++y)
            for (int x = 0; x < 160; ++x)
                count += image.pixel(x, y)[0] > 90 && image.pixel(x, y)[0] < 200 ? 1 : 0;
        return count;
    };
    CHECK(between(1) == 0);
    CHECK(studio.target.samples() == 1);
    CHECK(between(4) > 50);
    CHECK(studio.target.samples() == 4);
}

TEST_CASE("The divider of a split view and a lamp's handle are dragged with the mouse", "[look]") {
    LabDriver driver;
    driver.lab().scene.look.split.on = true;
    driver.settle();
    const sim::Vec3 lamp = driver.lab().scene.look.lamp.position;
    const scene::Camera camera = *driver.lab().scene.camera;
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->ItemDragWithDelta("###Viewport/divider", {100, 0}); }));
    const float width = driver.lab().report[static_cast<std::size_t>(ui::PanelId::viewport)].width;
    CHECK(std::abs(driver.lab().scene.look.split.position - (0.5 + 100.0 / static_cast<double>(width))) < 0.01);
    CHECK(driver.lab().scene.look.lamp.position == lamp);

    driver.lab().show_lamps = true;
    driver.lab().scene.look.lamp.position = {0.4, 0.9, 0.6}; // in the picture
    driver.settle();
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->ItemDragWithDelta("###Viewport/lamp", {0, -60}); }));
    CHECK(driver.lab().scene.look.lamp.position.y > 0.92);
    CHECK(*driver.lab().scene.camera == camera); // the camera stayed where it was
}

TEST_CASE("A shader's parameters are sliders in the panel Look, with a reset", "[look]") {
    LabDriver driver;
    driver.lab().scene.look.shader = driver.lab().loaded.look.shader = "blinn-phong";
    driver.settle();
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->ItemInputValue("###Look/**/p/##value", "77"); }));
    CHECK(values_of(driver, "blinn-phong").at("p") == scene::ShaderValue(77.0));
    CHECK(ui::modified(driver.lab()));
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->ItemClick("###Look/**/p/" ICON_FA_ROTATE_LEFT "##reset"); }));
    CHECK_FALSE(ui::modified(driver.lab()));
}

TEST_CASE("A picture dropped onto the window becomes the shader's texture and is kept with the scene", "[look]") {
    const TemporaryFolder folder;
    const auto picture = folder / "mine.png", scene_file = folder / "scene.json";
    render::write_png(plain_picture(4, 4, {0, 200, 0}), picture);
    LabDriver driver;
    driver.app().drop(picture);
    driver.settle();
    REQUIRE(driver.lab().messages.size() == 1); // diffuse takes no picture
    CHECK(contains(driver.lab().messages[0].text, "takes no picture"));
    driver.lab().messages.clear();

    driver.lab().scene.look.shader = "texture";
    driver.settle();
    driver.app().drop(picture);
    driver.settle();
    CHECK(values_of(driver, "texture").begin()->second == scene::ShaderValue(picture.string()));
    driver.lab().ask(ui::SaveScene{scene_file});
    driver.settle();
    // Relative in the file, so that both can be moved together; from anywhere in the lab.
    CHECK(scene::load_scene(scene_file).look.shaders.at("texture").begin()->second ==
          scene::ShaderValue(std::string("mine.png")));
    REQUIRE(driver.app().open(scene_file));
    CHECK(values_of(driver, "texture").begin()->second == scene::ShaderValue(picture.string()));

    driver.lab().messages.clear();
    driver.lab().scene.look.shaders["texture"].begin()->second = (folder / "gone.png").string();
    driver.settle();
    REQUIRE(driver.lab().messages.size() == 1);
    CHECK(contains(driver.lab().messages[0].text, "gone.png"));
}

TEST_CASE("A heat map has its colours in the legend and its quantity in the snapshots", "[look]") {
    LabDriver driver;
    CHECK(driver.lab().legend_colours.empty());
    CHECK(driver.lab().snapshot->quantity.empty());
    driver.lab().scene.look.shader = "strain";
    for (int i = 0; i < 3; ++i)
        driver.settle();
    CHECK(driver.lab().legend_colours.size() == 256);
    CHECK(driver.lab().snapshot->quantity_kind == sim::PointQuantity::strain);
    driver.lab().scene.look.shader = "normals";
    for (int i = 0; i < 3; ++i)
        driver.settle();
    CHECK(driver.lab().legend_colours.empty());
    CHECK(driver.lab().snapshot->quantity.empty());
}

TEST_CASE("Values that a shader does not have are told when a scene is opened, and change nothing", "[look]") {
    const TemporaryFolder folder;
    write_file(folder / "s.json", R"({"clothlab": 1, "look": {"shaders": {"diffuse": {"shine": 1}}}})");
    LabDriver driver;
    REQUIRE(driver.app().open(folder / "s.json"));
    REQUIRE(driver.lab().messages.size() == 1);
    CHECK(contains(driver.lab().messages[0].text, "s.json: look.shaders.diffuse.shine"));
}
