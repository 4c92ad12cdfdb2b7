// The course's bump mapping: the height's change over one pixel of the map. Needs common/relief.glsl.
#include "common/tangent_space.glsl"

float h(vec2 uv) { return texture(height_map, uv).r; }

vec3 seen_relief_normal() {
    vec2 uv = relief_uv(surface_uv), texel = 1.0 / vec2(textureSize(height_map, 0));
    float dU = (h(uv + vec2(texel.x, 0.0)) - h(uv)) * k_h * k_n;
    float dV = (h(uv + vec2(0.0, texel.y)) - h(uv)) * k_h * k_n;
    return seen_tilted_normal(dU, dV);
}
