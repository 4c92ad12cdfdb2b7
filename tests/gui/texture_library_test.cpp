// Textures in OpenGL as a shader sees them: values, edges, directions, and what stands in for a bad one.
#include <catch2/catch_approx.hpp>

#include "gui/render_fixture.h"
#include "gui/texture_fixture.h"
#include "render/shader_library.h"
#include "render/texture_library.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Approx;
using render::TextureUsage;
namespace fs = std::filesystem;

namespace {

constexpr const char* vertex_text = R"(#version 330 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); })";
constexpr const char* flat_text = R"(#version 330 core
uniform sampler2D picture; uniform vec3 place; uniform float level; out vec4 value;
void main() { value = textureLod(picture, place.xy, level); })";
constexpr const char* cube_text = R"(#version 330 core
uniform samplerCube picture; uniform vec3 place; uniform float level; out vec4 value;
void main() { value = textureLod(picture, place, level); })";

render::Program program_of(const char* fragment_text) {
    render::ProgramHandle program = render::ProgramHandle::create();
    for (const auto& [stage, text] : {std::pair(GL_VERTEX_SHADER, vertex_text), {GL_FRAGMENT_SHADER, fragment_text}}) {
        const render::ShaderHandle shader(glCreateShader(static_cast<GLenum>(stage)));
        glShaderSource(shader.id(), 1, &text, nullptr);
        glCompileShader(shader.id());
        glAttachShader(program.id(), shader.id());
    }
    glLinkProgram(program.id());
    return render::Program(std::move(program));
}

/// A context, a library, and a shader that says what a texture has at a place.
struct Lab {
    GlContext context;
    render::TextureLibrary library;
    render::Program flat = program_of(flat_text), cube = program_of(cube_text);
    render::VertexArray no_vertices = render::VertexArray::create();
    render::Texture target = render::Texture::create();
    render::Framebuffer framebuffer = render::Framebuffer::create();

    Lab() {
        glBindTexture(GL_TEXTURE_2D, target.id());
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 1, 1, 0, GL_RGBA, GL_FLOAT, nullptr);
        glBindTexture(GL_TEXTURE_2D, 0);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.id(), 0);
        glViewport(0, 0, 1, 1);
        glDisable(GL_DEPTH_TEST);
    }
    ~Lab() { CHECK(glGetError() == GL_NO_ERROR); }

    glm::vec4 sample(const render::TextureEntry& entry, const glm::vec3& place, float level = 0) {
        const render::Program& program = entry.target == GL_TEXTURE_2D ? flat : cube;
        program.use();
        program.set("place", place);
        program.set("level", level);
        glBindTexture(entry.target, entry.id());
        glBindVertexArray(no_vertices.id());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glBindTexture(entry.target, 0);
        glm::vec4 value(-1);
        glReadPixels(0, 0, 1, 1, GL_RGBA, GL_FLOAT, &value[0]);
        return value;
    }
    glm::vec4 sample(const std::string& name, TextureUsage usage, const glm::vec3& place, float level = 0) {
        return sample(library.get(name, usage), place, level);
    }
};

bool near(const glm::vec4& value, const glm::vec3& expected, float margin = 0.004f) {
    return glm::all(glm::lessThan(glm::abs(glm::vec3(value) - expected), glm::vec3(margin)));
}

/// Two seconds later, for the file system, than any time before in this test.
void write_later(const fs::path& file, const render::Image& image) {
    static int later = 0;
    render::write_png(image, file);
    fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::seconds(later += 2));
}

} // namespace

TEST_CASE("A colour texture is decoded from sRGB, and smaller levels are means of light", "[texture]") {
    Lab lab;
    const TemporaryFolder folder;
    render::write_png(plain_picture(4, 4, {188, 128, 0}), folder / "grey.png");
    const glm::vec3 expected(render::linear_from_srgb(188 / 255.f), render::linear_from_srgb(128 / 255.f), 0);
    CHECK(near(lab.sample((folder / "grey.png").string(), TextureUsage::colour, {0.4f, 0.6f, 0}), expected, 0.002f));
    // Black and white in equal parts: half the light, not half of 255.
    render::Image halves = plain_picture(2, 2, {255, 255, 255});
    for (std::size_t i = 0; i < 8; ++i)
        halves.rgba[i] = i % 4 == 3 ? 255 : 0;
    render::write_png(halves, folder / "halves.png");
    const glm::vec4 mean = lab.sample((folder / "halves.png").string(), TextureUsage::colour, {0.5f, 0.5f, 0}, 1);
    CHECK(mean.x == Approx(0.5).margin(0.01));
}

