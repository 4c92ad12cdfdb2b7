// Patterns for cloth, made by code: colours and height maps of 512 x 512 that tile, and ramps. The height map of a
// pattern fits its colours pixel by pixel. Needs no GL.
#pragma once

#include "render/image.h"

namespace clothlab::render {

/// A wall of four by ten bricks in running bond: 24 cm x 9 cm each on a cloth of 1 m, with joints of 1 cm.
Image bricks();
GreyImage bricks_height();

/// Plain weave of 28 by 28 threads, each over one and under the next: light weft to the right, blue warp upwards.
Image weave();
GreyImage weave_height();

/// Skin: furrows between polygons of two sizes, pores, blotches.
Image skin();
GreyImage skin_height();

/// Hills: six octaves of value noise.
GreyImage noise_height();

/// Eight by eight squares, dark at the upper left.
Image checker();

/// One white pixel.
Image white();

/// 256 x 1: four flat steps of light, from shade on the left to full light on the right.
Image toon_ramp();

} // namespace clothlab::render
