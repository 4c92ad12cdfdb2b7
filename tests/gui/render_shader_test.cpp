// Shader files: what a folder offers, how includes are put in, and how a mistake is reported.
#include <algorithm>

#include "gui/render_fixture.h"

using namespace clothlab;
using namespace clothlab::test;

TEST_CASE("Shaders are the files of a folder", "[shaders]") {
    const std::vector<std::string> shipped = render::list_surface_shaders(shader_folder);
    CHECK(std::find(shipped.begin(), shipped.end(), "diffuse") != shipped.end());
    CHECK(std::find(shipped.begin(), shipped.end(), "wireframe") != shipped.end());
    CHECK(render::list_surface_shaders("/no/such/folder").empty());
}

TEST_CASE("Includes are put in once, with the lines they came from", "[shaders]") {
    const TemporaryFolder folder;
    write_file(folder / "main.frag", "#version 330 core\n#include \"a.glsl\"\n#include \"b.glsl\"\nend\n");
    write_file(folder / "a.glsl", "#include \"b.glsl\"\nin a"); // no newline at the end
    write_file(folder / "b.glsl", "in b\r\n");
    const render::ShaderSource source = render::read_shader(folder.path(), "main.frag");
    CHECK(source.text == "#version 330 core\nin b\nin a\nend\n");
    const std::pair<const char*, int> origins[] = {{"main.frag", 1}, {"b.glsl", 1}, {"a.glsl", 2}, {"main.frag", 4}};
    REQUIRE(source.lines.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(source.files[source.lines[i].file] == folder / origins[i].first);
        CHECK(source.lines[i].number == origins[i].second);
    }

    write_file(folder / "a.glsl", "\n#include \"c.glsl\"\n");
    try {
        render::read_shader(folder.path(), "main.frag");
        FAIL("no error");
    } catch (const render::ShaderError& error) {
        CHECK(error.file() == folder / "a.glsl");
        CHECK(error.line() == 2);
        CHECK(std::string(error.what()).find("c.glsl") != std::string::npos);
    }
}

TEST_CASE("The messages of every driver are understood", "[shaders]") {
    render::ShaderSource source{"", {}, {"x/main.frag", "x/light.glsl"}};
    for (int i = 1; i <= 20; ++i)
        source.lines.push_back({i > 10 ? 1u : 0u, i});
    for (const char* log : {"0:12(5): error: `foo' undeclared", "0(12) : error C1008: undefined variable \"foo\"",
                            "ERROR: 0:12: 'foo' : undeclared identifier"}) {
        const render::ShaderMessage message = render::locate(source, log);
        CHECK(message.faults.front().file == "x/light.glsl");
        CHECK(message.faults.front().line == 12);
        CHECK(message.text.find("x/light.glsl:12") != std::string::npos);
        CHECK(message.text.find("foo") != std::string::npos);
    }
    CHECK(render::locate(source, "it went wrong").faults.front().file == "x/main.frag");
    CHECK(render::locate(source, "it went wrong").faults.front().line == 0);
    CHECK(render::locate(source, "0:3(1): warning: unused\n0:4(1): error: bad").faults.front().line == 4);
}

TEST_CASE("A broken shader is reported with its file and line, and nothing is drawn", "[render]") {
    Studio studio;
    const TemporaryFolder folder;
    std::filesystem::copy(shader_folder, folder.path(), std::filesystem::copy_options::recursive);
    render::Renderer renderer(folder.path());
    const sim::Snapshot cloth = flat_cloth(4, 4);
    render::Scene scene = scene_of(cloth);
    renderer.draw(scene, studio.target);
    const render::Image before = studio.target.read();

    const auto error_of = [&](const std::string& name) {
        scene.options.surface.shader = name;
        try {
            renderer.draw(scene, studio.target);
        } catch (const render::ShaderError& error) {
            CHECK(glGetError() == GL_NO_ERROR);
            CHECK(studio.target.read() == before);
            return error;
        }
        FAIL("no error for " << name);
        throw 0;
    };
    const std::string start = "#version 330 core\n#include \"common/frame.glsl\"\n#include \"common/cloth.glsl\"\n";
    write_file(folder / "cloth/typo.frag", start + "void main() {\n    pixel = vec4(seen_color(), 1.0);\n}\n");
    const render::ShaderError typo = error_of("typo");
    CHECK(typo.line() == 5);
    CHECK(typo.file() == folder / "cloth/typo.frag");
    CHECK(std::string(typo.what()).find("typo.frag:5") != std::string::npos);
    CHECK(std::string(typo.what()).find("seen_color") != std::string::npos);

    write_file(folder / "common/wrong.glsl", "float fine() { return 1.0; }\nfloat wrong() { return nothing; }\n");
    write_file(folder / "cloth/inner.frag",
               start + "#include \"common/wrong.glsl\"\nvoid main() { pixel = vec4(wrong()); }\n");
    const render::ShaderError inner = error_of("inner");
    CHECK(inner.line() == 2);
    CHECK(inner.file() == folder / "common/wrong.glsl");

    const std::string unknown = error_of("no-such").what();
    CHECK(unknown.find("no-such") != std::string::npos);
    for (const char* name : {"diffuse, ", "inner, ", "typo, "})
        CHECK(unknown.find(name) != std::string::npos);
    error_of("../cloth/diffuse");

    // A shader of two files, mended while the renderer lives.
    write_file(folder / "cloth/typo.frag", start + "void main() { pixel = vec4(1.0, 0.0, 1.0, 1.0); }\n");
    scene.options.surface.shader = "typo";
    renderer.draw(scene, studio.target);
    CHECK(studio.target.read().pixel(80, 45)[0] == 255);

    write_file(folder / "cloth/wireframe.geom", "#version 330 core\nnonsense\n");
    renderer.reload_shaders();
    renderer.draw(scene, studio.target); // with the one that there was
    CHECK_THROWS_AS(render::Renderer(folder.path()), render::ShaderError);
    CHECK_THROWS_AS(render::Renderer(folder / "missing"), render::ShaderError);
}
