#version 330 core
// Points move along the front's normal by one map, read through another.
#include "common/frame.glsl"
#include "common/vertex.glsl"
#include "common/layers.glsl"

void main() {
    vec2 uv = layer_uv(picture_uv());
    float there = textureLod(through_map, uv, 0.0).r, elsewhere = textureLod(through_map, uv + 0.5, 0.0).r;
    float height = k_h * textureLod(height_map, bent(uv, there, elsewhere), 0.0).r;
    place(placed(position) + height * front_normal(), normal);
}
