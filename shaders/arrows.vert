#version 330 core
// Arrows that are equally wide wherever they are: corners 0 to 5 are the shaft, 6 to 8 the head. Shorter than a head is
// long, an arrow is a small head alone.
#include "common/frame.glsl"
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec3 arrow_colour;   // linear
uniform float width;   // px, of the shaft
uniform float grow;    // px, of the rim
uniform float depth;   // as a share of the distance: arrows that lie in a surface are seen
flat out vec3 colour;
flat out vec4 shape;   // px: half the shaft's width, its length, the head's length, half its width
flat out float rim;    // px
out vec2 place;        // px: ahead of the neck, to the left

void main() {
    colour = arrow_colour;
    vec4 a = to_clip(from, depth), b = to_clip(to, depth);
    // Cut at the near plane, behind which the division below has no meaning.
    float in_a = a.z + a.w, in_b = b.z + b.w;
    if (in_a <= 0.0 && in_b <= 0.0) {
        place = vec2(0.0);
        rim = 0.0;
        shape = vec4(0.0);
        gl_Position = vec4(0.0, 0.0, 2.0, 1.0);   // outside
        return;
    }
    if (in_a < 0.0) a = mix(b, a, in_b / (in_b - in_a));
    if (in_b < 0.0) b = mix(a, b, in_a / (in_a - in_b));

    vec2 to_px = 0.5 * frame.viewport.xy;
    vec3 tail = a.xyz / a.w, tip = b.xyz / b.w;
    vec2 along = (tip.xy - tail.xy) * to_px;
    float length_px = length(along);
    // An arrow towards the eye has no direction in the picture: it is a head that points up.
    vec2 ahead = length_px > 1e-4 ? along / length_px : vec2(0.0, 1.0);
    vec2 left = vec2(-ahead.y, ahead.x);
    float head = min(4.0 * width, max(length_px, 1.5));
    rim = grow * min(length_px / (6.0 * width), 1.0);   // a small arrow would be nothing else
    float half_head = 0.42 * head;

    float shaft = max(length_px - head, 0.0);
    shape = vec4(shaft > 0.0 ? min(0.5 * width, half_head) : 0.0, shaft, head, half_head);

    bool at_neck;
    if (gl_VertexID < 6) {
        int corner = gl_VertexID < 3 ? gl_VertexID : gl_VertexID - 2;   // 0 1 2, 1 2 3
        at_neck = corner > 1;
        float half_width = shaft > 0.0 ? shape.x + rim : 0.0;
        place = vec2(at_neck ? 0.0 : -shaft - rim, (corner & 1) == 0 ? half_width : -half_width);
    } else {
        at_neck = gl_VertexID < 8;
        float half_width = half_head + 1.6 * rim;
        place = at_neck ? vec2(-rim, gl_VertexID == 6 ? half_width : -half_width) : vec2(head + 2.4 * rim, 0.0);
    }
    float neck_share = length_px > head ? shaft / length_px : 0.0;
    float share = at_neck ? neck_share : gl_VertexID < 6 ? 0.0 : 1.0;
    float z = mix(tail.z, tip.z, share);
    gl_Position = vec4(tail.xy + (ahead * (shaft + place.x) + left * place.y) / to_px, z, 1.0);
}
