#version 330 core
// Matt and neutral, with a soft light edge: the cloth is what matters.
#include "common/frame.glsl"
#include "common/lighting.glsl"
in vec3 world_position;
in vec3 world_normal;
out vec4 pixel;
uniform vec3 colour;   // linear

void main() {
    vec3 n = normalize(world_normal);
    if (!gl_FrontFacing) n = -n;   // the eye is inside
    vec3 to_eye = direction_to_eye(world_position);
    float edge = pow(1.0 - clamp(dot(n, to_eye), 0.0, 1.0), 4.0);
    float light = 0.8 * all_light(world_position, n) + 0.06 * edge;
    pixel = vec4(colour * light, 1.0);
}
