#version 330 core
//@ shader title="Bump" help="Blinn-Phong light with normals tilted by a height map; the surface itself stays. The course's formula, with heights above the front of the cloth, so that the back shows them as dents, and with repeats."
#include "common/frame.glsl"
#include "common/cloth.glsl"
#include "common/lighting.glsl"
#include "common/blinn_phong.glsl"
#include "common/relief.glsl"
#include "common/relief_normal.glsl"

void main() {
    vec3 n = seen_relief_normal();
    vec3 colour = seen_colour() * (ambient_part() + diffuse_part(world_position, n));
    pixel = vec4(colour + shade * specular_part(world_position, n), 1.0);
}