TEST_CASE("A picture's upper left corner is at u = 0, v = 1, and it repeats", "[texture]") {
    Lab lab;
    const TemporaryFolder folder;
    render::Image corners{2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}};
    render::write_png(corners, folder / "corners.png");
    const std::string name = (folder / "corners.png").string();
    const auto at = [&](float u, float v) { return lab.sample(name, TextureUsage::colour, {u, v, 0}); };
    CHECK(near(at(0.25f, 0.75f), {1, 0, 0}));
    CHECK(near(at(0.75f, 0.75f), {0, 1, 0}));
    CHECK(near(at(0.25f, 0.25f), {0, 0, 1}));
    CHECK(near(at(1.25f, -0.25f), {1, 0, 0}));
    // As a height map it is in the same place.
    CHECK(lab.sample(name, TextureUsage::height, {0.75f, 0.25f, 0}).x == Approx(1));
    CHECK(lab.sample(name, TextureUsage::height, {0.25f, 0.75f, 0}).x == Approx(0.299).margin(0.005));
}

TEST_CASE("A height map has the values that were made, unrounded", "[texture]") {
    Lab lab;
    const render::GreyImage made = std::get<render::GreyImage (*)()>(render::find_built_in("skin-height")->make)();
    const render::TextureEntry& entry = lab.library.get("skin-height", TextureUsage::height);
    CHECK(entry.width == 512);
    CHECK(entry.height == 512);
    CHECK(entry.error.empty());
    for (const auto& [x, y] : {std::pair(0, 0), {511, 0}, {17, 300}, {400, 401}}) {
        const glm::vec4 value =
            lab.sample(entry, {(static_cast<float>(x) + 0.5f) / 512, 1 - (static_cast<float>(y) + 0.5f) / 512, 0});
        CHECK(value.x == Approx(made.pixel(x, y)).margin(1e-4));
    }
}

TEST_CASE("A ramp ends where it ends", "[texture]") {
    Lab lab;
    const render::TextureEntry& ramp = lab.library.get("blue-orange", TextureUsage::ramp);
    const auto linear = [](unsigned rgb) { return render::linear(render::colour(rgb)); };
    CHECK(near(lab.sample(ramp, {0.5f / 256, 0.5f, 0}), linear(0x053061)));
    CHECK(near(lab.sample(ramp, {-3, 0.5f, 0}), linear(0x053061)));
    CHECK(near(lab.sample(ramp, {0.5f, 0.5f, 0}), linear(0xF7F7F7), 0.02f));
    CHECK(near(lab.sample(ramp, {1.25f, 7, 0}), linear(0x7F3B08)));
}

TEST_CASE("Every direction shows the side of the six colours that it looks at", "[texture]") {
    Lab lab;
    const render::TextureEntry& cube = lab.library.get("six-colours", TextureUsage::environment);
    REQUIRE(cube.target == GL_TEXTURE_CUBE_MAP);
    CHECK(cube.width == 256);
    CHECK(near(lab.sample(cube, {1, 0.3f, -0.2f}), {1, 0, 0}));
    CHECK(near(lab.sample(cube, {-2, 0.3f, -0.2f}), {0, 1, 1}));
    CHECK(near(lab.sample(cube, {0.3f, 1, 0.5f}), {0, 1, 0}));
    CHECK(near(lab.sample(cube, {0.3f, -1, 0.5f}), {1, 0, 1}));
    CHECK(near(lab.sample(cube, {0.1f, -0.4f, 3}), {0, 0, 1}));
    CHECK(near(lab.sample(cube, {0.1f, -0.4f, -3}), {1, 1, 0}));
}

