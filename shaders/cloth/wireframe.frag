#version 330 core
//@ shader lines title="Wireframe" help="The springs alone, each kind in its own colour."
// One colour, the same as in the legend; further away it recedes into the background.
#include "common/frame.glsl"
in float distance_from_eye;
out vec4 pixel;
uniform vec3 colour, background;   // linear
uniform float depth_cue;           // 0: none, 1: the furthest is the background's colour

void main() {
    float range = max(frame.cloth_depth.y - frame.cloth_depth.x, 1e-6);
    float depth = clamp((distance_from_eye - frame.cloth_depth.x) / range, 0.0, 1.0);
    float deep = clamp(4.0 * range / max(frame.cloth_depth.y, 1e-6), 0.0, 1.0);   // flat cloth has no far end
    pixel = vec4(mix(colour, background, depth_cue * deep * depth), 1.0);
}
