// Cloth with a colour for each side. Needs common/frame.glsl.
#include "common/surface.glsl"

uniform vec3 front_colour;   //@ label="Front" colour="#E0714F" help="Colour of the side that looks up, or to the front, at first."
uniform vec3 back_colour;    //@ label="Back" colour="#9AA5B1" help="Colour of the other side."

vec3 seen_colour() { return shade * (seen_front() ? front_colour : back_colour); }
