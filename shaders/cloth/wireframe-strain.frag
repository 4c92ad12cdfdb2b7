#version 330 core
//@ shader lines title="Wireframe, strain" quantity="strain" help="The springs alone, coloured by strain: at each point that of the structural or shear spring for which it is most."
//@ legend title="Strain" unit="%" low=low high=high map=map
#include "common/ramp.glsl"
in float line_quantity;
out vec4 pixel;
uniform float low = -10.0;   //@ label="Low end" unit="%" min=-100 max=100 help="Value of the map's first colour."
uniform float high = 10.0;   //@ label="High end" unit="%" min=-100 max=100 help="Value of the map's last colour."
uniform sampler2D map;       //@ label="Colours" texture=ramp default="blue-orange" help="From the low end to the high end. All built-in maps are safe for colour-blind people."

void main() { pixel = vec4(map_colour(map, 100.0 * line_quantity, low, high), 1.0); }
