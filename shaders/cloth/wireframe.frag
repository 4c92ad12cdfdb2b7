#version 330 core
//@ shader lines title="Wireframe" help="The springs alone, each kind in its own colour."
#include "common/frame.glsl"
#include "common/lines.glsl"
uniform vec3 colour;   // linear; of the springs' kind

void main() { pixel = line_pixel(colour); }
