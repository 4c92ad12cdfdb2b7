// Springs as lines as wide as asked for: drivers of the core profile need not draw lines wider than a pixel. Needs
// common/frame.glsl.
layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;
in vec3 point[];
in vec3 up[];
in float end_quantity[];
uniform float width;   // px
uniform float shift;   // along the surface to the line's side, as a share of its length
uniform float depth;   // as a share of the distance: lines sit on the surface
out float distance_from_eye;
out float line_quantity;   // what the shader's declaration names

void main() {
    vec3 aside = cross(up[0] + up[1], point[1] - point[0]);
    aside *= 0.5 * shift;   // the sum of two unit normals is up to 2 long
    vec4 a = to_clip(point[0] + aside, depth), b = to_clip(point[1] + aside, depth);
    // Cut at the near plane, behind which the division below has no meaning.
    float in_a = a.z + a.w, in_b = b.z + b.w;
    if (in_a <= 0.0 && in_b <= 0.0) return;
    float of_a = end_quantity[0], of_b = end_quantity[1];
    if (in_a < 0.0) {
        float share = in_b / (in_b - in_a);
        a = mix(b, a, share);
        of_a = mix(of_b, of_a, share);
    }
    if (in_b < 0.0) {
        float share = in_a / (in_a - in_b);
        b = mix(a, b, share);
        of_b = mix(of_a, of_b, share);
    }

    vec2 to_px = 0.5 * frame.viewport.xy;
    vec2 along = (b.xy / b.w - a.xy / a.w) * to_px;
    float length_px = length(along);
    vec2 left = length_px > 1e-6 ? vec2(-along.y, along.x) / length_px : vec2(0.0, 1.0);
    for (int i = 0; i < 4; ++i) {
        vec4 end = i < 2 ? a : b;
        float side = (i & 1) == 0 ? 0.5 : -0.5;
        distance_from_eye = depth_of(end);
        line_quantity = i < 2 ? of_a : of_b;
        gl_Position = vec4(end.xy + left * side * width / to_px * end.w, end.zw);
        EmitVertex();
    }
    EndPrimitive();
}
