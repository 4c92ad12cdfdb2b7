#version 330 core
//@ shader title="Blinn-Phong" help="Ambient, diffuse and specular light: ka Ia + kd I/r² max(0, n·l) + ks I/r² max(0, n·h)^p. Ia is the look's light from everywhere, I a lamp's."
#include "common/frame.glsl"
#include "common/cloth.glsl"
#include "common/lighting.glsl"
#include "common/blinn_phong.glsl"
uniform bool ambient_on = true;    //@ label="Ambient part" help="Shows ka Ia, in the cloth's colour."
uniform bool diffuse_on = true;    //@ label="Diffuse part" help="Shows kd I/r² max(0, n·l), in the cloth's colour."
uniform bool specular_on = true;   //@ label="Specular part" help="Shows ks I/r² max(0, n·h)^p, in the highlight's colour."
uniform vec3 highlight;            //@ label="Highlight" colour="#FFFFFF" help="Colour of the specular part."

void main() {
    vec3 n = seen_normal(), colour = vec3(0.0);
    if (ambient_on) colour += seen_colour() * ambient_part();
    if (diffuse_on) colour += seen_colour() * diffuse_part(world_position, n);
    if (specular_on) colour += shade * highlight * specular_part(world_position, n);
    pixel = vec4(colour, 1.0);
}
