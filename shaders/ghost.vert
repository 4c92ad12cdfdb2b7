#version 330 core
#include "common/frame.glsl"
in vec3 position;
in vec3 normal;
in vec2 uv;
uniform float depth;   // as a share of the distance
out vec3 world_position;
out vec3 world_normal;
out vec2 surface_uv;

void main() {
    world_position = position;
    world_normal = normal;
    surface_uv = uv;
    gl_Position = to_clip(position, depth);
}
