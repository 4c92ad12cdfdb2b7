#version 330 core
//@ shader title="Strain" quantity="strain" help="How far springs are longer or shorter than at rest: at each point the structural or shear spring for which it is most."
//@ legend title="Strain" unit="%" low=low high=high map=map
#include "common/frame.glsl"
#include "common/surface.glsl"
#include "common/lighting.glsl"
#include "common/ramp.glsl"
#include "common/heat_map.glsl"
uniform float low = -10.0;    //@ label="Low end" unit="%" min=-100 max=100 help="Value of the map's first colour."
uniform float high = 10.0;   //@ label="High end" unit="%" min=-100 max=100 help="Value of the map's last colour."
uniform sampler2D map;       //@ label="Colours" texture=ramp default="blue-orange" help="From the low end to the high end. All built-in maps are safe for colour-blind people."

void main() { pixel = heat_pixel(map_colour(map, 100.0 * surface_quantity, low, high)); }