TEST_CASE("Each pixel of a folder of faces is where cube_direction says", "[texture]") {
    Lab lab;
    const TemporaryFolder folder;
    const auto faces = marked_faces();
    write_faces(folder.path(), faces);
    const render::TextureEntry& cube = lab.library.get(folder.path().string(), TextureUsage::environment);
    REQUIRE(cube.error.empty());
    for (int face = 0; face < 6; ++face) {
        for (int y = 0; y < 2; ++y) {
            for (int x = 0; x < 2; ++x) {
                const auto d = render::cube_direction(face, static_cast<float>(x) - 0.5f, static_cast<float>(y) - 0.5f);
                const std::uint8_t* p = faces[static_cast<std::size_t>(face)].pixel(x, y);
                const glm::vec3 expected(render::linear_from_srgb(p[0] / 255.f), render::linear_from_srgb(p[1] / 255.f),
                                         render::linear_from_srgb(p[2] / 255.f));
                CHECK(near(lab.sample(cube, {d[0], d[1], d[2]}), expected));
            }
        }
    }
}

TEST_CASE("HDR stays brighter than white, on a cloth and around it", "[texture]") {
    Lab lab;
    const TemporaryFolder folder;
    write_file(folder / "sun.hdr", hdr_file(1, 1, {{16, 8, 0.5f}}));
    const std::string name = (folder / "sun.hdr").string();
    CHECK(near(lab.sample(name, TextureUsage::colour, {0.5f, 0.5f, 0}), {16, 8, 0.5f}));
    CHECK(near(lab.sample(name, TextureUsage::environment, {0.5f, -0.5f, 0.3f}), {16, 8, 0.5f}, 0.02f));
    CHECK(lab.library.errors().empty());
}

TEST_CASE("Textures of 1 x 1 and 8192 x 16 pixels can be drawn", "[texture]") {
    Lab lab;
    const TemporaryFolder folder;
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(8192, 16)}) {
        const std::string name = (folder / (std::to_string(width) + ".png")).string();
        render::write_png(plain_picture(width, height, {255, 0, 255}), name);
        for (const TextureUsage usage : {TextureUsage::colour, TextureUsage::ramp, TextureUsage::environment})
            CHECK(near(lab.sample(name, usage, {0.3f, 0.7f, 0.1f}), {1, 0, 1}));
        CHECK(lab.sample(name, TextureUsage::height, {0.3f, 0.7f, 0}).x == Approx((0.299 + 0.114)).margin(0.01));
        CHECK(lab.library.get(name, TextureUsage::colour).width == width);
    }
    CHECK(lab.library.errors().empty());
}

TEST_CASE("A texture that cannot be had is a checker of magenta and black, and names its file once", "[texture]") {
    Lab lab;
    const std::string name = "no/such/cloth.png";
    const render::TextureEntry& entry = lab.library.get(name, TextureUsage::colour);
    CHECK(contains(entry.error, name));
    CHECK(contains(entry.error, "bricks"));
    CHECK(near(lab.sample(entry, {0.5f / 16, 0.5f / 16, 0}), {0, 0, 0}));
    CHECK(near(lab.sample(entry, {2.5f / 16, 0.5f / 16, 0}), {1, 0, 1}));
    const GLuint id = entry.id();
    CHECK(lab.library.get(name, TextureUsage::colour).id() == id);

    const render::TextureEntry& around = lab.library.get(name, TextureUsage::environment);
    CHECK(around.target == GL_TEXTURE_CUBE_MAP);
    CHECK(contains(around.error, "sky"));
    CHECK(near(lab.sample(around, {1, 1, 1}), glm::vec3(0.216f), 0.005f));
    CHECK(lab.sample(name, TextureUsage::height, {0.5f, 0.5f, 0}).x == 0);
    CHECK(lab.library.get("", TextureUsage::ramp).id() != 0);

    const TemporaryFolder folder;
    write_file(folder / "bad.jpg", "no picture");
    const std::string bad = (folder / "bad.jpg").string();
    lab.library.get(bad, TextureUsage::colour);
    lab.library.get(bad, TextureUsage::ramp);
    const auto errors = lab.library.errors();
    CHECK(std::count_if(errors.begin(), errors.end(), [&](const std::string& e) { return contains(e, bad); }) == 1);
}

