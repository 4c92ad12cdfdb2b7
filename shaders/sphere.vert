#version 330 core
#include "common/frame.glsl"
in vec3 position;   // on the unit sphere
out vec3 world_position;
out vec3 world_normal;
uniform vec4 object;   // centre and radius in m
uniform float depth;   // as a share of the distance

void main() {
    world_position = object.xyz + object.w * position;
    world_normal = position;
    gl_Position = to_clip(world_position, depth);
}
