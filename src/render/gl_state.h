// OpenGL's global state before and after a picture.
#pragma once

namespace clothlab::render {

/// Sets everything that the pictures rely on and others may have changed.
void set_state();
/// Switches off what others do not expect.
void reset_state();

} // namespace clothlab::render