TEST_CASE("A built-in texture asked for in another way is made so, or says why not", "[texture]") {
    Lab lab;
    CHECK(lab.library.get("bricks", TextureUsage::height).error.empty());
    CHECK(lab.library.get("bricks-height", TextureUsage::colour).error.empty());
    CHECK(lab.library.get("viridis", TextureUsage::colour).error.empty());
    CHECK(contains(lab.library.get("bricks", TextureUsage::environment).error, "bricks is for colour"));
    CHECK(contains(lab.library.get("sky", TextureUsage::colour).error, "sky is for environment"));
    CHECK(lab.library.get("sky", TextureUsage::colour).target == GL_TEXTURE_2D);
    CHECK(lab.library.get("bricks", TextureUsage::environment).target == GL_TEXTURE_CUBE_MAP);
}

TEST_CASE("A texture follows its file, and keeps its last good picture when the file goes bad", "[texture]") {
    Lab lab;
    const TemporaryFolder folder;
    const fs::path file = folder / "a.png";
    const std::string name = file.string();
    lab.library.get("white", TextureUsage::colour);
    const render::TextureEntry& entry = lab.library.get(name, TextureUsage::colour);
    CHECK_FALSE(entry.error.empty());
    CHECK_FALSE(lab.library.refresh());
    const auto shown = [&] { return lab.sample(entry, {0.5f, 0.5f, 0}); };

    write_later(file, plain_picture(2, 2, {255, 0, 0}));
    CHECK(lab.library.refresh());
    CHECK(entry.error.empty());
    CHECK(near(shown(), {1, 0, 0}));
    CHECK_FALSE(lab.library.refresh());

    write_later(file, plain_picture(3, 3, {0, 255, 0}));
    CHECK(near(shown(), {1, 0, 0}));
    CHECK(lab.library.refresh());
    CHECK(near(shown(), {0, 1, 0}));
    CHECK(entry.width == 3);

    write_file(file, "half a pict");
    CHECK(lab.library.refresh());
    CHECK(contains(entry.error, name));
    CHECK(near(shown(), {0, 1, 0}));
    fs::remove(file);
    CHECK(lab.library.refresh());
    CHECK_FALSE(lab.library.refresh());
    CHECK(near(shown(), {0, 1, 0}));
    CHECK(lab.library.errors().size() == 1);

    render::write_png(plain_picture(1, 1, {0, 0, 255}), file);
    lab.library.reload(name);
    CHECK(entry.error.empty());
    CHECK(near(shown(), {0, 0, 1}));
    CHECK(lab.library.errors().empty());
}

TEST_CASE("Loading a texture leaves what is bound, and how pixels are sent, as it was", "[texture]") {
    Lab lab;
    const render::Texture flat = render::Texture::create(), cube = render::Texture::create();
    const render::Buffer buffer = render::Buffer::create();
    glActiveTexture(GL_TEXTURE3);
    glBindTexture(GL_TEXTURE_2D, flat.id());
    glBindTexture(GL_TEXTURE_CUBE_MAP, cube.id());
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer.id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 77);
    // Both would be wrong with that row length and buffer.
    const GLuint checker = lab.library.get("checker", TextureUsage::colour).id();
    lab.library.get("six-colours", TextureUsage::environment);
    const auto get = [](GLenum name) {
        GLint value = 0;
        glGetIntegerv(name, &value);
        return static_cast<GLuint>(value);
    };
    CHECK(get(GL_ACTIVE_TEXTURE) == GL_TEXTURE3);
    CHECK(get(GL_TEXTURE_BINDING_2D) == flat.id());
    CHECK(get(GL_TEXTURE_BINDING_CUBE_MAP) == cube.id());
    CHECK(get(GL_PIXEL_UNPACK_BUFFER_BINDING) == buffer.id());
    CHECK(get(GL_UNPACK_ALIGNMENT) == 8);
    CHECK(get(GL_UNPACK_ROW_LENGTH) == 77);
    CHECK(checker != 0);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glActiveTexture(GL_TEXTURE0);
    CHECK(near(lab.sample("checker", TextureUsage::colour, {1.f / 16, 15.f / 16, 0}), {0.027f, 0.034f, 0.051f}));
    CHECK(near(lab.sample("six-colours", TextureUsage::environment, {0, 1, 0}), {0, 1, 0}));
}
