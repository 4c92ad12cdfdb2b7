#version 330 core
// A subtle floor with a line every 0.1 m and a stronger one every 1 m, fading out with distance; seen from both sides.
#include "common/frame.glsl"
#include "common/lighting.glsl"
in vec3 world_position;
out vec4 pixel;
uniform vec3 centre, origin, axis_u, axis_v, plane_normal;
uniform float radius, opacity;
uniform bool lines_only;   // the ground grid

// How much of a pixel is covered by lines of a width at whole numbers; too fine a grid becomes its mean.
float grid(vec2 at, vec2 change, float width) {
    vec2 drawn = clamp(vec2(width), change, vec2(0.5));
    vec2 distance = abs(fract(at - 0.5) - 0.5);
    vec2 lines = smoothstep(drawn + change, drawn - change, distance * 2.0) * clamp(width / drawn, 0.0, 1.0);
    lines = mix(lines, vec2(width), clamp(change * 2.0 - 1.0, 0.0, 1.0));
    return mix(lines.x, 1.0, lines.y);
}

void main() {
    vec3 from_origin = world_position - origin;
    vec2 at = vec2(dot(from_origin, axis_u), dot(from_origin, axis_v));
    vec2 change = max(fwidth(at), vec2(1e-7));
    float fine = grid(at * 10.0, change * 10.0, 0.02), coarse = grid(at, change, 0.006);

    vec3 n = dot(direction_to_eye(world_position), plane_normal) < 0.0 ? -plane_normal : plane_normal;
    float light = point_light(world_position, n) + ambient_light(n) + 0.7 * frame.ambient.y;
    vec3 base = vec3(0.050, 0.057, 0.066), line = vec3(0.16, 0.18, 0.20);
    vec3 colour = mix(base, line, max(0.55 * fine, coarse)) * light;
    float fade = 1.0 - smoothstep(0.25, 1.0, length(world_position - centre) / radius);
    float cover = lines_only ? max(0.35 * fine, 0.8 * coarse) : 1.0;
    pixel = vec4(lines_only ? line : colour, fade * fade * opacity * cover);
    if (pixel.a < 0.004) discard;
}
