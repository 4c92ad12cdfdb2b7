#version 330 core
//@ shader title="Diffuse" help="Matt cloth under the lamp: the light that arrives is intensity / r²."
// Matt cloth under a point light, each side in its own colour: kd I / r^2 max(0, n.l), with ambient and fill light.
#include "common/frame.glsl"
#include "common/cloth.glsl"
#include "common/lighting.glsl"

void main() {
    vec3 n = seen_normal();
    pixel = vec4(seen_colour() * all_light(world_position, n), 1.0);
}
