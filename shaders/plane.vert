#version 330 core
#include "common/frame.glsl"
out vec3 world_position;
uniform vec3 centre, axis_u, axis_v;
uniform float radius;   // m

void main() {
    vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID & 2) - 1);
    world_position = centre + radius * (corner.x * axis_u + corner.y * axis_v);
    // A little further away than it is: cloth that lies on it must hide it.
    gl_Position = to_clip(world_position, 1.001);
}
