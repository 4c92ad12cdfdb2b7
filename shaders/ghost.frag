#version 330 core
// A see-through cloth of one colour, with its border, its silhouette and a few lines of its grid.
#include "common/frame.glsl"
in vec3 world_position;
in vec3 world_normal;
in vec2 surface_uv;
out vec4 pixel;
uniform vec3 colour;    // linear
uniform vec2 cells;     // between lines, along columns and rows
uniform float fill;     // opacity between the lines
uniform float lines;    // opacity of the lines
uniform float inner;    // that of the lines within, as a share of it

// 1 within half a line's width of where x is 0, 0 beside it; all in px.
float line(float x, float width) { return 1.0 - smoothstep(0.5 * width - 0.5, 0.5 * width + 0.5, abs(x)); }

void main() {
    vec2 px = max(fwidth(surface_uv), 1e-6);
    vec2 from_line = (surface_uv * cells - round(surface_uv * cells)) / (cells * px);
    float grid = max(line(from_line.x, 1.5), line(from_line.y, 1.5));
    vec2 from_border = (0.5 - abs(surface_uv - 0.5)) / px;
    float border = max(line(from_border.x, 5.0), line(from_border.y, 5.0));   // half of it is beyond the cloth
    float facing = abs(dot(normalize(world_normal), direction_to_eye(world_position)));
    float silhouette = 1.0 - smoothstep(0.1, 0.35, facing);
    float opacity = max(fill, lines * max(border, inner * max(0.8 * silhouette, 0.75 * grid)));
    pixel = vec4(colour * mix(0.6, 1.0, facing), opacity);
}
