// What every fragment shader of cloth is given: see cloth/default.vert. Needs common/frame.glsl.
in vec3 world_position;      // m
in vec3 world_normal;        // of the side that looks up when the cloth is horizontal, -z when it is vertical
in vec3 world_tangent;       // along growing u: change of position in m
in vec2 surface_uv;          // 0 to 1 from left to right and from below, as the front shows a picture upright
in float surface_quantity;   // what the shader's declaration names
out vec4 pixel;              // linear; alpha counts for shaders that are declared translucent

uniform bool swap_sides;   // the other side is the front
uniform float shade;       // below 1 under springs

bool seen_front() { return gl_FrontFacing != swap_sides; }

// The unit normal of the side that is seen.
vec3 seen_normal() {
    vec3 n = normalize(world_normal);
    return gl_FrontFacing ? n : -n;
}
