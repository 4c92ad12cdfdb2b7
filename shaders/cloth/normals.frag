#version 330 core
//@ shader title="Normals" help="The normal of the side that is seen as a colour: x, y and z from -1 to 1 are red, green and blue from 0 to 1."
#include "common/frame.glsl"
#include "common/surface.glsl"
uniform bool from_camera = false;   //@ label="As seen by the camera" help="x to the right, y up and z to the beholder, instead of the world's axes."
uniform bool faceted = false;       //@ label="Each triangle's own" help="The triangles' normals, instead of the points' between which the others are interpolated."

// The colour whose sRGB values are the normal's: what a picture file shows can be read off.
vec3 linear_of(vec3 srgb) { return mix(srgb / 12.92, pow((srgb + 0.055) / 1.055, vec3(2.4)), step(0.04045, srgb)); }

void main() {
    vec3 n = seen_normal();
    if (faceted) {
        // Towards the beholder, whichever way round the triangle is.
        n = normalize(cross(dFdx(world_position), dFdy(world_position)));
        n = dot(n, direction_to_eye(world_position)) < 0.0 ? -n : n;
    }
    if (from_camera) n = mat3(frame.view) * n;
    pixel = vec4(shade * linear_of(clamp(0.5 * n + 0.5, 0.0, 1.0)), 1.0);
}
