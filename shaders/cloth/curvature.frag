#version 330 core
//@ shader title="Curvature" quantity="curvature" help="How strongly the cloth is bent: the size of the mean curvature, 1/(2r) in a fold of radius r."
//@ legend title="Curvature" unit="1/m" low=low high=high map=map
#include "common/frame.glsl"
#include "common/surface.glsl"
#include "common/lighting.glsl"
#include "common/ramp.glsl"
#include "common/heat_map.glsl"
uniform float low = 0.0;    //@ label="Low end" unit="1/m" min=0 max=500 help="Value of the map's first colour."
uniform float high = 30.0;   //@ label="High end" unit="1/m" min=0 max=500 help="Value of the map's last colour."
uniform sampler2D map;       //@ label="Colours" texture=ramp default="viridis" help="From the low end to the high end. All built-in maps are safe for colour-blind people."

void main() { pixel = heat_pixel(map_colour(map, surface_quantity, low, high)); }
