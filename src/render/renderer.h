// Draws a scene into a target and says what it drew: the picture of the window, the command line and the tests.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/arrows.h"
#include "render/offscreen.h"
#include "render/options.h"
#include "render/shader_files.h"
#include "render/view.h"
#include "sim/description.h"
#include "sim/snapshot.h"

namespace clothlab::render {

/// What is to be drawn; it has to live as long as the call of draw().
struct Scene {
    const sim::Snapshot* snapshot = nullptr; ///< none: no cloth
    const sim::Snapshot* ghost = nullptr;    ///< another cloth, of any grid, drawn see-through over the picture
    std::span<const sim::Collider> colliders;
    std::span<const sim::GridPoint> pinned;
    View view;
    Options options;
    /// A split view: how everything right of the divider is drawn. The report tells of the left part.
    std::optional<Surface> right;
    float divider = 0.5f; ///< as a share of the picture's width
    std::span<const Arrow> arrows;
    std::optional<glm::vec3> marker; ///< a point to be marked, in m
};

/// Pixels from the left and the top, max included; empty when max is below min.
struct PixelBox {
    int min_x = 0, min_y = 0, max_x = -1, max_y = -1;
    bool empty() const { return max_x < min_x || max_y < min_y; }
    int width() const { return empty() ? 0 : max_x - min_x + 1; }
    int height() const { return empty() ? 0 : max_y - min_y + 1; }
};

/// What a draw has sent to the screen. Parts of the cloth with non-finite points are left out and not counted.
struct DrawReport {
    std::size_t cloth_triangles = 0;
    std::array<std::size_t, sim::spring_kinds> springs{}; ///< lines drawn, by SpringKind
    std::size_t spheres = 0, planes = 0, pins = 0, arrows = 0;
    int width = 0, height = 0;           ///< px
    PixelBox cloth_box;                  ///< around the points inside the view
    std::size_t points_in_view = 0;      ///< cloth points inside the view, hidden ones too
    std::size_t points_not_drawable = 0; ///< not finite, or beyond drawable_range
    float line_width = 0;                ///< px, as drawn
    std::size_t ghost_triangles = 0;     ///< what is above does not count the ghost
    std::size_t ghost_not_drawable = 0;
};

class Renderer {
public:
    /// Loads the shaders that every picture needs from folders like the repository's shaders/. Throws
    /// std::runtime_error when the context is older than OpenGL 3.3, ShaderError for a shader that is missing or
    /// broken.
    explicit Renderer(ShaderFolders shaders);
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    /// Draws the scene over the whole target and resolves it. Leaves the framebuffer binding as it was, depth test,
    /// blending and sRGB writing off. Throws ShaderError, before anything is drawn, for a surface's shader that is
    /// missing or broken.
    DrawReport draw(const Scene& what, Target& target);

    /// The shader files may have changed, or texts that stand for them (ShaderFolders::edited): the next draw takes
    /// what compiles. What does not goes on as it was, see shader_errors().
    void reload_shaders();
    void reload_shaders(std::map<std::filesystem::path, std::string> edited);
    /// What is wrong with shaders that were drawn with since the last reload, in the form that they had before it.
    std::vector<ShaderError> shader_errors() const;
    const ShaderFolders& shader_folders() const;

    /// What is wrong with the textures that were drawn, as far as anything is: each shows as a checker or the like.
    std::vector<std::string> texture_errors() const;
    /// Reads texture files that have changed; true when there were any. For every half a second, not for every frame.
    bool refresh_textures();

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace clothlab::render
