// A scene on another grid.
#pragma once

#include "scene/scene.h"

namespace clothlab::scene {

/// Changes the number of points along width and height, each at least 2, and moves the pins to where they belong on the
/// new grid.
void resize_grid(Scene& scene, int columns, int rows);

} // namespace clothlab::scene
