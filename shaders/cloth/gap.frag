#version 330 core
//@ shader title="Contact" quantity="gap" help="The room between layers: each point's distance to the nearest point of another layer, less twice the thickness. Below 0 self-collision pushes; two thicknesses stand for all that is further."
//@ legend title="Gap" unit="mm" low=low high=high map=map
#include "common/frame.glsl"
#include "common/surface.glsl"
#include "common/lighting.glsl"
#include "common/ramp.glsl"
#include "common/heat_map.glsl"
uniform float low = 20.0;    //@ label="Low end" unit="mm" min=-50 max=200 help="Value of the map's first colour."
uniform float high = -5.0;   //@ label="High end" unit="mm" min=-50 max=200 help="Value of the map's last colour."
uniform sampler2D map;       //@ label="Colours" texture=ramp default="cividis" help="From the low end to the high end. All built-in maps are safe for colour-blind people."

void main() { pixel = heat_pixel(map_colour(map, 1000.0 * surface_quantity, low, high)); }
