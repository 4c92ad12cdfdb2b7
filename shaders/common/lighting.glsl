// Light in linear values; the framebuffer encodes them as sRGB. Needs common/frame.glsl.

// The share of light that a matt surface sends back: a point light of intensity / r^2.
float point_light(vec3 position, vec3 normal) {
    vec3 to_light = frame.light.xyz - position;
    float r2 = max(dot(to_light, to_light), 1e-6);
    return frame.light.w / r2 * max(0.0, dot(normal, to_light * inversesqrt(r2)));
}

// Light from everywhere, a little more of it from above.
float ambient_light(vec3 normal) { return frame.ambient.x * (0.75 + 0.25 * normal.y); }

// A soft light over the beholder's left shoulder: folds that the point light does not reach stay readable.
float fill_light(vec3 normal) {
    vec3 to_light = vec3(-0.51, 0.44, 0.74) * mat3(frame.view);   // camera to world
    return frame.ambient.y * max(0.0, 0.3 + 0.7 * dot(normal, to_light));
}

float all_light(vec3 position, vec3 normal) {
    return point_light(position, normal) + ambient_light(normal) + fill_light(normal);
}
