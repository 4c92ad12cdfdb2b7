#version 330 core
// A disc with a dark rim: seen on light and dark alike.
out vec4 pixel;
uniform float size;    // px
uniform vec3 colour;   // linear

void main() {
    float from_edge = (0.5 - length(gl_PointCoord - 0.5)) * size;
    if (from_edge <= 0.0) discard;
    float inner = smoothstep(1.4, 2.4, from_edge);
    pixel = vec4(mix(vec3(0.008), colour, inner), clamp(from_edge, 0.0, 1.0));
}
