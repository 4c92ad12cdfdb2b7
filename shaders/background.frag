#version 330 core
// A calm vertical gradient.
in float height;
out vec4 pixel;
uniform vec3 top, bottom;   // linear

void main() {
    pixel = vec4(mix(bottom, top, smoothstep(0.0, 1.0, height)), 1.0);
}
