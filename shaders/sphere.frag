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
    vec3 to_eye = normalize(frame.eye.xyz - world_position);
    if (dot(n, to_eye) < 0.0) n = -n;   // the eye is inside
    float edge = pow(1.0 - abs(dot(n, to_eye)), 4.0);
    float light = 0.8 * all_light(world_position, n) + 0.06 * edge;
    pixel = vec4(colour * light, 1.0);
}
