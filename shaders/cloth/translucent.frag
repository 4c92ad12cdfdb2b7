#version 330 core
//@ shader translucent title="Translucent" help="Cloth that shines through, in layers: displaced by one height map that is read through another, over Blinn-Phong light, with light from behind."
#include "common/frame.glsl"
#include "common/surface.glsl"
#include "common/lighting.glsl"
#include "common/blinn_phong.glsl"
#include "common/layers.glsl"
#include "common/tangent_space.glsl"
uniform vec3 tint;               //@ label="Colour" colour="#5CC2B0" help="Colour of both sides."
uniform float opacity = 0.75;    //@ label="Opacity" min=0 max=1 help="Share of what is behind that one layer hides."
uniform float through = 0.5;     //@ label="Light through" min=0 max=1 help="Share of a lamp's light on the other side that comes through."
uniform float k_n = 150.0;       //@ label="Normal k_n" min=1 max=10000 log help="How much steeper the normals take the heights."

float layered(vec2 uv) {
    return texture(height_map, bent(uv, texture(through_map, uv).r, texture(through_map, uv + 0.5).r)).r;
}

void main() {
    shines_through = true;
    vec2 uv = layer_uv(surface_uv), texel = 1.0 / vec2(textureSize(height_map, 0));
    float here = layered(uv);
    float dU = (layered(uv + vec2(texel.x, 0.0)) - here) * k_h * k_n;
    float dV = (layered(uv + vec2(0.0, texel.y)) - here) * k_h * k_n;
    vec3 n = seen_tilted_normal(dU, dV);
    float light = ambient_part() + diffuse_part(world_position, n) + through * diffuse_part(world_position, -n);
    pixel = vec4(shade * (tint * light + specular_part(world_position, n)), opacity);
}
