#include "render/renderer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/cloth_mesh.h"
#include "render/collider_mesh.h"
#include "render/ghost.h"
#include "render/gl_state.h"
#include "render/projected.h"
#include "render/shader_library.h"
#include "render/shadow.h"
#include "render/sorted_triangles.h"
#include "render/texture_library.h"

namespace clothlab::render {
namespace {

/// The uniform block Frame of shaders/common/frame.glsl, in its std140 layout.
struct FrameBlock {
    glm::mat4 view, projection;
    glm::vec4 eye;                   ///< xyz in m; w: 1
    glm::vec4 viewport;              ///< width, height in px
    std::array<glm::vec4, 2> lights; ///< xyz in m, intensity
    glm::vec4 ambient;               ///< x: light from everywhere, y: from over the left shoulder
    glm::vec4 cloth_depth;           ///< x, y: distance from the eye in m at which the cloth begins and ends
    glm::mat4 to_shadow;             ///< world to the shadow map
    glm::vec4 shadow;                ///< x: 1 with a shadow; y: ShadowView::ahead; z: a texel's share of the map
};

/// The texture unit of a surface shader's first texture; those below are for what all shaders share.
constexpr int first_surface_unit = 1;

/// A shader of lines draws springs, of which a sphere has none.
bool spheres_like_cloth(const Options& options, const Surface& surface) {
    return options.spheres_like_cloth && !surface.lines;
}

constexpr const char* always_needed[] = {"background", "sphere", "plane", "pins", "arrows", "ghost"};

} // namespace

struct Renderer::Parts {
    explicit Parts(ShaderFolders folders) : shaders(std::move(folders)) {}

    ShaderLibrary shaders;
    TextureLibrary textures;
    ClothMesh cloth;
    SortedTriangles sorted;
    Arrows arrows;
    Ghost ghost;
    SphereMesh sphere, caster;                       ///< that is drawn, and that casts a shadow
    VertexArray no_vertices = VertexArray::create(); ///< for shaders that make their own
    Buffer frame = Buffer::create();
    FrameBlock block; ///< what `frame` has while a picture is drawn
    ShadowMap shadow_map;
    std::optional<ShadowView> shadow; ///< that the first light casts in this picture

