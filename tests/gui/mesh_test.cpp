// What a mesh gives to its shaders: tangents and the point quantity.
#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch_approx.hpp>

#include "gui/render_fixture.h"
#include "render/cloth_normals.h"
#include "render/collider_mesh.h"
#include "render/shader_library.h"

using namespace clothlab;
using namespace clothlab::test;
using Catch::Approx;

namespace {

/// The shipped shaders and one more cloth shader: its colour is what the body of its main() makes of the attributes.
void add_shader(const std::filesystem::path& folder, const std::string& name, const std::string& colour) {
    std::filesystem::copy(shader_folder, folder, std::filesystem::copy_options::recursive);
    write_file(folder / "cloth" / (name + ".vert"),
               "#version 330 core\n#include \"common/frame.glsl\"\n"
               "in vec3 position; in vec3 normal; in vec2 uv; in vec3 tangent; in float quantity;\n"
               "out vec3 colour;\n"
               "void main() { colour = " +
                   colour + "; gl_Position = to_clip(position, 1.0); }\n");
    write_file(folder / "cloth" / (name + ".frag"),
               "#version 330 core\nin vec3 colour; out vec4 pixel;\nvoid main() { pixel = vec4(colour, 1.0); }\n");
}

/// A linear value as the picture has it.
double as_srgb(double linear) {
    return 255 * (1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

} // namespace

TEST_CASE("A cloth shader gets the tangent d position / d u and the point quantity", "[mesh]") {
    Studio studio;
    const TemporaryFolder folder;
    add_shader(folder / "shaders", "attributes", "vec3(0.5 * tangent.x, 0.25 + tangent.z, quantity)");
    studio.renderer = render::Renderer(folder / "shaders");
    sim::Snapshot cloth = flat_cloth(5, 4);
    cloth.quantity.assign(20, 0.75f);
    render::Scene scene = scene_of(cloth);
    scene.options.surface.shader = "attributes";

    const render::Image with = studio.draw(scene);
    CHECK(with.pixel(80, 45)[0] == Approx(as_srgb(0.5)).margin(1)); // the cloth is 1 m wide, u goes from 0 to 1
    CHECK(with.pixel(80, 45)[1] == Approx(as_srgb(0.25)).margin(1));
    CHECK(with.pixel(80, 45)[2] == Approx(as_srgb(0.75)).margin(1));

    cloth.quantity.clear();
    CHECK(studio.draw(scene).pixel(80, 45)[2] == 0);
}

TEST_CASE("A sphere shader gets the unit tangents of its circles of latitude", "[mesh]") {
    const GlContext context;
    render::SphereMesh sphere;
    sphere.set_lines(6, 8);
    // The vertices as they lie in the buffer that the mesh draws from.
    const std::size_t count = std::size_t{7} * 9;
    std::vector<float> at(8 * count);
    sphere.draw();
    GLint buffer = 0;
    glGetVertexAttribiv(render::ShaderLibrary::tangent, GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, static_cast<GLuint>(buffer));
    glGetBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(at.size() * sizeof(float)), at.data());
    for (std::size_t i = 0; i < count; ++i) {
        const float* v = &at[8 * i];
        const glm::vec3 p(v[0], v[1], v[2]), tangent(v[5], v[6], v[7]);
        CHECK(glm::dot(p, tangent) == Approx(0).margin(1e-5));
        CHECK(tangent.y == 0);
        const bool pole = i < 9 || i >= count - 9;
        const double ring = pole ? std::sin(std::numbers::pi / 12) : std::hypot(p.x, p.z);
        CHECK(glm::length(tangent) == Approx(2 * std::numbers::pi * ring));
        // To the east, so that v grows along cross(tangent, normal), as it does on the cloth.
        if (!pole)
            CHECK(glm::cross(tangent, p).y < 0);
    }
    CHECK(glGetError() == GL_NO_ERROR);
}

TEST_CASE("Tangents are the derivative along the columns", "[mesh]") {
    constexpr int columns = 41, rows = 3;
    sim::Snapshot cloth = flat_cloth(columns, rows);
    for (std::size_t i = 0; i < cloth.positions.size(); i += 3) {
        const float u = cloth.positions[i] + 0.5f;
        cloth.positions[i] = u * u;
        cloth.positions[i + 1] = 3 * u;
    }
    std::vector<float> tangents(cloth.positions.size());
    render::cloth_tangents(columns, rows, cloth.positions, {}, tangents);
    for (std::size_t i = 0; i < tangents.size() / 3; ++i) {
        const auto column = static_cast<double>(i % columns);
        // Central differences of a parabola are exact, one-sided ones those of half a column further in.
        const double at = column == 0 ? 0.5 : column == columns - 1 ? columns - 1.5 : column;
        CHECK(tangents[3 * i] == Approx(2 * at / (columns - 1)).margin(1e-4));
        CHECK(tangents[3 * i + 1] == Approx(3).margin(1e-4));
        CHECK(tangents[3 * i + 2] == 0);
    }
}

TEST_CASE("Tangents beside a point that cannot be drawn are one-sided, and 0 where there is no side", "[mesh]") {
    sim::Snapshot cloth = flat_cloth(4, 2);
    cloth.positions[3 * 1] = std::numeric_limits<float>::infinity();
    std::vector<std::uint8_t> usable;
    REQUIRE(render::find_drawable(cloth.positions, usable) == 1);
    std::vector<float> tangents(cloth.positions.size());
    render::cloth_tangents(4, 2, cloth.positions, usable, tangents);
    CHECK(tangents[0] == 0);                 // its only neighbour is missing
    CHECK(tangents[3 * 1] == 0);             // it is missing itself
    CHECK(tangents[3 * 2] == Approx(1));     // one-sided
    CHECK(tangents[3 * 4 + 0] == Approx(1)); // the other row has all points
}
