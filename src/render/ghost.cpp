#include "render/ghost.h"

#include <algorithm>

#include "render/options.h"

namespace clothlab::render {
namespace {

/// Lines along each side at most: more would hide what is behind them.
constexpr int most_cells = 12;
/// Shares of the distance: a cloth in the same place hides the ghost; what is behind the cloth by less than the second
/// is too near for its outline to be told from the cloth's.
constexpr float behind = 1.0005f, near = 0.99f;
/// Opacities.
constexpr float fill = 0.38f, lines = 0.9f;

/// Every how many cells of the grid there is a line.
float line_cells(int points) {
    const int cells = std::max(1, points - 1), every = (cells + most_cells - 1) / most_cells;
    return static_cast<float>(cells) / static_cast<float>(every);
}

} // namespace

void Ghost::update(const sim::Snapshot* snapshot) {
    if (!snapshot)
        return cloth_.clear();
    cloth_.update(*snapshot);
    cells_ = {line_cells(snapshot->columns), line_cells(snapshot->rows)};
}

const Program& Ghost::use(ShaderLibrary& shaders) const {
    const Program& program = shaders.program("ghost");
    program.use();
    program.set("colour", linear(ghost_colour));
    program.set("cells", cells_);
    program.set("depth", behind);
    program.set("fill", fill);
    program.set("lines", lines);
    program.set("inner", 1.f);
    return program;
}

void Ghost::draw_under(ShaderLibrary& shaders) const {
    if (cloth_.drawn().empty())
        return;
    use(shaders);
    glEnable(GL_BLEND);
    glDepthMask(GL_FALSE);
    cloth_.draw_surface();
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

std::size_t Ghost::draw(ShaderLibrary& shaders) const {
    if (cloth_.drawn().empty())
        return 0;
    const Program& program = use(shaders);
    glEnable(GL_BLEND);
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_GREATER);
    program.set("depth", near);
    program.set("fill", 0.f);
    program.set("lines", 0.5f * lines);
    program.set("inner", 0.f);
    cloth_.draw_surface();

    use(shaders);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    cloth_.draw_surface();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_EQUAL);
    const std::size_t triangles = cloth_.draw_surface();
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glDisable(GL_BLEND);
    return triangles;
}

} // namespace clothlab::render
