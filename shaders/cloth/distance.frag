#version 330 core
//@ shader title="Distance to the ghost" quantity="distance" help="How far each point is from the same point of the branch that is drawn over the cloth; 0 where there is none."
//@ legend title="Distance" unit="mm" low=low high=high map=map
#include "common/frame.glsl"
#include "common/surface.glsl"
#include "common/lighting.glsl"
#include "common/ramp.glsl"
#include "common/heat_map.glsl"
uniform float low = 0.0;     //@ label="Low end" unit="mm" min=0 max=1000 help="Value of the map's first colour."
uniform float high = 100.0;  //@ label="High end" unit="mm" min=0 max=1000 help="Value of the map's last colour."
uniform sampler2D map;       //@ label="Colours" texture=ramp default="viridis" help="From the low end to the high end. All built-in maps are safe for colour-blind people."

void main() { pixel = heat_pixel(map_colour(map, 1000.0 * surface_quantity, low, high)); }
