#include "render/renderer.h"

#include <algorithm>
#include <cmath>

#include "render/cloth_mesh.h"
#include "render/collider_mesh.h"
#include "render/projected.h"
#include "render/shader_library.h"

namespace clothlab::render {

namespace {

/// The uniform block Frame of shaders/common/frame.glsl, in its std140 layout.
struct FrameBlock {
    glm::mat4 view, projection;
    glm::vec4 eye;         ///< xyz in m
    glm::vec4 viewport;    ///< width, height in px
    glm::vec4 light;       ///< xyz in m, intensity
    glm::vec4 ambient;     ///< x: light from everywhere, y: from over the left shoulder
    glm::vec4 cloth_depth; ///< x, y: distance from the eye in m at which the cloth begins and ends
};

/// sRGB to linear values (IEC 61966-2-1).
glm::vec3 linear(const glm::vec3& srgb) {
    glm::vec3 result;
    for (int i = 0; i < 3; ++i)
        result[i] = srgb[i] <= 0.04045f ? srgb[i] / 12.92f : std::pow((srgb[i] + 0.055f) / 1.055f, 2.4f);
    return result;
}

/// Everything that the pictures rely on and others may have changed.
void set_state() {
    for (const GLenum off : {GL_SCISSOR_TEST, GL_CULL_FACE, GL_STENCIL_TEST, GL_BLEND, GL_POLYGON_OFFSET_FILL,
                             GL_SAMPLE_ALPHA_TO_COVERAGE, GL_PRIMITIVE_RESTART})
        glDisable(off);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glFrontFace(GL_CCW);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glEnable(GL_DEPTH_TEST);
    glBlendEquation(GL_FUNC_ADD);
    // The picture stays opaque whatever is blended over it.
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

void reset_state() {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_PROGRAM_POINT_SIZE);
    glBindVertexArray(0);
    glUseProgram(0);
    glBindBuffer(GL_UNIFORM_BUFFER, 0);
}

constexpr const char* always_needed[] = {"background", "sphere", "plane", "lines", "pins"};

} // namespace

struct Renderer::Parts {
    explicit Parts(std::filesystem::path folder) : shaders(std::move(folder)) {}

    ShaderLibrary shaders;
    ClothMesh cloth;
    SphereMesh sphere;
    VertexArray no_vertices = VertexArray::create(); ///< for shaders that make their own
    Buffer frame = Buffer::create();

    void load() {
        for (const char* name : always_needed)
            shaders.program(name);
    }
    void set_frame(const Scene& what, const Target& target, const ProjectedCloth& projected);
    void draw_background(const Options& options);
    void draw_springs(const Options& options, bool depth_cue, DrawReport& report);
    void draw_colliders(const Scene& what, DrawReport& report);
    void draw_planes(const Scene& what, DrawReport& report);
    void draw_pins(const Scene& what, DrawReport& report);
};

void Renderer::Parts::set_frame(const Scene& what, const Target& target, const ProjectedCloth& projected) {
    const float width = static_cast<float>(target.width()), height = static_cast<float>(target.height());
    FrameBlock block{};
    block.view = view_matrix(what.view);
    block.projection = projection_matrix(what.view, width / height);
    block.eye = glm::vec4(what.view.eye, 1);
    block.viewport = glm::vec4(width, height, 1 / width, 1 / height);
    block.light = glm::vec4(what.options.light.position, what.options.light.intensity);
    block.ambient = glm::vec4(what.options.ambient, what.options.fill, 0, 0);
    block.cloth_depth = glm::vec4(projected.nearest, projected.furthest, 0, 0);
    glBindBuffer(GL_UNIFORM_BUFFER, frame.id());
    glBufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, ShaderLibrary::frame_binding, frame.id());
}

