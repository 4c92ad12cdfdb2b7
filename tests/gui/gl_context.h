// An OpenGL context with no window and no display, for as long as the object lives: what a drawing test starts with.
#pragma once

#include <glad/gl.h>

#include "app/window.h"

namespace clothlab::test {

class GlContext {
    app::Window window_{app::Window::Kind::offscreen, 16, 16, "test"};
};

} // namespace clothlab::test
