// Light in linear values; the framebuffer encodes them as sRGB. Needs common/frame.glsl.

const int lights = 2;

// The light of one lamp that arrives at a point, intensity / r^2, and the unit vector to the lamp.
float light_at(int lamp, vec3 position, out vec3 to_light) {
    vec3 path = frame.lights[lamp].xyz - position;
    float r2 = max(dot(path, path), 1e-6);
    to_light = path * inversesqrt(r2);
    return frame.lights[lamp].w / r2;
}

// The share of the lamps' light that a matt surface sends back.
float point_light(vec3 position, vec3 normal) {
    float sum = 0.0;
    for (int lamp = 0; lamp < lights; ++lamp) {
        vec3 to_light;
        float light = light_at(lamp, position, to_light);
        sum += light * max(0.0, dot(normal, to_light));
    }
    return sum;
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
