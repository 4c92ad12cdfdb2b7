// Every shader that clothlab comes with: its declaration, its sliders, and that it draws whatever it is given.
#include <set>

#include "app/core/data_folder.h"
#include "gui/shading.h"
#include "render/procedural.h"
#include "render/shader_library.h"
#include "scene/io.h"
#include "sim/simulation.h"

using namespace clothlab;
using namespace clothlab::test;

TEST_CASE("Every shader is there, its declaration is right, and every parameter does something", "[shading]") {
    const GlContext context;
    render::ShaderLibrary library(shader_folder);
    const std::vector<scene::ShaderDeclaration> shaders = app::read_shader_list({shader_folder});
    std::set<std::string> names;
    for (const scene::ShaderDeclaration& shader : shaders) {
        INFO(shader.name << ": " << shader.error);
        names.insert(shader.name);
        CHECK(shader.error.empty());
        CHECK(shader.title != shader.name);
        CHECK(shader.help.ends_with('.'));
        CHECK((shader.quantity.empty() || sim::find_point_quantity(shader.quantity)));
        CHECK(shader.quantity.empty() == !shader.legend);
        const render::Program& program = library.surface(shader.name);
        for (const scene::ShaderParameter& p : shader.parameters) {
            INFO(p.name);
            // A driver leaves out uniforms that have no influence.
            CHECK(glGetUniformLocation(program.id(), p.name.c_str()) >= 0);
            CHECK(p.label != p.name);
            CHECK(p.help.ends_with('.'));
            if (p.type == scene::ShaderParameterType::number || p.type == scene::ShaderParameterType::integer) {
                const double value = std::get<double>(p.value);
                CHECK((value >= p.min && value <= p.max));
            }
            if (p.type == scene::ShaderParameterType::texture) {
                const render::BuiltInTexture* texture = render::find_built_in(std::get<std::string>(p.value));
                REQUIRE(texture);
                CHECK(static_cast<int>(texture->usage) == static_cast<int>(p.usage));
            }
        }
    }
    CHECK(names == std::set<std::string>{"blinn-phong", "bump", "curvature", "diffuse", "displacement", "distance",
                                         "gap", "mirror", "normals", "speed", "strain", "texture", "toon",
                                         "translucent", "wireframe", "wireframe-strain"});
}

TEST_CASE("The documentation shows every shader in a picture, and its example of one's own works", "[shading]") {
    const std::string text = read_file(checkout() / "docs/shaders.md");
    for (const std::string& name : render::list_surface_shaders(shader_folder)) {
        INFO(name);
        const std::string picture = "pictures/shaders/" + name + ".png";
        CHECK(text.find("](" + picture + ")") != std::string::npos);
        CHECK(text.find("--shader " + name + " ") != std::string::npos);
        CHECK(std::filesystem::exists(checkout() / "docs" / picture));
    }
    const std::size_t begin = text.find("    #version 330 core"), end = text.find("**Declarations**");
    REQUIRE(begin < end);
    const TemporaryFolder folder;
    std::filesystem::copy(shader_folder, folder / "shaders", std::filesystem::copy_options::recursive);
    write_file(folder / "shaders/cloth/example.frag", text.substr(begin, end - begin));
    const std::vector<scene::ShaderDeclaration> shaders = app::read_shader_list(folder / "shaders");
    const scene::ShaderDeclaration& example = app::find_shader(shaders, "example");
    CHECK(example.error.empty());
    CHECK(example.find("count"));
    const GlContext context;
    render::ShaderLibrary library(folder / "shaders");
    CHECK(glGetUniformLocation(library.surface("example").id(), "count") >= 0);
}

TEST_CASE("Every shader draws every shipped scene, its spheres too, at any size", "[shading]") {
    Studio studio;
    const std::vector<scene::ShaderDeclaration> shaders = app::read_shader_list({shader_folder});
    for (const std::filesystem::path& file : app::shipped_scenes()) {
        INFO(file);
        scene::Scene scene = scene::load_scene(file);
        scene.look.sphere = scene::SphereLook::cloth;
        const auto simulation = sim::Simulation::create(scene.simulation);
        for (int step = 0; step < 3; ++step)
            simulation->step();
        for (const scene::ShaderDeclaration& shader : shaders) {
            INFO(shader.name);
            scene.look.shader = shader.name;
            sim::Snapshot snapshot;
            simulation->capture(snapshot, app::extras_of(scene.look, shaders));
            CHECK(snapshot.quantity.empty() == shader.quantity.empty());
            for (const int size : {1, 48}) {
                studio.target.resize(size, size);
                scene.look.shadow = size > 1;
                const render::Image image =
                    studio.draw(app::to_render(scene, shaders, &snapshot, 1)); // checks OpenGL's errors
                CHECK((shader.lines || studio.report.cloth_triangles > 0));
                if (size > 1) { // something is seen
                    const std::uint8_t* corner = image.pixel(0, size / 2);
                    int seen = 0;
                    for (int x = 0; x < size; ++x)
                        for (int y = 0; y < size; ++y)
                            seen += std::abs(image.pixel(x, y)[0] - corner[0]) > 8 ? 1 : 0;
                    CHECK(seen > 10);
                }
            }
        }
    }
    CHECK(studio.renderer.texture_errors().empty());
}
