#version 330 core
//@ shader title="Speed" quantity="speed" help="How fast each point moves."
//@ legend title="Speed" unit="m/s" low=low high=high map=map
#include "common/frame.glsl"
#include "common/surface.glsl"
#include "common/lighting.glsl"
#include "common/ramp.glsl"
#include "common/heat_map.glsl"
uniform float low = 0.0;    //@ label="Low end" unit="m/s" min=0 max=20 help="Value of the map's first colour."
uniform float high = 3.0;   //@ label="High end" unit="m/s" min=0 max=20 help="Value of the map's last colour."
uniform sampler2D map;       //@ label="Colours" texture=ramp default="viridis" help="From the low end to the high end. All built-in maps are safe for colour-blind people."

void main() { pixel = heat_pixel(map_colour(map, surface_quantity, low, high)); }
