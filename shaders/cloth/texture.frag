#version 330 core
//@ shader title="Texture" help="A picture on the cloth, upright on its front, repeated as often as asked for."
#include "common/frame.glsl"
#include "common/surface.glsl"
#include "common/lighting.glsl"
uniform sampler2D albedo;       //@ label="Picture" texture=colour default="weave" help="Its colours are the share of light that comes back."
uniform float repeat_u = 2.0;   //@ label="Repeat along u" min=0.1 max=20 log help="How often the picture repeats along the cloth's width."
uniform float repeat_v = 2.0;   //@ label="Repeat along v" min=0.1 max=20 log help="How often the picture repeats along the cloth's height."
uniform bool lit = true;        //@ label="Lit" help="As matt cloth under the lamps; off, the picture's own colours."

void main() {
    vec3 colour = texture(albedo, surface_uv * vec2(repeat_u, repeat_v)).rgb;
    float light = lit ? all_light(world_position, seen_normal()) : 1.0;
    pixel = vec4(shade * colour * light, 1.0);
}
