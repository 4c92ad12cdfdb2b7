#version 330 core
// Points move along the front's normal by as much as the height map says.
#include "common/frame.glsl"
#include "common/vertex.glsl"
#include "common/relief.glsl"

void main() {
    float height = k_h * textureLod(height_map, relief_uv(picture_uv()), 0.0).r;
    place(placed(position) + height * front_normal(), normal);
}
