// What a cloth's fragment shader is given: see cloth/default.vert. Needs common/frame.glsl.
in vec3 world_position;
in vec3 world_normal;   // of the front
in vec3 world_tangent;   // along growing u: change of position
in vec2 surface_uv;     // 0 to 1 along columns and rows
in float surface_quantity;   // what the shader's declaration names
out vec4 pixel;

uniform vec3 front_colour;   //@ label="Front" colour="#E0714F" help="Colour of the side that looks up, or to the front, at first."
uniform vec3 back_colour;    //@ label="Back" colour="#9AA5B1" help="Colour of the other side."
uniform bool swap_sides;     // the other side is the front
uniform float shade;         // below 1 under springs

// The normal of the side that is seen.
vec3 seen_normal() {
    vec3 n = normalize(world_normal);
    return gl_FrontFacing ? n : -n;
}

vec3 seen_colour() { return shade * (gl_FrontFacing != swap_sides ? front_colour : back_colour); }
