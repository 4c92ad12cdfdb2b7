#version 330 core
#include "common/frame.glsl"
in vec3 position;
uniform float size;   // px

void main() {
    gl_Position = to_clip(position, 0.99);
    gl_PointSize = size;
}
