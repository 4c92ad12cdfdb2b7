#version 330 core
// One triangle over the whole picture.
out float height;   // 0 at the bottom, 1 at the top

void main() {
    vec2 p = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID & 2) * 2 - 1);
    height = 0.5 + 0.5 * p.y;
    gl_Position = vec4(p, 0.0, 1.0);
}
