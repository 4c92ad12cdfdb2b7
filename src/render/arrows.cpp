#include "render/arrows.h"

#include <algorithm>
#include <cstddef>

#include "render/options.h"
#include "render/shader_library.h"
#include "render/view.h"

namespace clothlab::render {
namespace {

constexpr float bold = 3;             ///< px, of an arrow alone
constexpr float rim = 1;              ///< px, dark, so that arrows are seen on light and dark alike
constexpr float hidden_share = 0.35f; ///< of the colour where something lies in front
constexpr float marker_size = 13;     ///< px
constexpr glm::vec3 marker_colour = colour(0xFFE14D);
/// Corners of an arrow in shaders/arrows.vert: two triangles of the shaft, one of the head.
constexpr GLsizei corners = 9;

} // namespace

std::size_t Arrows::draw(std::span<const Arrow> arrows, const std::optional<glm::vec3>& marker, float width,
                         ShaderLibrary& shaders) {
    drawn_.clear();
    glm::vec3 last_srgb{0}, last_linear{0};
    for (Arrow arrow : arrows) {
        if (arrow.from == arrow.to || !drawable(arrow.from) || !drawable(arrow.to))
            continue;
        if (arrow.colour != last_srgb) {
            last_srgb = arrow.colour;
            last_linear = linear(arrow.colour);
        }
        arrow.colour = last_linear;
        drawn_.push_back(arrow);
    }
    if (!drawn_.empty()) {
        glBindVertexArray(vertices_.id());
        glBindBuffer(GL_ARRAY_BUFFER, data_.id());
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(drawn_.size() * sizeof(Arrow)), drawn_.data(),
                     GL_STREAM_DRAW);
        GLuint attribute = 0;
        for (const std::size_t offset : {offsetof(Arrow, from), offsetof(Arrow, to), offsetof(Arrow, colour)}) {
            glEnableVertexAttribArray(attribute);
            glVertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, sizeof(Arrow),
                                  reinterpret_cast<const void*>(offset));
            glVertexAttribDivisor(attribute++, 1);
        }
        const Program& program = shaders.program("arrows");
        program.use();
        program.set("width", drawn_.size() == 1 ? std::max(bold, width) : width);
        program.set("depth", 0.995f);
        const auto pass = [&](float share, float grow) {
            program.set("share", share);
            program.set("grow", grow);
            glDrawArraysInstanced(GL_TRIANGLES, 0, corners, static_cast<GLsizei>(drawn_.size()));
        };
        glEnable(GL_BLEND);
        glDepthMask(GL_FALSE);
        glDepthFunc(GL_GREATER);
        pass(hidden_share, 0);
        glDepthMask(GL_TRUE);
        glDepthFunc(GL_LESS);
        glDisable(GL_BLEND);
        pass(1, rim);
    }
    if (marker && drawable(*marker))
        draw_marker(*marker, shaders);
    return drawn_.size();
}

void Arrows::draw_marker(const glm::vec3& at, ShaderLibrary& shaders) {
    glBindVertexArray(marker_vertices_.id());
    glBindBuffer(GL_ARRAY_BUFFER, marker_.id());
    glBufferData(GL_ARRAY_BUFFER, sizeof at, &at, GL_STREAM_DRAW);
    glEnableVertexAttribArray(ShaderLibrary::position);
    glVertexAttribPointer(ShaderLibrary::position, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    const Program& program = shaders.program("pins");
    program.use();
    program.set("size", marker_size);
    program.set("colour", linear(marker_colour));
    glEnable(GL_BLEND);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glDisable(GL_DEPTH_TEST);
    glDrawArrays(GL_POINTS, 0, 1);
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_PROGRAM_POINT_SIZE);
    glDisable(GL_BLEND);
}

} // namespace clothlab::render
