// What the drawing tests share: flat cloths, a small picture, and the check that OpenGL has nothing to complain about.
#pragma once

#include <cmath>
#include <filesystem>
#include <string>

#include <catch2/catch_test_macros.hpp>

#include "app/scene_view.h"
#include "app/shader_list.h"
#include "gui/gl_context.h"
#include "render/renderer.h"
#include "support/files.h"

namespace clothlab::test {

inline const std::filesystem::path shader_folder = std::filesystem::path(CLOTHLAB_SOURCE_DIR) / "shaders";

/// A flat horizontal cloth of 1 m x 1 m at y = 0, around the y axis.
inline sim::Snapshot flat_cloth(int columns, int rows) {
    sim::Snapshot s;
    s.columns = columns;
    s.rows = rows;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            s.positions.push_back(static_cast<float>(column) / static_cast<float>(columns - 1) - 0.5f);
            s.positions.push_back(0);
            s.positions.push_back(static_cast<float>(row) / static_cast<float>(rows - 1) - 0.5f);
        }
    }
    return s;
}

/// From 2 m above (below for -2) the origin, with 1 m filling a height of 2 tan(20°) 2 m.
inline render::View vertical_view(float height) {
    render::View view;
    view.eye = {0, height, 0};
    view.target = {0, 0, 0};
    view.up = {0, 0, -1};
    return view;
}

/// A shipped shader with the parameters that it declares, all at their defaults but for those given.
inline render::Surface shader_of(const std::string& name, const scene::ShaderValues& values = {}) {
    static const std::vector<scene::ShaderDeclaration> shaders = app::read_shader_list({shader_folder});
    scene::Look look;
    look.shaders[name] = values;
    scene::check_shader_values(look, shaders, "test");
    return app::to_surface(look, shaders, name);
}

/// A snapshot seen from above, or from below with a negative height.
inline render::Scene scene_of(const sim::Snapshot& snapshot, float eye_height = 2) {
    render::Scene scene;
    scene.snapshot = &snapshot;
    scene.view = vertical_view(eye_height);
    scene.options.surface = shader_of("diffuse");
    return scene;
}

inline render::Scene empty_scene() {
    render::Scene scene;
    scene.view = vertical_view(2);
    return scene;
}

inline double brightness(const std::uint8_t* p) {
    return (p[0] + p[1] + p[2]) / 3.0;
}

/// Whether a pixel differs between two pictures of the same size by more than what rounding does.
inline bool differs(const render::Image& a, const render::Image& b, int x, int y) {
    const std::uint8_t *p = a.pixel(x, y), *q = b.pixel(x, y);
    for (int k = 0; k < 3; ++k)
        if (std::abs(p[k] - q[k]) > 1)
            return true;
    return false;
}

inline int count_differences(const render::Image& a, const render::Image& b) {
    int count = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            count += differs(a, b, x, y) ? 1 : 0;
    return count;
}

/// A context, a renderer and a target to draw into.
struct Studio {
    GlContext context;
    render::Renderer renderer{shader_folder};
    render::Target target{160, 90};
    render::DrawReport report;

    render::Image draw(const render::Scene& scene) {
        report = renderer.draw(scene, target);
        render::Image image = target.read();
        CHECK(glGetError() == GL_NO_ERROR);
        return image;
    }
};

} // namespace clothlab::test
