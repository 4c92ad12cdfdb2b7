#version 330 core
//@ shader title="Toon" help="Steps of light as in a drawing: a ramp turns the diffuse light into a mix of a dark and a light colour, highlights have edges, and outlines are where the surface turns away."
#include "common/frame.glsl"
#include "common/cloth.glsl"
#include "common/lighting.glsl"
#include "common/ramp.glsl"
uniform sampler2D ramp;              //@ label="Ramp" texture=ramp default="toon-ramp" help="From no light to full light: black is the dark colour, white the light one."
uniform int bands = 0;               //@ label="Bands" min=0 max=8 help="Steps of light, each the ramp's value in its middle; 0 takes the ramp as it is."
uniform float full_light = 0.7;      //@ label="Full light" min=0.05 max=3 log help="The lamps' light, I/r² n·l, at which the ramp ends."
uniform vec3 dark_tint;              //@ label="Dark tint" colour="#6A4C86" help="Times the cloth's colour, the dark one."
uniform vec3 highlight;              //@ label="Highlight" colour="#FFF4DC" help="Colour of the highlights."
uniform float ks = 0.6;              //@ label="Highlight's strength" min=0 max=1 help="How far the highlights hide the cloth's colour."
uniform float p = 60.0;              //@ label="Shininess p" min=1 max=1000 log help="The larger, the smaller the highlight."
uniform int highlight_steps = 2;     //@ label="Highlight's steps" min=1 max=5 help="Edges from outside to the middle of a highlight."
uniform float outline = 0.35;        //@ label="Outline" min=0 max=1 help="Where the cosine between normal and view is below this, there can be an outline; 0: none."
uniform float outline_width = 5.0;   //@ label="Outline's width" unit="px" min=0.5 max=20 log help="How wide outlines are at most: flat cloth that is seen from the side would be one."
uniform vec3 outline_colour;         //@ label="Outline's colour" colour="#1B1420" help="Colour of the outlines."

// 0, 1 ... in equal steps as x grows by 1, with edges a pixel wide.
float steps_of(float x) {
    float width = clamp(fwidth(x), 1e-5, 1.0);
    return floor(x) + smoothstep(1.0 - width, 1.0, fract(x));
}

// The ramp at x, in bands where those are asked for.
float level(float x) {
    x = clamp(x, 0.0, 1.0);
    vec3 colour = ramp_colour(ramp, x);
    if (bands > 0) {
        float n = float(bands), at = steps_of(x * n), below = floor(at);
        vec3 low = ramp_colour(ramp, (min(below, n - 1.0) + 0.5) / n);
        vec3 high = ramp_colour(ramp, (min(below + 1.0, n - 1.0) + 0.5) / n);
        colour = mix(low, high, at - below);
    }
    return dot(colour, vec3(0.2126, 0.7152, 0.0722));
}

void main() {
    vec3 n = seen_normal(), to_eye = direction_to_eye(world_position);
    float diffuse = 0.0, specular = 0.0;
    for (int lamp = 0; lamp < lights; ++lamp) {
        vec3 to_light;
        float light = light_at(lamp, world_position, to_light);
        diffuse += light * max(0.0, dot(n, to_light));
        specular += light * pow(max(0.0, dot(n, normalize(to_light + to_eye))), p);
    }
    vec3 colour = mix(dark_tint, vec3(1.0), level(diffuse / full_light)) * seen_colour();

    float count = float(highlight_steps);
    float shine = min(steps_of(specular / full_light * (count + 1.0)), count) / count;
    colour = mix(colour, shade * highlight, ks * shine);

    // The cosine falls to 0 at the edge, so divided by its change from pixel to pixel it is the distance from there.
    float facing = dot(n, to_eye), per_px = max(fwidth(facing), 1e-6);
    float inside = (min(outline, outline_width * per_px) - facing) / per_px;   // px
    pixel = vec4(mix(colour, shade * outline_colour, outline > 0.0 ? smoothstep(-0.5, 0.5, inside) : 0.0), 1.0);
}
