// Numbers as colours. Needs common/surface.glsl, common/lighting.glsl and common/ramp.glsl.
uniform float shading = 0.5;   //@ label="Shading" min=0 max=1 help="How much light and shadow the colours get, so that folds stay readable; 0 gives exactly the legend's."

vec4 heat_pixel(vec3 colour) {
    float light = min(all_light(world_position, seen_normal()), 1.0);
    return vec4(shade * mix(1.0, light, shading) * colour, 1.0);
}
