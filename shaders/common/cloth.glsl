// What a cloth's fragment shader is given: see cloth/default.vert. Needs common/frame.glsl.
in vec3 world_position;
in vec3 world_normal;   // of the front
in vec2 surface_uv;     // 0 to 1 along columns and rows
out vec4 pixel;

uniform vec3 front_colour, back_colour;   // linear

// The normal of the side that is seen.
vec3 seen_normal() {
    vec3 n = normalize(world_normal);
    return gl_FrontFacing ? n : -n;
}

vec3 seen_colour() { return gl_FrontFacing ? front_colour : back_colour; }
