#version 330 core
//@ shader title="Mirror" help="What a cube of pictures shows in the direction in which the eye's ray leaves the surface."
#include "common/frame.glsl"
#include "common/surface.glsl"
#include "common/lighting.glsl"
uniform samplerCube environment;   //@ label="Surroundings" default="sky" help="What the surface mirrors."
uniform vec3 tint;                 //@ label="Tint" colour="#FFFFFF" help="Colour of the mirror; white mirrors all light."
uniform float fresnel = 0.0;       //@ label="Fresnel" min=0 max=1 help="How far it mirrors less the steeper it is looked at, as lacquer does (Schlick's formula with 4 %); 0 is a pure mirror."
uniform vec3 base;                 //@ label="Below the mirror" colour="#30343A" help="Colour of what is seen where it does not mirror; with Fresnel only."

void main() {
    vec3 n = seen_normal(), to_eye = direction_to_eye(world_position);
    vec3 mirrored = tint * texture(environment, reflect(-to_eye, n)).rgb;
    float schlick = 0.04 + 0.96 * pow(1.0 - clamp(dot(n, to_eye), 0.0, 1.0), 5.0);
    float share = mix(1.0, schlick, fresnel);
    vec3 below = base * all_light(world_position, n);
    pixel = vec4(shade * mix(below, mirrored, share), 1.0);
}
