#include "render/gl_state.h"

#include "render/gl.h"

namespace clothlab::render {

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
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS); // nobody else here draws cube maps, so it stays
    glBlendEquation(GL_FUNC_ADD);
    // The picture stays opaque whatever is blended over it.
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

void reset_state() {
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_PROGRAM_POINT_SIZE);
    glBindVertexArray(0);
    glUseProgram(0);
    glBindBuffer(GL_UNIFORM_BUFFER, 0);
}

} // namespace clothlab::render
