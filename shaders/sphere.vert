#version 330 core
#include "common/frame.glsl"
in vec3 position;   // on the unit sphere
out vec3 world_position;
out vec3 world_normal;
uniform vec4 sphere;   // centre and radius in m

void main() {
    // A little smaller and further away than it is: cloth that lies on it cuts through it between its points, and must
    // hide it, at its outline too.
    world_position = sphere.xyz + 0.99 * sphere.w * position;
    world_normal = position;
    gl_Position = to_clip(world_position, 1.004);
}
