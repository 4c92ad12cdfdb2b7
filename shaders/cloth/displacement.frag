#version 330 core
//@ shader title="Displacement" help="The points move along the normal by the height map, h k_h; normals follow by the formula of Bump. Detail finer than the points is in the normals alone. Unlike the course's: the front's side moves, and repeats."
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