void Renderer::Parts::draw_background(const Options& options) {
    const Program& program = shaders.program("background");
    program.use();
    program.set("top", linear(options.background_top));
    program.set("bottom", linear(options.background_bottom));
    glDisable(GL_DEPTH_TEST);
    glBindVertexArray(no_vertices.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
}

void Renderer::Parts::draw_springs(const Options& options, bool depth_cue, DrawReport& report) {
    const Program& program = shaders.program("lines");
    program.use();
    program.set("width", report.line_width);
    program.set("depth_cue", depth_cue ? 0.45f : 0.f);
    program.set("background", linear((options.background_top + options.background_bottom) * 0.5f));
    // Bending springs run beside the structural ones that they span, so that both are seen, and under all others.
    struct Look {
        sim::SpringKind kind;
        float shift, depth;
    };
    for (const auto& [kind, shift, depth] :
         {Look{sim::SpringKind::bending, 0.065f, 0.9985f}, Look{sim::SpringKind::shear, 0, 0.998f},
          Look{sim::SpringKind::structural, 0, 0.9975f}}) {
        const auto k = static_cast<std::size_t>(kind);
        if (!options.show_springs[k])
            continue;
        program.set("colour", linear(spring_colours[k]));
        program.set("shift", shift);
        program.set("depth", depth);
        report.springs[k] = cloth.draw_springs(kind);
    }
}

void Renderer::Parts::draw_colliders(const Scene& what, DrawReport& report) {
    sphere.set_lines(what.options.sphere_lat_lines, what.options.sphere_lon_lines);
    const Program& program = shaders.program("sphere");
    program.use();
    program.set("colour", linear(what.options.sphere_colour));
    for (const sim::Collider& collider : what.colliders) {
        const auto* given = std::get_if<sim::Sphere>(&collider);
        const auto drawn = given != nullptr ? drawable_sphere(*given) : std::nullopt;
        if (!drawn)
            continue;
        program.set("sphere", *drawn);
        sphere.draw();
        ++report.spheres;
    }
}

void Renderer::Parts::draw_planes(const Scene& what, DrawReport& report) {
    const Program& program = shaders.program("plane");
    program.use();
    glEnable(GL_BLEND);
    glBindVertexArray(no_vertices.id());
    for (const sim::Collider& collider : what.colliders) {
        const auto* given = std::get_if<sim::Plane>(&collider);
        const auto patch = given != nullptr ? plane_patch(*given, what.view) : std::nullopt;
        if (!patch)
            continue;
        program.set("centre", patch->centre);
        program.set("origin", patch->origin);
        program.set("axis_u", patch->u);
        program.set("axis_v", patch->v);
        program.set("plane_normal", patch->normal);
        program.set("radius", patch->radius);
        program.set("opacity", patch->see_through ? 0.35f : 1.f);
        glDepthMask(patch->see_through ? GL_FALSE : GL_TRUE);
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
        ++report.planes;
    }
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

void Renderer::Parts::draw_pins(const Scene& what, DrawReport& report) {
    const Program& program = shaders.program("pins");
    program.use();
    program.set("size", std::max(1.f, what.options.pin_size));
    program.set("colour", linear(pin_colour));
    glEnable(GL_BLEND);
    glEnable(GL_PROGRAM_POINT_SIZE);
    report.pins = cloth.draw_points(what.pinned);
    glDisable(GL_PROGRAM_POINT_SIZE);
    glDisable(GL_BLEND);
}

Renderer::Renderer(std::filesystem::path shader_folder) {
    require_gl();
    parts_ = std::make_unique<Parts>(std::move(shader_folder));
    parts_->load();
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

const std::filesystem::path& Renderer::shader_folder() const {
    return parts_->shaders.folder();
}

void Renderer::reload_shaders() {
    ShaderLibrary fresh(parts_->shaders.folder());
    for (const char* name : always_needed)
        fresh.program(name);
    parts_->shaders = std::move(fresh);
}

DrawReport Renderer::draw(const Scene& what, Target& target) {
    Parts& parts = *parts_;
    const Options& options = what.options;
    const bool wireframe = options.shader == wireframe_shader;
    const Program* surface = wireframe ? nullptr : &parts.shaders.surface(options.shader);

    if (what.snapshot != nullptr)
        parts.cloth.update(*what.snapshot);
    else
        parts.cloth.clear();
    const ProjectedCloth projected =
        project(what.snapshot, parts.cloth.drawn(), what.view, target.width(), target.height());
    DrawReport report;
    report.width = target.width();
    report.height = target.height();
    report.cloth_box = {projected.min_x, projected.min_y, projected.max_x, projected.max_y};
    report.points_in_view = projected.inside;
    report.points_not_drawable = parts.cloth.not_drawable();
    // A ninth of a cell at most: a fine grid would else be one plain of colour.
    report.line_width = std::max(0.1f, options.line_width);
    if (projected.cell > 0)
        report.line_width = std::min(report.line_width, std::max(0.5f, projected.cell / 9));

    target.bind();
    set_state();
    glClearDepth(1);
    glClear(GL_DEPTH_BUFFER_BIT);
    parts.set_frame(what, target, projected);
    parts.draw_background(options);
    if (surface != nullptr) {
        surface->use();
        // Darker under springs, or these would not stand out.
        const float shade = options.springs_over_surface ? 0.5f : 1.f;
        const glm::vec3 front = linear(options.cloth_colour) * shade, back = linear(options.back_colour) * shade;
        surface->set("front_colour", options.swap_sides ? back : front);
        surface->set("back_colour", options.swap_sides ? front : back);
        report.cloth_triangles = parts.cloth.draw_surface();
    }
    if (options.show_colliders)
        parts.draw_colliders(what, report);
    if (wireframe || options.springs_over_surface)
        parts.draw_springs(options, wireframe, report);
    if (options.show_colliders)
        parts.draw_planes(what, report);
    if (options.show_pins)
        parts.draw_pins(what, report);
    reset_state();
    target.resolve();
    return report;
}

} // namespace clothlab::render