    void load() {
        for (const char* name : always_needed)
            shaders.program(name);
        shaders.surface(wireframe_shader);
    }
    void set_frame(const Scene& what, const Target& target, const ProjectedCloth& projected);
    void set_shadow(const Scene& what);
    void upload(const FrameBlock& values);
    void cast_shadow(const Scene& what, const Surface& surface);
    void draw_background(const Options& options);
    void draw_part(const Scene& what, const Surface& surface, DrawReport& report);
    void use(const Program& program, const Options& options, const std::vector<Uniform>& uniforms);
    void draw_cloth(const Scene& what, const Surface& surface, DrawReport& report);
    void draw_depth(const Options& options, const Surface& surface);
    void draw_springs(const Options& options, const Program& program, const Program* surface, DrawReport& report);
    void draw_spheres(const Scene& what, const Surface& surface, DrawReport& report);
    void draw_planes(const Scene& what, DrawReport& report);
    void draw_plane(const Program& program, const PlanePatch& patch);
    void draw_pins(const Scene& what, DrawReport& report);
};

void Renderer::Parts::set_frame(const Scene& what, const Target& target, const ProjectedCloth& projected) {
    const float width = static_cast<float>(target.width()), height = static_cast<float>(target.height());
    block = {};
    block.view = view_matrix(what.view);
    block.projection = projection_matrix(what.view, width / height);
    block.eye = seen_from(what.view);
    block.viewport = glm::vec4(width, height, 1 / width, 1 / height);
    for (std::size_t i = 0; i < block.lights.size(); ++i)
        block.lights[i] = glm::vec4(what.options.lights[i].position, what.options.lights[i].intensity);
    block.ambient = glm::vec4(what.options.ambient, what.options.fill, 0, 0);
    block.cloth_depth = glm::vec4(projected.nearest, projected.furthest, 0, 0);
    if (shadow) {
        block.to_shadow = clip_to_map() * shadow->projection * shadow->view;
        block.shadow = glm::vec4(1, shadow->ahead, 1 / static_cast<float>(shadow_map.size()), 0);
    }
    upload(block);
}

void Renderer::Parts::upload(const FrameBlock& values) {
    glBindBuffer(GL_UNIFORM_BUFFER, frame.id());
    glBufferData(GL_UNIFORM_BUFFER, sizeof values, &values, GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, ShaderLibrary::frame_binding, frame.id());
}

/// Whether there is a shadow, and from where.
void Renderer::Parts::set_shadow(const Scene& what) {
    shadow.reset();
    const Light& light = what.options.lights[0];
    if (!what.options.shadow || !(light.intensity > 0) || !drawable(light.position))
        return;
    const auto colliders = what.options.show_colliders ? what.colliders : std::span<const sim::Collider>();
    if (const auto box = shadow_casters(what.snapshot, cloth.drawn(), colliders))
        shadow = shadow_view(light.position, *box, shadow_map.size());
}

/// Draws cloth and spheres as the light sees them, with the programs that draw them in the picture: these may move
/// points. Springs alone cast no shadow.
void Renderer::Parts::cast_shadow(const Scene& what, const Surface& surface) {
    FrameBlock of_light = block;
    of_light.view = shadow->view;
    of_light.projection = shadow->projection;
    of_light.eye = glm::vec4(what.options.lights[0].position, 1);
    of_light.shadow = glm::vec4(0);
    upload(of_light);
    shadow_map.begin();
    if (!surface.lines) {
        use(shaders.surface(surface.shader), what.options, surface.uniforms);
        cloth.draw_surface();
    }
    if (what.options.show_colliders) {
        const Program& program = shaders.program("sphere");
        program.use();
        program.set("depth", 1.f);
        // Within the sphere that is drawn, however coarse, lest it shade its own facets.
        caster.set_lines(40, 40);
        const auto within = [](int lines) {
            return std::cos(std::numbers::pi_v<float> / static_cast<float>(std::max(3, lines)));
        };
        const float size = 0.98f * within(surface.sphere_lat_lines) * within(surface.sphere_lon_lines);
        for (const sim::Collider& collider : what.colliders)
            if (const auto* given = std::get_if<sim::Sphere>(&collider))
                if (const auto drawn = drawable_sphere(*given)) {
                    program.set("object", glm::vec4(glm::vec3(*drawn), size * drawn->w));
                    caster.draw();
                }
    }
    shadow_map.end();
    upload(block);
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

/// Takes a program of a surface into use, with its own parameters and what every surface is told.
void Renderer::Parts::use(const Program& program, const Options& options, const std::vector<Uniform>& uniforms) {
    program.use();
    int unit = first_surface_unit;
    for (const Uniform& uniform : uniforms) {
        const char* name = uniform.name.c_str();
        if (const auto* number = std::get_if<float>(&uniform.value))
            program.set(name, *number);
        else if (const auto* integer = std::get_if<int>(&uniform.value))
            program.set(name, *integer);
        else if (const auto* flag = std::get_if<bool>(&uniform.value))
            program.set(name, *flag ? 1 : 0);
        else if (const auto* vector = std::get_if<glm::vec3>(&uniform.value))
            program.set(name, *vector);
        else if (const auto* texture = std::get_if<TextureName>(&uniform.value)) {
            const TextureEntry& entry = textures.get(texture->name, texture->usage);
            glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
            glBindTexture(entry.target, entry.id());
            program.set(name, unit++);
        }
    }
    glActiveTexture(GL_TEXTURE0);
    program.set("shadow_map", ShadowMap::unit);
    program.set("object", glm::vec4(0, 0, 0, 1));
    program.set("depth", 1.f);
    program.set("swap_sides", options.swap_sides ? 1 : 0);
    // Darker under springs, or these would not stand out.
    program.set("shade", options.springs_over_surface ? 0.5f : 1.f);
}

void Renderer::Parts::draw_springs(const Options& options, const Program& program, const Program* surface,
                                   DrawReport& report) {
    program.set("width", report.line_width);
    program.set("depth_cue", surface == nullptr ? 0.45f : 0.f);
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

void Renderer::Parts::draw_cloth(const Scene& what, const Surface& surface, DrawReport& report) {
    const Options& options = what.options;
    const Program& program = shaders.surface(surface.shader);
    cloth.use_quantity(surface.second_quantity);
    if (!surface.lines) {
        use(program, options, surface.uniforms);
        if (surface.translucent) {
            glEnable(GL_BLEND);
            glDepthMask(GL_FALSE);
            report.cloth_triangles = sorted.draw(cloth, *what.snapshot, what.view);
            glDepthMask(GL_TRUE);
            glDisable(GL_BLEND);
        } else {
            report.cloth_triangles = cloth.draw_surface();
        }
    }
    if (!surface.lines && !options.springs_over_surface)
        return;
    const Program& lines = surface.lines ? program : shaders.surface(wireframe_shader);
    use(lines, options, surface.lines ? surface.uniforms : std::vector<Uniform>{});
    draw_springs(options, lines, surface.lines ? nullptr : &program, report);
}

/// The cloth in the depth buffer alone.
void Renderer::Parts::draw_depth(const Options& options, const Surface& surface) {
    use(shaders.surface(surface.shader), options, surface.uniforms);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    cloth.draw_surface();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void Renderer::Parts::draw_spheres(const Scene& what, const Surface& surface, DrawReport& report) {
    const Options& options = what.options;
    sphere.set_lines(surface.sphere_lat_lines, surface.sphere_lon_lines);
    const bool like_cloth = spheres_like_cloth(options, surface);
    const Program& program = like_cloth ? shaders.surface(surface.shader) : shaders.program("sphere");
    if (like_cloth)
        use(program, options, surface.uniforms);
    else
        program.use();
    program.set("shadow_map", ShadowMap::unit);
    program.set("colour", linear(options.sphere_colour));
    program.set("swap_sides", 0);
    program.set("shade", 1.f);
    // A little smaller and further away than it is: cloth that lies on it cuts through it between its points, and must
    // hide it, at its outline too.
    program.set("depth", 1.004f);
    for (const sim::Collider& collider : what.colliders) {
        const auto* given = std::get_if<sim::Sphere>(&collider);
        const auto drawn = given != nullptr ? drawable_sphere(*given) : std::nullopt;
        if (!drawn)
            continue;
        program.set("object", glm::vec4(glm::vec3(*drawn), 0.99f * drawn->w));
        if (like_cloth && surface.translucent) { // its far side first
            glEnable(GL_BLEND);
            glEnable(GL_CULL_FACE);
            for (const GLenum away : {GL_FRONT, GL_BACK}) {
                glCullFace(away);
                sphere.draw();
            }
            glDisable(GL_CULL_FACE);
            glDisable(GL_BLEND);
        } else {
            sphere.draw();
        }
        ++report.spheres;
    }
}

void Renderer::Parts::draw_plane(const Program& program, const PlanePatch& patch) {
    program.set("centre", patch.centre);
    program.set("origin", patch.origin);
    program.set("axis_u", patch.u);
    program.set("axis_v", patch.v);
    program.set("plane_normal", patch.normal);
    program.set("radius", patch.radius);
    program.set("opacity", patch.see_through ? 0.35f : 1.f);
    glDepthMask(patch.see_through ? GL_FALSE : GL_TRUE);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void Renderer::Parts::draw_planes(const Scene& what, DrawReport& report) {
    const Program& program = shaders.program("plane");
    program.use();
    glEnable(GL_BLEND);
    glBindVertexArray(no_vertices.id());
    program.set("shadow_map", ShadowMap::unit);
    program.set("lines_only", 0);
    for (const sim::Collider& collider : what.colliders) {
        const auto* given = std::get_if<sim::Plane>(&collider);
        const auto patch = given != nullptr ? plane_patch(*given, what.view) : std::nullopt;
        if (!patch || !what.options.show_colliders)
            continue;
        draw_plane(program, *patch);
        ++report.planes;
    }
    if (what.options.ground_grid) {
        program.set("lines_only", 1);
        if (auto ground = plane_patch(sim::Plane{{0, 0, 0}, {0, 1, 0}, 0}, what.view)) {
            ground->see_through = false;
            draw_plane(program, *ground);
        }
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

Renderer::Renderer(ShaderFolders shaders) {
    require_gl();
    parts_ = std::make_unique<Parts>(std::move(shaders));
    parts_->load();
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

std::vector<std::string> Renderer::texture_errors() const {
    return parts_->textures.errors();
}

bool Renderer::refresh_textures() {
    return parts_->textures.refresh();
}

const ShaderFolders& Renderer::shader_folders() const {
    return parts_->shaders.folders();
}

void Renderer::reload_shaders() {
    parts_->shaders.reload();
}

void Renderer::reload_shaders(std::map<std::filesystem::path, std::string> edited) {
    parts_->shaders.reload(std::move(edited));
}

std::vector<ShaderError> Renderer::shader_errors() const {
    return parts_->shaders.errors();
}

/// One part of a split view, or the whole picture.
void Renderer::Parts::draw_part(const Scene& what, const Surface& surface, DrawReport& report) {
    if (shadow)
        cast_shadow(what, surface);
    draw_background(what.options);
    const bool cloth_last = surface.translucent;
    if (!cloth_last)
        draw_cloth(what, surface, report);
    const bool planes_first = cloth_last && spheres_like_cloth(what.options, surface); // they shine through spheres
    if (planes_first)
        draw_planes(what, report);
    if (what.options.show_colliders)
        draw_spheres(what, surface, report);
    if (!planes_first)
        draw_planes(what, report);
    if (cloth_last && what.snapshot != nullptr) {
        ghost.draw_under(shaders);
        draw_cloth(what, surface, report);
    }
    if (what.options.show_pins)
        draw_pins(what, report);
    report.arrows = arrows.draw(what.arrows, what.marker, 1.4f * report.line_width, shaders);
    if (cloth_last && what.ghost != nullptr) // what is behind the cloth has shone through it
        draw_depth(what.options, surface);
    report.ghost_triangles = ghost.draw(shaders);
}

DrawReport Renderer::draw(const Scene& what, Target& target) {
    Parts& parts = *parts_;
    const Options& options = what.options;
    for (const Surface* surface : {&options.surface, what.right ? &*what.right : &options.surface})
        parts.shaders.surface(surface->shader);

    if (what.snapshot != nullptr)
        parts.cloth.update(*what.snapshot);
    else
        parts.cloth.clear();
    parts.ghost.update(what.ghost);
    const ProjectedCloth projected =
        project(what.snapshot, parts.cloth.drawn(), what.view, target.width(), target.height());
    DrawReport report;
    report.width = target.width();
    report.height = target.height();
    report.cloth_box = {projected.min_x, projected.min_y, projected.max_x, projected.max_y};
    report.points_in_view = projected.inside;
    report.points_not_drawable = parts.cloth.not_drawable();
    report.ghost_not_drawable = parts.ghost.not_drawable();
    // A ninth of a cell at most: a fine grid would else be one plain of colour.
    report.line_width = std::max(0.1f, options.line_width);
    if (projected.cell > 0)
        report.line_width = std::min(report.line_width, std::max(0.5f, projected.cell / 9));

    target.bind();
    set_state();
    glClearDepth(1);
    glClear(GL_DEPTH_BUFFER_BIT);
    parts.set_shadow(what);
    parts.set_frame(what, target, projected);
    parts.draw_part(what, options.surface, report);
    if (what.right) {
        // Over the left part: a scissor for that too would leave samples of pixels at the divider to nobody.
        const int divider =
            static_cast<int>(std::lround(std::clamp(what.divider, 0.f, 1.f) * static_cast<float>(target.width())));
        glEnable(GL_SCISSOR_TEST);
        glScissor(divider, 0, target.width() - divider, target.height());
        glClear(GL_DEPTH_BUFFER_BIT);
        DrawReport of_the_right = report;
        parts.draw_part(what, *what.right, of_the_right);
    }
    reset_state();
    target.resolve();
    return report;
}

} // namespace clothlab::render
