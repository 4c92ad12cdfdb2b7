// What the fragment shader of lines is given: see common/lines_geometry.glsl. Needs common/frame.glsl.
in float distance_from_eye;   // m
in float line_quantity;       // what the shader's declaration names
out vec4 pixel;

uniform vec3 background;    // linear
uniform float depth_cue;    // 0: none, 1: the furthest is the background's colour

// Further away, lines recede into the background.
vec4 line_pixel(vec3 colour) {
    float range = max(frame.cloth_depth.y - frame.cloth_depth.x, 1e-6);
    float depth = clamp((distance_from_eye - frame.cloth_depth.x) / range, 0.0, 1.0);
    float deep = clamp(4.0 * range / max(frame.cloth_depth.y, 1e-6), 0.0, 1.0);   // flat cloth has no far end
    return vec4(mix(colour, background, depth_cue * deep * depth), 1.0);
}
