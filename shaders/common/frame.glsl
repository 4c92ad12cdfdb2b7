// What all shaders of a picture share; filled in by src/render/renderer.cpp.
layout(std140) uniform Frame {
    mat4 view;          // world to camera
    mat4 projection;    // camera to clip space
    vec4 eye;           // xyz: m; w: 1. Orthographic: the direction to the eye; w: 0
    vec4 viewport;      // width, height in px, and their inverses
    vec4 lights[2];     // xyz: m; w: intensity, as it arrives at 1 m
    vec4 ambient;       // x: light from everywhere, y: from over the left shoulder
    vec4 cloth_depth;   // x, y: where the cloth begins and ends, as distance from the eye in m
    mat4 to_shadow;     // world to the first lamp's shadow map: place and depth, 0 to 1
    vec4 shadow;        // x: 1 when that lamp casts a shadow, else 0; y: how far in front of a surface the map is asked
                        // where light grazes it, in m, at 1 m from the lamp; z: width of a texel as a share of the map
} frame;

// From a point to the beholder, of length 1.
vec3 direction_to_eye(vec3 world) { return normalize(frame.eye.xyz - frame.eye.w * world); }

bool is_orthographic() { return frame.projection[3][3] == 1.0; }

// A point's place in the picture, with its depth moved by a share of its distance: below 1 is nearer to the eye.
vec4 to_clip(vec3 world, float depth) {
    vec4 camera = frame.view * vec4(world, 1.0);
    // Orthographic pictures have no such distance; one of 2.4 times the half height is a field of view of 45 degrees.
    if (is_orthographic()) camera.z += (1.0 - depth) * 2.4 / frame.projection[1][1];
    else camera.xyz *= depth;
    return frame.projection * camera;
}

// The distance in m of a point in clip space from the eye's plane.
float depth_of(vec4 clip) {
    return is_orthographic() ? (frame.projection[3][2] - clip.z) / frame.projection[2][2] : clip.w;
}
