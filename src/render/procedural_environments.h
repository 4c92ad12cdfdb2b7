// Surroundings made by code, for mirrors: cube maps of 256 x 256 a face. Needs no GL.
#pragma once

#include "render/procedural.h"

namespace clothlab::render {

/// A blue sky with the sun where scenes have their light, soft clouds, a hazy horizon and bare ground.
Cube<Image> sky();

/// A room seen from its middle: windows behind (-z) and on the right (+x), a door and a picture, a floor of wood.
Cube<Image> room();

/// Each face of one colour, for tests: +x red, -x cyan, +y green, -y magenta, +z blue, -z yellow.
Cube<Image> six_colours();

} // namespace clothlab::render
