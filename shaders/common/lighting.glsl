// Light in linear values; the framebuffer encodes them as sRGB. For fragment shaders. Needs common/frame.glsl.

const int lights = 2;

uniform sampler2DShadow shadow_map;

// A shader sets it before it asks for light when light on the far side counts, so that the surface is no shadow to
// itself.
bool shines_through = false;

// The share of the first lamp's light that gets to a point on a surface, past cloth and spheres.
float shadow(vec3 position, vec3 to_light) {
    if (frame.shadow.x == 0.0) return 1.0;
    // A surface would shade itself: in stripes, for the map is as coarse as its texels, and in triangles, where these
    // turn away from the lamp before the smooth normal does. The map is therefore asked about a point a little in front
    // of the surface, the further the more the light grazes it.
    vec3 up = cross(dFdx(position), dFdy(position));
    up *= inversesqrt(max(dot(up, up), 1e-30));
    if (dot(up, shines_through ? to_light : direction_to_eye(position)) < 0.0) up = -up;
    float cosine = dot(up, to_light);
    float ahead = frame.shadow.y * distance(frame.lights[0].xyz, position) * sqrt(max(0.01, 1.0 - cosine * cosine));
    vec4 at = frame.to_shadow * vec4(position + ahead * up, 1.0);
    if (at.w <= 0.0) return 1.0;   // behind the lamp
    vec3 place = vec3(at.xy, min(at.z, at.w)) / at.w;
    float lit = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 beside = vec2(float(i & 1) - 0.5, float(i >> 1) - 0.5) * 1.5 * frame.shadow.z;
        lit += textureLod(shadow_map, place + vec3(beside, 0.0), 0.0);
    }
    return 0.25 * lit;
}

// The light of one lamp that arrives at a point, intensity / r^2 or less in a shadow, and the unit vector to the lamp.
float light_at(int lamp, vec3 position, out vec3 to_light) {
    vec3 path = frame.lights[lamp].xyz - position;
    float r2 = max(dot(path, path), 1e-6);
    to_light = path * inversesqrt(r2);
    return frame.lights[lamp].w / r2 * (lamp == 0 ? shadow(position, to_light) : 1.0);
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
