#version 330 core
flat in vec3 colour;   // linear
out vec4 pixel;
uniform float light;   // 1: the colour as it is
uniform float share;   // that it has of the pixel

void main() {
    pixel = vec4(colour * light, share);
}
